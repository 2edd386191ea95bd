#include "quoll/solve/solver.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/solve/components.hpp"
#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"

namespace quoll {

namespace {

constexpr std::array<SolverEntry, 11> registry{{
    {"value-iteration", "Bellman sweeps with MacQueen's bounds and action elimination",
     make_value_iteration},
    {"gauss-seidel", "sweeps in place, to and fro, from a lower bound; discounts below 1",
     make_gauss_seidel, true},
    {"modified-policy-iteration", "some sweeps for the policy alone between two for all actions",
     make_modified_policy_iteration, true},
    {"wavefront", "a window of sweeps that follows the news from the ends; discounts below 1",
     make_wavefront, true},
    {"topological", "one strongly connected component after the other; any model",
     make_topological},
    {"policy-iteration", "Howard's method; any model, also without discounting",
     make_policy_iteration},
    {"interval-iteration", "bounds from both sides, end components as one state; discount 1 only",
     make_interval_iteration, false, true},
    {"optimistic-value-iteration", "from below, then a guess above is proved; discount 1 only",
     make_optimistic_value_iteration, false, true},
    {"label-setting", "shortest paths; exact answers for deterministic models", make_label_setting},
    {"backward-induction",
     "from the ends on; where no state comes again, games of two, any model with --horizon N",
     make_backward_induction},
    {"game-iteration", "sweeps with Shapley's bound; games of two at discounts below 1",
     make_game_iteration, true},
}};

// auto.
class ByStructure : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_in_use(mdp, settings);
    if (!discount) return discount.error();
    if (mdp.alternating() && *discount < 1.0 && !returning_states(mdp).empty()) {
      return make_game_iteration()->solve(mdp, settings);
    }
    if (mdp.alternating()) return make_backward_induction()->solve(mdp, settings);
    if (mdp.deterministic()) return make_label_setting()->solve(mdp, settings);
    if (Components::many(mdp)) return make_topological()->solve(mdp, settings);
    if (*discount == 1.0) return make_policy_iteration()->solve(mdp, settings);
    return solve_discounted(mdp, settings, *discount);
  }
};

}  // namespace

std::span<const SolverEntry> solvers() {
  return registry;
}

Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings, std::string_view method) {
  if (method == "auto") return ByStructure().solve(mdp, settings);
  std::vector<std::string_view> names{"auto"};
  for (const SolverEntry& entry : registry) {
    if (entry.name == method) return entry.make()->solve(mdp, settings);
    names.push_back(entry.name);
  }
  return Error{"--method", 0, 0, "no solver is called '" + std::string(method) + "'",
               nearest(method, names)};
}

}  // namespace quoll
