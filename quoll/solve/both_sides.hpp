#pragma once
// A game of two below discount 1 in which one of them, or both, keep to what they do: a model of
// one player, which the methods for such models judge also where states come again.

#include <span>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Twice the states of a game, without turns: state s is s with the first player to move, whose
/// value this is, state states + s is s with the second one to move, whose rewards count against
/// the first one. With a policy the second player keeps to it; where it has no_action he may do
/// anything, which is then up to the first one. Twice the game's memory at most.
Result<Mdp> both_sides(const Mdp& game, std::span<const Action> policy_of_second = {});

}  // namespace quoll
