#pragma once
// A network that is taught a table: the lecture's labelled data from interim results of Q-learning.
// The learner "distil" has no experience of its own; a step of it is an update.

#include <optional>
#include <vector>

#include "quoll/learn/learner.hpp"
#include "quoll/nn/network.hpp"

namespace quoll {

/// Hands a table to a learner of the method "distil", before its first step: what it is to say of
/// each visited pair, and the visits that it tells of from then on. Rows are those of the world. Of
/// the states with a visited pair only the `share` is taught, drawn by the learner's seed: the
/// others show what the network makes of what it has not seen. Cost: O(pairs).
void teach(Learner& distilled, const Estimates& table, double share = 1.0);

/// Per state, whether it was kept from a learner of the method "distil".
const std::vector<std::uint8_t>& withheld(const Learner& distilled);

/// The factor for `reward_scale` that brings the largest visited value of a table to between 1/2
/// and 1: a power of two, so that scaling rounds nothing.
double scale_of(const Estimates& table);

/// Per state, whether the action that `q` prefers is among the best of the table (values within
/// 1e-9 of the best one, relative to it); nothing where the table knows no action. Only visited
/// actions count; ties of `q` go to the first. The rows agree.
std::vector<std::optional<bool>> agreement(const Estimates& table, const Estimates& q);

}  // namespace quoll
