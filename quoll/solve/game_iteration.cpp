#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "quoll/solve/backward.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"

// Value iteration for games of two who move in turn, where states may come again. Shapley 1953
// ("Stochastic games"): T V(s) = max_a r(s,a) - g E V(s') shrinks the largest distance by g < 1.
//
//   1  V <- 0
//   2  W <- T V, pi <- the maximisers; M = max |W - V|; V <- W
//   3  stop if k is small enough: W - k <= V* <= W + k, and pi is sure of W - k
//   4  V <- T V in place, to and fro over the states, until little changes; then step 2 again
//   5  narrow the bounds L and U by backups of each other, in place, as long as that makes another
//      state exact: a draw is then 0 and nothing else
//
// k >= g M + g k and what rounding asks for: with L = W - k and U = W + k then L <= T_pi U and
// T L <= U. g: discount, V: value, W: backed_up, pi: policy.

namespace quoll {

namespace {

class GameIteration {
 public:
  GameIteration(const Mdp& mdp, const SolveSettings& settings, double discount)
      : mdp_(mdp),
        settings_(settings),
        discount_(discount),
        scale_(mdp),
        value_(mdp.states(), 0.0),
        backed_up_(mdp.states(), 0.0) {
    solution_.method = "game-iteration";
    solution_.discount = discount;
    solution_.policy.assign(mdp.states(), no_action);
  }

  Solution run() {
    while (!certify() && go_on_) sweep_in_place();
    Bounds around(mdp_);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      around.lower[s] = add_down(value_[s], bounds_.lower);
      around.upper[s] = add_up(value_[s], bounds_.upper);
    }
    while (go_on_ && narrow(around)) {
    }
    solution_.lower = std::move(around.lower);
    solution_.upper = std::move(around.upper);
    conclude(mdp_, solution_, settings_.width);
    return std::move(solution_);
  }

 private:
  // Steps 2 and 3: whether the bounds are as narrow as asked, or as rounding allows.
  bool certify() {
    const Differences change = sweep_all(
        mdp_, mdp_.carry(discount_),
        Residual{value_.data(), backed_up_.data(), solution_.policy.data()}, settings_.threads);
    std::swap(value_, backed_up_);
    count_sweep();
    distance_ = std::max({0.0, change.greatest, -change.least});
    double size = 0.0;
    for (const double v : backed_up_) size = std::max(size, std::fabs(v));
    for (const double v : value_) size = std::max(size, std::fabs(v));
    bounds_ = span_bounds(scale_, discount_, -distance_, distance_, size);
    go_on_ = may_continue(settings_, solution_, bounds_.width());
    return bounds_.width() <= std::max(settings_.width, 2.0 * bounds_.rounding);
  }

  // Step 4: a change by c leaves bounds about 2 g c / (1 - g) wide.
  void sweep_in_place() {
    const double rest = 1.0 - discount_;
    const double aim = std::max(0.25 * settings_.width * rest, 0.1 * bounds_.rounding * rest);
    const double goal = std::max(std::min(aim, 0.1 * distance_), 0.0);
    double change = infinity;
    for (bool backward = true; change > goal && go_on_; backward = !backward) {
      InPlace backend{value_.data()};
      sweep(mdp_, mdp_.carry(discount_), value_.data(),
            {0, static_cast<State>(mdp_.states()), backward}, backend);
      change = backend.change;
      count_sweep();
      go_on_ = may_continue(settings_, solution_, change * discount_ / rest);
    }
  }

  // Step 5. Whether a state became exact.
  bool narrow(Bounds& around) {
    const Discount discount(discount_);
    bool exact = false;
    for (State s = 0; s < mdp_.states(); ++s) {
      double& lower = around.lower[s];
      double& upper = around.upper[s];
      if (lower == upper) continue;
      double most = -infinity;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        most = std::max(most, q_upper(mdp_, c, discount, around));
        const double low = q_lower(mdp_, c, discount, around);
        if (low <= lower) continue;
        lower = low;
        solution_.policy[s] = static_cast<Action>(c - mdp_.choice_begin(s));
      }
      upper = std::min(upper, most);
      exact = exact || lower == upper;
    }
    count_sweep();
    return exact && may_continue(settings_, solution_, bounds_.width());
  }

  void count_sweep() {
    ++solution_.sweeps;
    solution_.backups += mdp_.states();
  }

  const Mdp& mdp_;
  const SolveSettings& settings_;
  double discount_;
  ModelScale scale_;
  Solution solution_;
  std::vector<double> value_, backed_up_;
  SpanBounds bounds_{-infinity, infinity, infinity};
  double distance_ = infinity;
  bool go_on_ = true;
};

class GameIterationSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_in_use(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0) {
      return Error{"--method", 0, 0, "game-iteration needs a discount below 1", ""};
    }
    return GameIteration(mdp, settings, *discount).run();
  }
};

}  // namespace

std::unique_ptr<Solver> make_game_iteration() {
  return std::make_unique<GameIterationSolver>();
}

}  // namespace quoll
