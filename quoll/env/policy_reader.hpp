#pragma once
// A player who moves as a saved policy says, for worlds that take one as a parameter. What a saved
// run is, this floor does not know: whoever can read one says so once, at the program's beginning.

#include <string>
#include <string_view>

#include "quoll/base/error.hpp"

namespace quoll {

/// A policy file as text in CSV, header state,action, names as in the world called `world`. Error:
/// not a policy of that world, among others.
using PolicyReader = Result<std::string> (*)(const std::string& path, std::string_view world);

/// Files that end in .csv are read as they are; .json and .quoll by the reader that was set.
Result<std::string> read_policy_text(const std::string& path, std::string_view world);

/// For the beginning of a program, before any world is opened; nullptr takes it back.
void set_policy_reader(PolicyReader reader);

/// Whether a text is the name of a policy file, by its ending.
bool names_a_policy(std::string_view text);

}  // namespace quoll
