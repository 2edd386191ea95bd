#pragma once
// The model as a graph: who can be reached, who can reach an end, which cycles gain.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// States that can follow from `from` under some actions; ends are reached but not left.
std::vector<bool> reachable(const Mdp& mdp, std::span<const State> from);

/// States from which some sequence of actions reaches an end with positive probability.
std::vector<bool> can_end(const Mdp& mdp);

/// Number of moves on the shortest way to an end, per state, every outcome counting as a way;
/// unreached = no way. Cost: one reverse breadth-first search, 12 bytes per state, 4 per outcome.
inline constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max();
std::vector<std::uint32_t> moves_to_end(const Mdp& mdp);
/// The same to the nearest of these states; ends are not left.
std::vector<std::uint32_t> moves_to(const Mdp& mdp, std::span<const State> targets);
/// Number of moves on the shortest way from any of `from`, per state.
std::vector<std::uint32_t> moves_from(const Mdp& mdp, std::span<const State> from);

/// Strongly connected component of each state; ends are not left. Numbered in reverse topological
/// order: a move never leads to a component of higher number. Gabow 2000, without recursion.
/// Empty if a component has more than `most` states, which is found out early if it is large.
std::vector<std::uint32_t> strongly_connected(const Mdp& mdp, std::uint64_t most = max_states);

/// States that can come again after they were left, ascending; empty = the model is acyclic.
std::vector<State> returning_states(const Mdp& mdp);

inline constexpr std::uint32_t no_component = std::numeric_limits<std::uint32_t>::max();
/// Maximal end components: largest sets of states, not ends, in which one can stay for ever with
/// probability 1 and go from each to each. A choice stays inside if all its outcomes lie in the
/// component of its state.
struct EndComponents {
  std::vector<std::uint32_t> component;  ///< per state; no_component = in none
  std::uint32_t count = 0;               ///< components are numbered by their lowest state
  std::vector<bool> inside;              ///< per choice: allowed, and stays in its component
};
/// Uses only choices c with allowed_choice[c]; an empty vector allows all. de Alfaro 1997,
/// algorithm 3.1: components are split until stable. Memory: 8 bytes per outcome while it runs.
EndComponents maximal_end_components(const Mdp& mdp, const std::vector<bool>& allowed_choice = {});

/// Whether staying in an end component for ever can earn more than 0 per move. Certain in spite of
/// rounding; undecided = the bounds are still apart after a fixed amount of work.
enum class Gain : std::uint8_t { none, certain, undecided };
/// Per component of `parts`, over the choices inside. Puterman 1994, section 8.5: relative value
/// iteration, at most 10,000 sweeps and about 1e9 outcomes per component; components without a
/// positive reward cost nothing.
std::vector<Gain> component_gains(const Mdp& mdp, const EndComponents& parts);
/// Per state of a component without a gain a number h such that r + sum of p (h(s') - h(s)) <= 0 to
/// within rounding for the choices inside; 0 elsewhere. Cost: as component_gains.
std::vector<double> component_heights(const Mdp& mdp, const EndComponents& parts);
/// States one policy stays in for ever with a certain gain, ascending, going from each to each; of
/// the first component that has one. Empty = none certain. Cost: as component_gains.
std::vector<State> gaining_class(const Mdp& mdp, const EndComponents& parts);

/// Why total reward without discounting is not defined here, if it is not.
struct UndiscountedFault {
  enum class Kind : std::uint8_t { none, no_end, gaining_cycle, returning } kind = Kind::none;
  std::vector<State> states;  ///< those that cannot reach an end, or one cycle in order, or the
                              ///< states of a gaining end component, or the returning ones
};
/// Checks what discount 1 needs, over the states reachable from the start: every state can reach an
/// end, and no cycle of positive reward. Cycles are searched exactly in deterministic models (a
/// gain below 1e-12 of the largest |reward| per move counts as rounding); in others a set of states
/// that one policy stays in is a fault if its gain is certain (gaining_class), so that a gain too
/// small to be decided is not reported. Where two players move in turn no state may come again:
/// whether such a game ends is up to both.
UndiscountedFault undiscounted_fault(const Mdp& mdp);

/// States, reachable from the start or not, that can come to a part of the model that gains for
/// ever or of which that is undecided. Cost: as undiscounted_fault, on all states.
std::vector<bool> may_gain_for_ever(const Mdp& mdp);

}  // namespace quoll
