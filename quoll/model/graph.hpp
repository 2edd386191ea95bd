#pragma once
// The model as a graph: who can be reached, who can reach an end, which cycles gain.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// States that can follow from `from` under some actions; ends are reached but not left.
std::vector<bool> reachable(const Mdp& mdp, std::span<const State> from);

/// States from which some sequence of actions reaches an end with positive probability.
std::vector<bool> can_end(const Mdp& mdp);

/// Why total reward without discounting is not defined here, if it is not.
struct UndiscountedFault {
  enum class Kind : std::uint8_t { none, no_end, gaining_cycle } kind = Kind::none;
  std::vector<State> states;  ///< those that cannot reach an end, or one cycle in order
};
/// Checks what discount 1 needs, over the states reachable from the start: every state can reach an
/// end, and no cycle of positive reward. Cycles are searched exactly in deterministic models; in others
/// over end components whose best choices have non-negative reward and some positive one.
UndiscountedFault undiscounted_fault(const Mdp& mdp);

}  // namespace quoll
