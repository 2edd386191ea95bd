#include <cstdint>
#include <memory>
#include <vector>

#include "quoll/solve/discounted.hpp"
#include "quoll/solve/krylov.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/policy_rows.hpp"

// Policy iteration. Howard 1960; inexact evaluation by a Krylov method: Gargiani et al. 2022.
//
//   1  W <- T V; pi <- the greedy policy of V; MacQueen's bounds; stop when narrow enough
//   2  evaluate pi: solve (I - g P_pi) x = r_pi + g P_pi W - W by BiCGSTAB (krylov.hpp) until the
//      residual is a hundredth of what it was, V <- W + x; if that fails to, V <- r_pi + g P_pi V
//      100 times instead; go to 1
//
// Deterministic models are evaluated exactly along the graph instead (functional_graph.hpp).
// pi: run.policy(), V, W: run.value(), P_pi: PolicyRows.

namespace quoll {

namespace {

void evaluate_policy(const PolicyRows& rows, Discounted& run) {
  constexpr unsigned sweeps_instead = 100;
  std::vector<double>& value = run.value();
  std::vector<double> next(value.size());
  const Krylov krylov = improve_by_krylov(rows, run.discount(), 0.01, run.threads(), value);
  if (!run.count(krylov.products * value.size(), run.residual()) || krylov.reached) return;
  for (unsigned k = 0; k < sweeps_instead; ++k) {
    const double span = rows.sweep(run.discount(), value, next, run.threads()).span();
    value.swap(next);
    if (!run.count(value.size(), span) || span <= 0.5 * run.aim()) break;
  }
}

class PolicyIterationSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0) return solve_undiscounted(mdp, settings, "policy-iteration");
    if (!mdp.deterministic()) {
      Discounted run(mdp, settings, *discount, "policy-iteration");
      PolicyRows rows(mdp);
      while (!run.certify(rows)) evaluate_policy(rows, run);
      return run.finish();
    }
    Solution solution;
    solution.method = "policy-iteration";
    solution.policy.assign(mdp.states(), no_action);
    const std::vector<std::uint8_t> live = live_states(mdp, *discount);
    for (State s = 0; s < mdp.states(); ++s) {
      if (live[s] != 0) solution.policy[s] = 0;
    }
    improve_to_optimum(mdp, settings, *discount, live, solution);
    return solution;
  }
};

}  // namespace

std::unique_ptr<Solver> make_policy_iteration() {
  return std::make_unique<PolicyIterationSolver>();
}

}  // namespace quoll
