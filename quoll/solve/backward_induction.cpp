#include <utility>
#include <vector>

#include "quoll/solve/backward.hpp"
#include "quoll/solve/methods.hpp"

// Backward induction. Zermelo 1913 ("Ueber eine Anwendung der Mengenlehre auf die Theorie des
// Schachspiels"): a game that must end is decided from its ends on. Shapley 1953 ("Stochastic
// games"), for the sign: what the next player can be sure of counts against the one who moved.
//
//   1  order the states so that each comes after all that can follow it
//   2  for each s in that order:
//        Q(s,a) = r(s,a) + g' E V(s'),  g' = g, or -g where the turn passes
//        V(s) = max_a Q(s,a), pi(s) = the a whose lower bound is largest
//
// The bounds are intervals rounded outward: with g' negative the lower bound of V(s) comes from the
// upper bounds of V(s'). V, Q -> value and q_lower, q_upper; g -> discount; pi -> policy.

namespace quoll {

namespace {

class BackwardInductionSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_in_use(mdp, settings);
    if (!discount) return discount.error();
    const Result<std::vector<State>> order = backward_order(mdp);  // step 1
    if (!order) return order.error();
    Solution solution;
    solution.method = "backward-induction";
    solution.discount = *discount;
    solution.sweeps = 1;
    solution.backups = order->size();
    solution.policy.assign(mdp.states(), no_action);
    Bounds value(mdp);
    const Discount factor(*discount);
    for (const State s : *order) {  // step 2
      double lower = -infinity, upper = -infinity;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        const double low = q_lower(mdp, c, factor, value);
        upper = std::max(upper, q_upper(mdp, c, factor, value));
        if (low <= lower && solution.policy[s] != no_action) continue;
        lower = low;
        solution.policy[s] = static_cast<Action>(c - mdp.choice_begin(s));
      }
      value.lower[s] = lower;
      value.upper[s] = upper;
    }
    solution.lower = std::move(value.lower);
    solution.upper = std::move(value.upper);
    conclude(mdp, solution, settings.width);
    return solution;
  }
};

}  // namespace

std::unique_ptr<Solver> make_backward_induction() {
  return std::make_unique<BackwardInductionSolver>();
}

}  // namespace quoll
