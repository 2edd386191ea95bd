#pragma once
// A saved policy as an opponent: what the worlds' own reader of .csv cannot read.

#include <string>
#include <string_view>

#include "quoll/base/error.hpp"
#include "quoll/env/policy_reader.hpp"

namespace quoll::cli {

/// A PolicyReader (env/policy_reader.hpp) for .json, as learn, solve and export write it, and for
/// .quoll, a saved run: greedy among the actions its first seed visited, or by what it observes
/// where it learned no table.
Result<SavedPolicy> opponent_policy(const std::string& path, std::string_view world,
                                    const Parameters& parameters);

}  // namespace quoll::cli
