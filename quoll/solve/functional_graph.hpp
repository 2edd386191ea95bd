#pragma once
// Deterministic models: a policy makes of the model a graph with one move per state. Its value is
// found exactly along the graph, with outward rounding: integers at discount 1 stay exact.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

inline constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

/// The values of one policy. States with mask 0 are not looked at: they keep the bounds they have.
struct GraphValues {
  std::vector<double> lower, upper;
  std::vector<State> order;  ///< the states evaluated, each after its successor (but cycles)
  std::vector<std::uint32_t> steps;  ///< moves until an end, or never
  std::vector<State> turns;          ///< one state of each cycle: all others follow from their next
};

/// Evaluates the policy of a deterministic model. `live[s]` = 0 marks non-terminal states that are
/// worth -infinity; empty = all live. A live state with no_action gets the widest bounds the
/// rewards allow. Cost: O(states), 30 ns each.
GraphValues evaluate_graph(const Mdp& mdp, std::span<const Action> policy, const Discount& discount,
                           std::span<const std::uint8_t> live = {});

/// Howard's improvement, certified: switches each live state to the action with the best lower
/// bound where that exceeds the state's upper bound. Returns the number of states switched.
std::uint64_t improve_policy(const Mdp& mdp, const GraphValues& values, const Discount& discount,
                             std::span<const std::uint8_t> live, std::vector<Action>& policy);

/// Raises `upper` until T upper <= upper holds with outward rounding in the states of `order`;
/// gives up after `sweeps` sweeps and then adds one constant everywhere, or at discount 1, if every
/// move costs something, lowers all costs by one share. False: not achieved.
bool raise_until_inductive(const Mdp& mdp, const Discount& discount, std::span<const State> order,
                           std::vector<double>& upper, unsigned sweeps = 64);

/// Lowers `lower` of `values`, just evaluated, until T_pi lower >= lower holds with outward
/// rounding in the states of its `order`, by one constant in all states where it is below `upper`.
/// Does nothing at discount 1, where a policy's bounds follow one from the other along its way to
/// an end. False: not achieved; the bounds are true all the same.
bool lower_until_inductive(const Mdp& mdp, const Discount& discount, std::span<const Action> policy,
                           GraphValues& values);

}  // namespace quoll
