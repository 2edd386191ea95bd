#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"

// Value iteration with certified bounds and action elimination. Bellman 1957; bounds: MacQueen
// 1966, Porteus 1971 (Puterman 1994, section 6.6); elimination: MacQueen 1967 (Puterman 1994, 6.7).
//
//   1  W <- T V over the actions left; W + l <= V* <= W + u from the least and greatest W - V
//   2  an action with Q(s, a) + g u < max Q(s, .) + g l, for the l and u before that sweep, is
//   never
//      optimal and left out from then on; V <- W and 1 again, until u - l is narrow enough
//   3  one sweep over all actions certifies
//
// V: run.value(), W: backed_up, g: discount.

namespace quoll {

namespace {

class ValueIteration {
 public:
  explicit ValueIteration(Discounted& run)
      : run_(run), mdp_(run.mdp()), left_(mdp_.choices()), count_(mdp_.states()) {
    for (State s = 0; s < mdp_.states(); ++s) {
      count_[s] = mdp_.actions(s);
      for (Action a = 0; a < count_[s]; ++a) left_[mdp_.choice_begin(s) + a] = a;
    }
  }

  // Steps 1 and 2 once; true = narrow enough, or stopped.
  bool sweep(std::vector<double>& backed_up) {
    const Residual residual{run_.value().data(), backed_up.data(), run_.policy().data()};
    const Differences all = over_parts(mdp_.states(), run_.threads(), [&](StateRange range) {
      Residual part = residual;
      with_rows(mdp_, [&](const auto& rows) { sweep_part(rows, range, part); });
      return part.differences;
    });
    return run_.certify_with(backed_up, all);
  }

 private:
  template <class Rows>
  void sweep_part(const Rows& rows, StateRange range, Residual& residual) {
    const double margin = run_.discount() * run_.bounds().width();
    std::vector<double> q;
    for (State s = range.begin; s < range.end; ++s) {
      if (mdp_.terminal(s)) continue;
      Action* const left = left_.data() + mdp_.choice_begin(s);
      q.resize(std::max<std::size_t>(q.size(), count_[s]));
      double best = -infinity;
      Action best_action = 0;
      for (Action i = 0; i < count_[s]; ++i) {
        q[i] = rows.backup(run_.discount(), run_.value().data(), mdp_.choice_begin(s) + left[i]);
        if (!(q[i] > best)) continue;
        best = q[i];
        best_action = left[i];
      }
      residual(s, best, best_action);
      Action kept = 0;
      for (Action i = 0; i < count_[s]; ++i) {
        if (q[i] + margin >= best) left[kept++] = left[i];
      }
      count_[s] = kept;
    }
  }

  Discounted& run_;
  const Mdp& mdp_;
  std::vector<Action> left_;   // per choice's place: the actions left of each state, at its front
  std::vector<Action> count_;  // per state: how many
};

class ValueIterationSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0) return solve_undiscounted(mdp, settings, "value-iteration");
    Discounted run(mdp, settings, *discount, "value-iteration");
    ValueIteration iteration(run);
    std::vector<double> backed_up(mdp.states(), 0.0);
    do {
      while (!iteration.sweep(backed_up)) {
      }
    } while (!run.stopped() && !run.certify());  // step 3
    return run.finish();
  }
};

}  // namespace

std::unique_ptr<Solver> make_value_iteration() {
  return std::make_unique<ValueIterationSolver>();
}

}  // namespace quoll
