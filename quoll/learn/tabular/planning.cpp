#include "quoll/learn/tabular/planning.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "quoll/learn/tabular/model_writer.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The states to plan for. Where little is known, the others have no choice but to be stuck: they
/// are left out if each pair has one outcome only, which changes no bit of the rest.
struct Scope {
  std::vector<State> states;   // ascending
  std::vector<State> numbers;  // per state of the world its place among them; empty = all are
};

Scope scope_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
               const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  Scope scope;
  if (!planning.unknown && planning.known_after == 1 && model.outcomes() < states / 4) {
    std::vector<std::uint8_t> met(states, 0);
    std::uint64_t tried = 0;
    for (State s = 0; s < states; ++s) {
      for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
        if (model.tried(pair) == 0) continue;
        ++tried;
        met[s] = 1;
        model.each(pair, [&](const CountedModel::Outcome& seen) {
          if (seen.next != the_end) met[seen.next] = 1;
        });
      }
    }
    if (tried == model.outcomes()) {
      // One of the others stays for all of them.
      State other = 0;
      while (other < states && (met[other] != 0 || begin[other] == begin[other + 1])) ++other;
      if (other < states) met[other] = 1;
      scope.numbers.assign(states, 0);
      for (State s = 0; s < states; ++s) {
        if (met[s] == 0) continue;
        scope.numbers[s] = static_cast<State>(scope.states.size());
        scope.states.push_back(s);
      }
      return scope;
    }
  }
  scope.states.resize(states);
  std::iota(scope.states.begin(), scope.states.end(), State{0});
  return scope;
}

Result<Mdp> model_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                     const Planning& planning, const Scope& scope) {
  const std::uint64_t states = scope.states.size();
  ModelWriter writer(states, model.outcomes() + states, scope.numbers);
  for (const State s : scope.states) {
    writer.begin_state();
    bool stuck = true, unknown = false;
    for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
      if (model.tried(pair) < planning.known_after) {
        unknown = true;
      } else {
        writer.take(model, pair, planning.bonus ? planning.bonus(pair) : 0.0);
        stuck = false;
      }
    }
    if (unknown && planning.unknown) writer.leave(*planning.unknown);
    const bool acts = begin[s] < begin[s + 1];
    if (acts && (planning.discount == 1.0 || (stuck && !planning.unknown))) {
      writer.leave(planning.stuck);
    }
  }
  return writer.model(planning.discount);
}

// The solver's choices of a state are its known pairs, in order, then ways out.
Action action_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                 const Planning& planning, State s, Action left) {
  for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
    if (model.tried(pair) < planning.known_after || left-- > 0) continue;
    return static_cast<Action>(pair - begin[s]);
  }
  return no_action;
}

// What the solver found in the states it was asked about; the others are stuck.
void spread(const CountedModel& model, const std::vector<std::uint64_t>& begin,
            const Planning& planning, const Scope& scope, Solution& solution, Plan& plan) {
  const std::uint64_t states = begin.size() - 1;
  plan.policy.assign(states, no_action);
  for (std::size_t i = 0; i < scope.states.size(); ++i) {
    const State s = scope.states[i];
    plan.policy[s] = action_of(model, begin, planning, s, solution.policy[i]);
  }
  if (scope.numbers.empty()) {
    plan.lower = std::move(solution.lower);
    plan.upper = std::move(solution.upper);
    plan.lower.pop_back();  // of the end of all ways
    plan.upper.pop_back();
    return;
  }
  plan.lower.resize(states);
  for (State s = 0; s < states; ++s) plan.lower[s] = begin[s] < begin[s + 1] ? planning.stuck : 0.0;
  plan.upper = plan.lower;
  for (std::size_t i = 0; i < scope.states.size(); ++i) {
    plan.lower[scope.states[i]] = solution.lower[i];
    plan.upper[scope.states[i]] = solution.upper[i];
  }
}

}  // namespace

Plan plan(const CountedModel& model, const std::vector<std::uint64_t>& begin,
          const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  Plan result;
  result.state_value.assign(states, 0.0);
  result.pair_value.assign(begin.back(), -infinity);
  const Scope scope = scope_of(model, begin, planning);
  const Result<Mdp> mdp = model_of(model, begin, planning, scope);
  if (!mdp) return result;
  SolveSettings settings;
  settings.width = planning.width;
  Result<Solution> solution = solve(*mdp, settings, planning.method);
  if (!solution) return result;
  result.solved = true;
  spread(model, begin, planning, scope, *solution, result);
  for (State s = 0; s < states; ++s) {
    result.state_value[s] = (result.lower[s] + result.upper[s]) / 2;
  }
  for (std::uint64_t pair = 0; pair < begin.back(); ++pair) {
    if (model.tried(pair) >= planning.known_after) {
      result.pair_value[pair] =
          (planning.bonus ? planning.bonus(pair) : 0.0) +
          model.backup(pair, planning.discount, [&](State s) { return result.state_value[s]; });
    } else if (planning.unknown) {
      result.pair_value[pair] = *planning.unknown;
    }
  }
  return result;
}

}  // namespace quoll
