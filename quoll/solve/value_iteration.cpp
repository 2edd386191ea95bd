#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/solve/methods.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"

// Value iteration with certified bounds. Bellman 1957; bounds: MacQueen 1966, Porteus 1971
// (Puterman 1994, section 6.6); Gauss-Seidel in alternating directions from a lower bound.
//
//   1  V <- min(0, least reward) / (1 - g), 0 at ends: a lower bound on V*
//   2  W <- T V; bounds from the least and greatest W - V; stop when narrow enough; V <- W
//   3  if the span of W - V shrinks slowly (ends far away), sweep in place instead: good news
//   travels
//      along the sweep, so that a few passes to and fro do the work of hundreds; then step 2 again
//   4  lower, upper, policy from the last W; the greedy policy earns at least lower
//
// T: the kernel of sweep.hpp, g: discount, V: value, W: backed_up.

namespace quoll {

namespace {

class ValueIteration {
 public:
  ValueIteration(const Mdp& mdp, const SolveSettings& settings, double discount)
      : mdp_(mdp),
        settings_(settings),
        discount_(discount),
        scale_(mdp),
        value_(mdp.states(), 0.0),
        backed_up_(mdp.states(), 0.0) {
    solution_.method = "value-iteration";
    solution_.discount = discount;
    solution_.policy.assign(mdp.states(), no_action);
    const double low = std::min(0.0, mdp.reward_bounds().first) / (1.0 - discount);
    for (State s = 0; s < mdp.states(); ++s) {
      if (!mdp.terminal(s)) value_[s] = low;  // step 1
    }
  }

  Solution run() {
    constexpr unsigned trial = 6;             // Jacobi sweeps between two looks at the span
    constexpr double slow_over_trial = 0.26;  // 0.8 per sweep: above that step 3 pays
    double span_before = infinity;
    for (unsigned k = 1; !narrow_enough(certify()); ++k) {
      if (!go_on_) break;
      if (k % trial == 0) {
        const double kept = span_ / span_before;  // over `trial` sweeps
        if (kept > slow_over_trial) sweep_in_place();
        span_before = span_;
      }
    }
    return finish();
  }

 private:
  // Step 2.
  SpanBounds certify() {
    const Residual residual =
        sweep_all(mdp_, discount_, value_, backed_up_, solution_.policy, settings_.threads);
    double size = 0.0;
    for (const double v : backed_up_) size = std::max(size, std::fabs(v));
    for (const double v : value_) size = std::max(size, std::fabs(v));
    std::swap(value_, backed_up_);
    count_sweep();
    if (residual.greatest == -infinity) return bounds_ = {0.0, 0.0, 0.0};  // only ends
    span_ = residual.greatest - residual.least;
    bounds_ = span_bounds(scale_, discount_, residual.least, residual.greatest, size);
    go_on_ = may_continue(settings_, solution_, bounds_.width());
    return bounds_;
  }

  bool narrow_enough(const SpanBounds& bounds) const {
    return bounds.width() <= std::max(settings_.width, 2.0 * bounds.rounding);
  }

  // Step 3, until the change per sweep promises bounds that are narrow enough.
  void sweep_in_place() {
    const double aim = 0.25 * settings_.width * (1.0 - discount_) / discount_;
    const double floor = 0.1 * bounds_.rounding * (1.0 - discount_);
    bool backward = true;
    double change = infinity;
    const double goal = std::max({std::min(aim, 0.1 * span_), floor});
    while (change > goal && go_on_) {
      InPlace backend{value_.data()};
      sweep(mdp_, discount_, value_.data(), {0, static_cast<State>(mdp_.states()), backward},
            backend);
      backward = !backward;
      change = backend.change;
      count_sweep();
      go_on_ = may_continue(settings_, solution_, change * discount_ / (1.0 - discount_));
    }
    if (!go_on_) {
      go_on_ = true;
      certify();
      go_on_ = false;
    }
  }

  void count_sweep() {
    ++solution_.sweeps;
    solution_.backups += mdp_.states();
  }

  // Step 4.
  Solution finish() {
    solution_.lower = std::move(value_);
    solution_.upper = solution_.lower;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      solution_.lower[s] = add_down(solution_.lower[s], bounds_.lower);
      solution_.upper[s] = add_up(solution_.upper[s], bounds_.upper);
    }
    conclude(mdp_, solution_, settings_.width);
    return std::move(solution_);
  }

  const Mdp& mdp_;
  const SolveSettings& settings_;
  double discount_;
  ModelScale scale_;
  Solution solution_;
  std::vector<double> value_, backed_up_;
  SpanBounds bounds_{-infinity, infinity, infinity};
  double span_ = infinity;
  bool go_on_ = true;
};

class ValueIterationSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0) return solve_undiscounted(mdp, settings, "value-iteration");
    return ValueIteration(mdp, settings, *discount).run();
  }
};

}  // namespace

std::unique_ptr<Solver> make_value_iteration() {
  return std::make_unique<ValueIterationSolver>();
}

}  // namespace quoll
