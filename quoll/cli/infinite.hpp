#pragma once
// How it is said that a reward until a goal is infinite.

#include <optional>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/solve/defined_part.hpp"

namespace quoll::cli {

/// The states without a finite value, ascending.
std::vector<State> infinite_states(const DefinedPart& outside);

/// A line for each reason, with the names of the states; empty if there are none.
std::string infinite_text(const Mdp& mdp, const DefinedPart& outside, bool minimise);

/// The Error that names the starts without a finite value, if there are any.
std::optional<Error> infinite_start(const Mdp& mdp, const DefinedPart& outside, bool minimise);

}  // namespace quoll::cli
