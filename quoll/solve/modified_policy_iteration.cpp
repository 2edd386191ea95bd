#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/policy_rows.hpp"

// Modified policy iteration. Puterman and Shin 1978; Puterman 1994, section 6.5.
//
//   1  W <- T V; pi <- the greedy policy of V; MacQueen's bounds; stop when narrow enough
//   2  V <- r_pi + g P_pi W, again and again, until the span of the differences is a hundredth of
//      what it was in step 1 or below the aim, at most 100 times; go to 1
//
// Only what policies differ in counts, not how high all values are: MacQueen's bounds do not need
// the latter, so that step 2 stops by the span. Its rows are packed by step 1.
// pi: run.policy(), V, W: run.value(), g: discount, P_pi: PolicyRows.

namespace quoll {

void modified_policy_iteration(Discounted& run) {
  constexpr unsigned most_sweeps = 100;
  constexpr double share = 0.01;
  std::vector<double> next(run.value().size());
  PolicyRows rows(run.mdp());
  while (!run.certify(rows)) {
    const double goal = std::max(share * run.span(), 0.5 * run.aim());
    for (unsigned k = 0; k < most_sweeps; ++k) {
      const double span = rows.sweep(run.discount(), run.value(), next, run.threads()).span();
      run.value().swap(next);
      if (!run.count(run.value().size(), span) || span <= goal) break;
    }
  }
}

namespace {

class ModifiedPolicyIteration : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discounted_only(mdp, settings, "modified-policy-iteration");
    if (!discount) return discount.error();
    Discounted run(mdp, settings, *discount, "modified-policy-iteration");
    modified_policy_iteration(run);
    return run.finish();
  }
};

}  // namespace

std::unique_ptr<Solver> make_modified_policy_iteration() {
  return std::make_unique<ModifiedPolicyIteration>();
}

}  // namespace quoll
