#include "quoll/solve/methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/functional_graph.hpp"

namespace quoll {

std::string some_names(const Mdp& mdp, const std::vector<State>& states) {
  constexpr std::size_t shown = 10;
  std::string text;
  for (std::size_t i = 0; i < states.size() && i < shown; ++i) {
    text += (i == 0 ? "" : ", ") + mdp.state_name(states[i]);
  }
  if (states.size() > shown) text += " and " + std::to_string(states.size() - shown) + " more";
  return text;
}

Result<double> discount_in_use(const Mdp& mdp, const SolveSettings& settings) {
  const double discount = settings.discount.value_or(mdp.discount());
  if (discount > 0.0 && discount <= 1.0) return discount;
  return Error{"--discount", 0, 0, "a number above 0 and at most 1 was expected", ""};
}

Result<double> discount_of_one(const Mdp& mdp, const SolveSettings& settings) {
  if (!mdp.alternating()) return discount_in_use(mdp, settings);
  return Error{"--method", 0, 0,
               "two players move in turn here: backward-induction solves such models",
               "backward-induction"};
}

Result<double> discounted_only(const Mdp& mdp, const SolveSettings& settings,
                               std::string_view method) {
  const Result<double> discount = discount_of_one(mdp, settings);
  if (!discount || *discount < 1.0) return discount;
  return Error{"--method", 0, 0,
               std::string(method) + " needs a discount below 1; policy-iteration does without",
               "policy-iteration"};
}

std::optional<Error> undiscounted_error(const Mdp& mdp) {
  const UndiscountedFault fault = undiscounted_fault(mdp);
  using Kind = UndiscountedFault::Kind;
  if (fault.kind == Kind::none) return std::nullopt;
  const std::string names = some_names(mdp, fault.states);
  const std::string why =
      fault.kind == Kind::no_end
          ? "at discount 1 every state needs a way to an end, but these have none: " + names
          : "at discount 1 no cycle may gain reward, but this one does: " + names;
  return Error{"--discount", 0, 0, why + "; a discount below 1 makes the values finite", ""};
}

Result<Mdp> negated_rewards(const Mdp& mdp) {
  MdpArrays arrays = mdp.arrays();
  for (double& reward : arrays.reward) reward = -reward;
  for (double& reward : arrays.outcome_reward) reward = -reward;
  return Mdp::make(std::move(arrays));
}

void turn_signs(std::vector<double>& lower, std::vector<double>& upper) {
  std::swap(lower, upper);
  for (double& value : lower) value = -value + 0.0;
  for (double& value : upper) value = -value + 0.0;
}

Result<Solution> solve_minimised(Solver& solver, const Mdp& mdp, SolveSettings settings) {
  const Result<Mdp> negated = negated_rewards(mdp);
  if (!negated) return negated.error();
  settings.maximise = true;
  Result<Solution> result = solver.solve(*negated, settings);
  if (result) turn_signs(result->lower, result->upper);
  return result;
}

double largest_gap(const Mdp& mdp, const Solution& solution) {
  double gap = 0.0;
  std::vector<bool> reached;  // found only if it matters
  for (std::size_t s = 0; s < solution.lower.size(); ++s) {
    if (solution.lower[s] == solution.upper[s]) continue;
    if (solution.lower[s] == -infinity && solution.upper[s] == infinity) {
      if (reached.empty()) reached = reachable(mdp, mdp.start());
      if (!reached[s]) continue;
    }
    gap = std::max(gap, next_up(solution.upper[s] - solution.lower[s]));
  }
  return gap;
}

void conclude(const Mdp& mdp, Solution& solution, double width) {
  solution.exact = solution.lower == solution.upper;
  solution.converged = largest_gap(mdp, solution) <= width;
}

std::vector<bool> unknown_states(const Mdp& mdp) {
  const std::vector<bool> reached = reachable(mdp, mdp.start());
  if (std::find(reached.begin(), reached.end(), false) == reached.end()) return {};
  std::vector<bool> unknown = may_gain_for_ever(mdp);
  bool any = false;
  for (std::size_t s = 0; s < unknown.size(); ++s) {
    unknown[s] = unknown[s] && !reached[s];
    any = any || unknown[s];
  }
  return any ? unknown : std::vector<bool>();
}

void leave_unknown(const Mdp& mdp, const std::vector<bool>& unknown, double width,
                   Solution& solution) {
  if (unknown.empty()) return;
  for (std::size_t s = 0; s < unknown.size(); ++s) {
    if (!unknown[s]) continue;
    solution.lower[s] = -infinity;
    solution.upper[s] = infinity;
  }
  conclude(mdp, solution, width);
}

bool may_continue(const SolveSettings& settings, const Solution& solution, double gap) {
  if (solution.sweeps >= settings.max_sweeps) return false;
  if (!settings.keep_going) return true;
  return settings.keep_going({solution.sweeps, solution.backups, gap});
}

void improve_to_optimum(const Mdp& mdp, const SolveSettings& settings, double discount,
                        const std::vector<std::uint8_t>& live, Solution& solution) {
  const Discount factor(discount);
  solution.discount = discount;
  GraphValues values = evaluate_graph(mdp, solution.policy, factor, live);
  std::vector<Action> better = solution.policy;
  while (improve_policy(mdp, values, factor, live, better) > 0) {
    ++solution.sweeps;
    solution.backups += values.order.size();
    values = evaluate_graph(mdp, better, factor, live);
    solution.policy = better;
    if (!may_continue(settings, solution, infinity)) break;
  }
  ++solution.sweeps;
  solution.backups += values.order.size();
  lower_until_inductive(mdp, factor, solution.policy, values);
  solution.lower = std::move(values.lower);
  solution.upper = std::move(values.upper);
  if (!raise_until_inductive(mdp, factor, values.order, solution.upper)) {
    for (const State s : values.order) solution.upper[s] = infinity;
  }
  conclude(mdp, solution, settings.width);
}

std::vector<std::uint8_t> live_states(const Mdp& mdp, double discount) {
  if (discount == 1.0) return find_ending(mdp).live;
  std::vector<std::uint8_t> live(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) live[s] = mdp.terminal(s) ? 0 : 1;
  return live;
}

}  // namespace quoll
