#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/solve/induced.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"

// Policy iteration. Howard 1960; inexact evaluation: Puterman and Shin 1978 (Puterman 1994, 6.5).
//
//   1  W <- T V; pi <- the greedy policy of V; MacQueen's bounds; stop when narrow enough
//   2  evaluate pi: V <- r_pi + g P_pi V in place, to and fro, until the change is a hundredth of
//      the last residual, at most 50 times; go to 1
//
// Deterministic models are evaluated exactly along the graph instead (functional_graph.hpp).
// pi: solution.policy, V: value, W: backed_up, P_pi: chain.

namespace quoll {

namespace {

// Step 2. Returns the number of sweeps.
std::uint64_t evaluate_in_place(const Mdp& chain, double discount, double goal,
                                std::vector<double>& value) {
  constexpr unsigned most_sweeps = 50;
  std::uint64_t sweeps = 0;
  bool backward = true;
  for (double change = infinity; change > goal && sweeps < most_sweeps; ++sweeps) {
    InPlace backend{value.data()};
    sweep(chain, discount, value.data(), {0, static_cast<State>(chain.states()), backward},
          backend);
    change = backend.change;
    backward = !backward;
  }
  return sweeps;
}

Result<Solution> iterate_policies(const Mdp& mdp, const SolveSettings& settings, double discount) {
  const ModelScale scale(mdp);
  Solution solution;
  solution.method = "policy-iteration";
  solution.discount = discount;
  solution.policy.assign(mdp.states(), no_action);
  const double low = std::min(0.0, mdp.reward_bounds().first) / (1.0 - discount);
  std::vector<double> value(mdp.states(), 0.0);
  for (State s = 0; s < mdp.states(); ++s) value[s] = mdp.terminal(s) ? 0.0 : low;
  std::vector<double> backed_up(mdp.states(), 0.0);
  SpanBounds bounds{0.0, 0.0, 0.0};
  for (;;) {
    const Residual residual =
        sweep_all(mdp, discount, value, backed_up, solution.policy, settings.threads);
    ++solution.sweeps;
    solution.backups += mdp.states();
    double size = 0.0;
    for (const double v : value) size = std::max(size, std::fabs(v));
    for (const double v : backed_up) size = std::max(size, std::fabs(v));
    std::swap(value, backed_up);
    if (residual.greatest == -infinity) break;  // only ends
    bounds = span_bounds(scale, discount, residual.least, residual.greatest, size);
    if (bounds.width() <= std::max(settings.width, 2.0 * bounds.rounding)) break;
    if (!may_continue(settings, solution, bounds.width())) break;
    const Result<Mdp> chain =
        induced_model(mdp, as_probabilities(mdp, solution.policy), std::nullopt);
    if (!chain) return chain.error();
    const double largest = std::max(std::fabs(residual.least), std::fabs(residual.greatest));
    const double floor = 0.1 * bounds.rounding * (1.0 - discount);
    solution.sweeps += evaluate_in_place(*chain, discount, std::max(0.01 * largest, floor), value);
  }
  solution.lower = value;
  solution.upper = std::move(value);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    solution.lower[s] = add_down(solution.lower[s], bounds.lower);
    solution.upper[s] = add_up(solution.upper[s], bounds.upper);
  }
  conclude(mdp, solution, settings.width);
  return solution;
}

class PolicyIterationSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0) return solve_undiscounted(mdp, settings, "policy-iteration");
    if (!mdp.deterministic()) return iterate_policies(mdp, settings, *discount);
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
