#pragma once
// What the checker needs to know about ends: who can reach one, and who is sure to. Graphs only, no
// numbers; nothing is shared with the solvers.

#include <optional>
#include <span>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// States from which the policy's moves lead to an end with positive probability; only the moves
/// from `claimed` states count. Where those states never leave each other but for an end, each that
/// is among the answer is sure to end. O(outcomes of the policy's choices).
std::vector<bool> policy_ends(const Mdp& mdp, std::span<const Action> policy,
                              const std::vector<bool>& claimed);

/// A state that can come again, if there is one. O(size).
std::optional<State> returning(const Mdp& mdp);

/// States from which some policy ends with probability 1 (de Alfaro 1997, section 3.1). O(size) a
/// round; each round but the last finds a state that cannot.
std::vector<bool> some_policy_ends(const Mdp& mdp);

}  // namespace quoll
