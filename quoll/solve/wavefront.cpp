#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"

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
// V: run.value(), pi: run.policy(), g: discount, P(s): probability to stay.

namespace quoll {

namespace {

constexpr std::uint32_t band_layers = 4;

class Wavefront {
 public:
  explicit Wavefront(Discounted& run) : run_(run), mdp_(run.mdp()) { make_bands(); }

  std::size_t bands() const { return band_begin_.size() - 1; }

  // Steps 2 to 4 from the first band to the last.
  void pass(double aim) {
    with_rows(mdp_, [&](const auto& rows) { pass(rows, aim); });
  }

 private:
  template <class Rows>
  void pass(const Rows& rows, double aim) {
    std::vector<double> change(bands(), infinity);
    std::size_t rear = 0;
    for (std::size_t front = 1; rear < bands(); front = std::min(front + 1, bands())) {
      double most = 0.0;
      for (std::size_t b = rear; b < front; ++b) {
        change[b] = improve(rows, band_begin_[b], band_begin_[b + 1]);
        most = std::max(most, change[b]);
      }
      evaluate(rows, band_begin_[rear], band_begin_[front]);
      if (!run_.count(3 * (band_begin_[front] - band_begin_[rear]), most)) return;
      while (rear < front && change[rear] <= aim) ++rear;
    }
  }

  // Step 1. States that cannot reach an end make a last band.
  void make_bands() {
    const std::vector<std::uint32_t> moves = moves_to_end(mdp_);
    std::uint32_t deepest = 0;
    for (const std::uint32_t m : moves) deepest = m == unreached ? deepest : std::max(deepest, m);
    const auto layer_of = [&](State s) { return moves[s] == unreached ? deepest + 1 : moves[s]; };
    std::vector<std::uint64_t> layer_end(deepest + 3, 0);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s)) ++layer_end[layer_of(s) + 1];
    }
    for (std::size_t i = 1; i < layer_end.size(); ++i) layer_end[i] += layer_end[i - 1];
    band_begin_.push_back(0);
    for (std::size_t layer = band_layers; layer < layer_end.size(); layer += band_layers) {
      if (layer_end[layer] > band_begin_.back()) band_begin_.push_back(layer_end[layer]);
    }
    if (layer_end.back() > band_begin_.back()) band_begin_.push_back(layer_end.back());
    order_.resize(layer_end.back());
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s)) order_[layer_end[layer_of(s)]++] = s;
    }
  }

  // Step 2: the largest change.
  template <class Rows>
  double improve(const Rows& rows, std::uint64_t begin, std::uint64_t end) {
    double* const value = run_.value().data();
    double most = 0.0;
    for (std::uint64_t i = begin; i < end; ++i) {
      const State s = order_[i];
      const std::uint64_t first = mdp_.choice_begin(s);
      double best = -infinity;
      for (std::uint64_t c = first; c < mdp_.choice_end(s); ++c) {
        const double q = rows.leave(run_.discount(), value, c, s);
        if (!(q > best)) continue;
        best = q;
        run_.policy()[s] = static_cast<Action>(c - first);
      }
      most = std::max(most, std::fabs(best - value[s]));
      value[s] = best;
    }
    return most;
  }

  // Step 3.
  template <class Rows>
  void evaluate(const Rows& rows, std::uint64_t begin, std::uint64_t end) {
    double* const value = run_.value().data();
    const auto visit = [&](State s) {
      const std::uint64_t choice = mdp_.choice_begin(s) + run_.policy()[s];
      value[s] = rows.leave(run_.discount(), value, choice, s);
    };
    for (std::uint64_t i = end; i > begin; --i) visit(order_[i - 1]);
    for (std::uint64_t i = begin; i < end; ++i) visit(order_[i]);
  }

  Discounted& run_;
  const Mdp& mdp_;
  std::vector<State> order_;               // all states that are no ends, layer by layer
  std::vector<std::uint64_t> band_begin_;  // into order_, and its end
};

}  // namespace

bool wavefront(Discounted& run, std::size_t least_bands) {
  Wavefront wave(run);
  if (wave.bands() < least_bands) return false;
  if (run.certify()) return true;
  double aim = run.aim();
  do {
    wave.pass(aim);
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
