#pragma once
// What a copy of a model in another format no longer says.

#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// What of the model `from` is missing or different in `to`, one phrase each: "the discount 0.9",
/// "the labels odd, low". Empty = nothing that counts: what `to` has more does not, nor the order
/// in which actions are numbered. Cost: one pass over both.
std::vector<std::string> losses(const Mdp& from, const Mdp& to);

}  // namespace quoll
