#include "quoll/solve/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"

// Value iteration that follows the wave of news from the ends. The order is that of backward value
// iteration (Dai and Goldsmith 2007); the window is Quoll's.
//
//   1  layers of states by their least number of moves to an end; four layers are a band
//   2  the window takes in the next band; one sweep over it in the order of the layers:
//      V(s) <- max over a of (r + g E[V(s'); s' != s]) / (1 - g P(s)), pi(s) <- that action
//   3  two sweeps, back and forth, of the same for the action pi(s) alone
//   4  bands at the rear that step 2 changed by no more than the aim leave the window; go to 2
//   5  W <- T V with MacQueen's bounds; if they are not narrow enough, a smaller aim, and the
//   window
//      begins at the rear again
//
// A sweep over all states in a good order still needs hundreds of rounds when episodes are long,
// because every slip off the order waits for the next sweep. Here a state is swept until what lies
// before it has settled, a few dozen times, while its rows are in the cache, and never again.
// V: value, pi: policy, g: discount, P(s): probability to stay. At discount 1 (undiscounted.cpp)
// the same finds a policy that ends, from a guess of V.

namespace quoll {

namespace {

constexpr std::uint32_t band_layers = 4;

}  // namespace

// Step 1. States that cannot reach an end make a last band.
Wavefront::Wavefront(const Mdp& mdp, std::vector<double>& value) : mdp_(mdp), value_(value) {
  const std::vector<std::uint32_t> moves = moves_to_end(mdp);
  std::uint32_t deepest = 0;
  for (const std::uint32_t m : moves) deepest = m == unreached ? deepest : std::max(deepest, m);
  const auto layer_of = [&](State s) { return moves[s] == unreached ? deepest + 1 : moves[s]; };
  const auto left_out = [&](State s) { return mdp.terminal(s) || value[s] == -infinity; };
  std::vector<std::uint64_t> layer_end(deepest + 3, 0);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!left_out(s)) ++layer_end[layer_of(s) + 1];
  }
  for (std::size_t i = 1; i < layer_end.size(); ++i) layer_end[i] += layer_end[i - 1];
  band_begin_.push_back(0);
  for (std::size_t layer = band_layers; layer < layer_end.size(); layer += band_layers) {
    if (layer_end[layer] > band_begin_.back()) band_begin_.push_back(layer_end[layer]);
  }
  if (layer_end.back() > band_begin_.back()) band_begin_.push_back(layer_end.back());
  order_.resize(layer_end.back());
  for (State s = 0; s < mdp.states(); ++s) {
    if (!left_out(s)) order_[layer_end[layer_of(s)]++] = s;
  }
}

void Wavefront::guess(double per_move) {
  for (std::size_t b = 0; b < bands(); ++b) {
    const double value = per_move * static_cast<double>(band_layers * (b + 1));
    for (std::uint64_t i = band_begin_[b]; i < band_begin_[b + 1]; ++i) value_[order_[i]] = value;
  }
}

// Steps 2 and 3.
bool Wavefront::iterate(double discount, double aim, std::vector<Action>& policy,
                        const Count& count) {
  return with_rows(mdp_, [&](const auto& rows) {
    const InPlacePolicy in_place(mdp_, rows, discount, value_, policy);
    return follow(
        aim, count, [&](State s) { return in_place.improve(s); },
        [&](State s) { in_place.evaluate(s); });
  });
}

bool wavefront(Discounted& run, std::size_t least_bands) {
  Wavefront wave(run.mdp(), run.value());
  const auto count = [&](std::uint64_t updates, double change) {
    return run.count(updates, change);
  };
  if (wave.bands() < least_bands) return false;
  if (run.certify()) return true;
  double aim = run.aim();
  do {
    wave.iterate(run.discount(), aim, run.policy(), count);
    aim *= 0.25;
  } while (!run.certify());
  return true;
}

namespace {

class WavefrontSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discounted_only(mdp, settings, "wavefront");
    if (!discount) return discount.error();
    Discounted run(mdp, settings, *discount, "wavefront");
    wavefront(run, 0);
    return run.finish();
  }
};

}  // namespace

std::unique_ptr<Solver> make_wavefront() {
  return std::make_unique<WavefrontSolver>();
}

}  // namespace quoll
