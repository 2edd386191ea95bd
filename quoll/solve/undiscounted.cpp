#include <utility>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/solve/components.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/ending_iteration.hpp"
#include "quoll/solve/methods.hpp"

// What the methods for discount 1 share: the question whether values are defined, and the order of
// the attempts.

namespace quoll {

namespace {

Solution iterate(const Mdp& mdp, const SolveSettings& settings, Ending ending, TotalMethod how) {
  if (how == TotalMethod::intervals) return iterate_intervals(mdp, settings, std::move(ending));
  if (how == TotalMethod::optimistic) {
    return iterate_optimistically(mdp, settings, std::move(ending));
  }
  const bool by_components = how == TotalMethod::by_components;
  {
    EndingIteration quick(mdp, settings, ending);
    if (by_components) {
      for (const std::span<const State> part : Components(mdp, ending.live)) quick.run_part(part);
    } else {
      quick.run(false);
    }
    Solution solution = quick.finish();
    if (solution.converged || by_components || quick.stopped()) return solution;
  }
  EndingIteration thorough(mdp, settings, std::move(ending));
  thorough.run(true);
  return thorough.finish();
}

}  // namespace

Result<Solution> solve_undiscounted(const Mdp& mdp, const SolveSettings& settings,
                                    std::string_view method, TotalMethod how) {
  if (auto error = undiscounted_error(mdp)) return *error;
  return solve_ending(mdp, settings, method, unknown_states(mdp), how);
}

Solution solve_ending(const Mdp& mdp, const SolveSettings& settings, std::string_view method,
                      const std::vector<bool>& unknown, TotalMethod how) {
  Ending ending = find_ending(mdp);
  for (std::size_t s = 0; s < unknown.size(); ++s) {
    if (unknown[s]) ending.live[s] = 0;
  }
  Solution solution;
  if (mdp.deterministic()) {
    solution.policy = std::move(ending.policy);
    improve_to_optimum(mdp, settings, 1.0, ending.live, solution);
  } else {
    solution = iterate(mdp, settings, std::move(ending), how);
  }
  leave_unknown(mdp, unknown, settings.width, solution);
  solution.method = method;
  return solution;
}

}  // namespace quoll
