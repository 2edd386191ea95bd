#include "quoll/learn/tabular/planning.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "quoll/learn/tabular/model_writer.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Result<Mdp> model_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                     const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  ModelWriter writer(states, begin.back() + (planning.discount == 1.0 ? states : 0));
  for (State s = 0; s < states; ++s) {
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
std::vector<Action> policy_of(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                              const Planning& planning, const Solution& solution) {
  std::vector<Action> policy(begin.size() - 1, no_action);
  for (State s = 0; s < policy.size(); ++s) {
    Action left = solution.policy[s];
    for (std::uint64_t pair = begin[s]; pair < begin[s + 1]; ++pair) {
      if (model.tried(pair) < planning.known_after || left-- > 0) continue;
      policy[s] = static_cast<Action>(pair - begin[s]);
      break;
    }
  }
  return policy;
}

}  // namespace

Plan plan(const CountedModel& model, const std::vector<std::uint64_t>& begin,
          const Planning& planning) {
  const std::uint64_t states = begin.size() - 1;
  Plan result;
  result.state_value.assign(states, 0.0);
  result.pair_value.assign(begin.back(), -infinity);
  const Result<Mdp> mdp = model_of(model, begin, planning);
  if (!mdp) return result;
  SolveSettings settings;
  settings.width = planning.width;
  Result<Solution> solution = solve(*mdp, settings, planning.method);
  if (!solution) return result;
  result.solved = true;
  result.policy = policy_of(model, begin, planning, *solution);
  result.lower = std::move(solution->lower);
  result.upper = std::move(solution->upper);
  result.lower.pop_back();  // of the end of all ways
  result.upper.pop_back();
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
