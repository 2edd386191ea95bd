#pragma once
// What `quoll race` prints beside its table.

#include <string>

#include "quoll/experiment/heat.hpp"

namespace quoll::cli {

/// The race as one JSON object; every heat is in it.
std::string race_json(const RaceResult& race);

}  // namespace quoll::cli
