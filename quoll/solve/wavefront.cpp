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
Wavefront::Wavefront(const Mdp& mdp, std::vector<double>& value, unsigned threads)
    : mdp_(mdp), value_(value), threads_(threads == 0 ? processors() : threads) {
  const std::vector<std::uint32_t> moves = moves_to_end(mdp);
  std::uint32_t deepest = 0;
  for (const std::uint32_t m : moves) deepest = m == unreached ? deepest : std::max(deepest, m);
  const auto layer_of = [&](State s) { return moves[s] == unreached ? deepest + 1 : moves[s]; };
  const auto left_out = [&](State s) { return mdp.terminal(s) || value[s] == -infinity; };
  layer_begin_.assign(deepest + 3, 0);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!left_out(s)) ++layer_begin_[layer_of(s) + 1];
  }
  for (std::size_t i = 1; i < layer_begin_.size(); ++i) layer_begin_[i] += layer_begin_[i - 1];
  const std::size_t layers = deepest + 2;
  band_layer_.push_back(0);
  for (std::size_t end = band_layers; end < layers + band_layers; end += band_layers) {
    const std::size_t layer = std::min(end, layers);
    if (layer_begin_[layer] > layer_begin_[band_layer_.back()]) band_layer_.push_back(layer);
  }
  order_.resize(layer_begin_.back());
  std::vector<std::uint64_t> place(layer_begin_.begin(), layer_begin_.end() - 1);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!left_out(s)) order_[place[layer_of(s)]++] = s;
  }
  if (threads_ > 1 && !layers_are_free(moves)) threads_ = 1;
}

bool Wavefront::layers_are_free(const std::vector<std::uint32_t>& moves) const {
  for (const State s : order_) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        const State next = mdp_.next(o);
        if (next != s && moves[next] == moves[s]) return false;
      }
    }
  }
  return true;
}

void Wavefront::guess(double per_move) {
  for (std::size_t b = 0; b < bands(); ++b) {
    const double value = per_move * static_cast<double>(band_layers * (b + 1));
    const std::uint64_t end = layer_begin_[band_layer_[b + 1]];
    for (std::uint64_t i = layer_begin_[band_layer_[b]]; i < end; ++i) value_[order_[i]] = value;
  }
}

// Step 4.
bool Wavefront::move_window(double aim, const Count& count,
                            const std::vector<std::vector<double>>& change, std::size_t& rear,
                            std::size_t& front) const {
  const auto change_of = [&](std::size_t band) {
    double most = 0.0;
    for (const std::vector<double>& member : change) most = std::max(most, member[band]);
    return most;
  };
  double most = 0.0;
  for (std::size_t b = rear; b < front; ++b) most = std::max(most, change_of(b));
  const std::uint64_t swept = layer_begin_[band_layer_[front]] - layer_begin_[band_layer_[rear]];
  if (!count(3 * swept, most)) return false;
  while (rear < front && change_of(rear) <= aim) ++rear;
  front = std::min(front + 1, bands());
  return rear < bands();
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
  Wavefront wave(run.mdp(), run.value(), run.threads());
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
