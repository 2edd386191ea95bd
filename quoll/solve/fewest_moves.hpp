#pragma once
// Deterministic models in which fewer moves to an end are always better, as mazes: states equally
// far from an end are worth the same, so that a breadth-first search tells everything.

#include <optional>

#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

/// The rewards of a deterministic model that has only two: one for each move to a state that is no
/// end, one for each move to an end. Such a model is solved by counting moves.
struct TwoRewards {
  double move = 0.0;
  double end = 0.0;
};
std::optional<TwoRewards> two_rewards(const Mdp& mdp);
/// Whether with these rewards fewer moves to an end are always at least as good (strictly: always
/// better), and never ending is not better than any of it.
bool fewer_moves_win(const TwoRewards& rewards, const Discount& discount, bool strictly);

/// Where fewer moves win: sets the policy to the first action that brings an end nearer, or to the
/// first action where no way ends. Then, if all states have a way to an end, lower and upper: what
/// evaluate_graph gives for this policy and raise_until_inductive leaves as it is, found once for
/// each number of moves. False: not so, and only the policy is set. Cost: a few passes over the
/// moves.
bool solve_by_moves(const Mdp& mdp, const TwoRewards& rewards, const Discount& discount,
                    Solution& solution);

}  // namespace quoll
