#include "quoll/solve/solver.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/solve/methods.hpp"

namespace quoll {

namespace {

constexpr std::array<SolverEntry, 4> registry{{
    {"value-iteration", "Bellman sweeps with MacQueen's bounds; discounts below 1",
     make_value_iteration},
    {"policy-iteration", "Howard's method; any model, also without discounting",
     make_policy_iteration},
    {"label-setting", "shortest paths; exact answers for deterministic models", make_label_setting},
    {"backward-induction", "from the ends on; models in which no state comes again, games of two",
     make_backward_induction},
}};

}  // namespace

std::span<const SolverEntry> solvers() {
  return registry;
}

std::string_view choose_solver(const Mdp& mdp, double discount) {
  if (mdp.alternating()) return "backward-induction";
  if (mdp.deterministic()) return "label-setting";
  return discount < 1.0 ? "value-iteration" : "policy-iteration";
}

Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings, std::string_view method) {
  if (method == "auto") method = choose_solver(mdp, settings.discount.value_or(mdp.discount()));
  std::vector<std::string_view> names{"auto"};
  for (const SolverEntry& entry : registry) {
    if (entry.name == method) return entry.make()->solve(mdp, settings);
    names.push_back(entry.name);
  }
  return Error{"--method", 0, 0, "no solver is called '" + std::string(method) + "'",
               nearest(method, names)};
}

}  // namespace quoll
