#pragma once
// Whether a saved run is about the world of the command line.

#include <string>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"
#include "quoll/experiment/run.hpp"

namespace quoll::cli {

/// Nothing if the run in `file` learned this world: the same model, or, where no model is known,
/// the same built-in world with the same parameters, those left out at their standard. Else one
/// line with both.
Result<void> check_same_world(const Run& run, const std::string& file, const World& world);

}  // namespace quoll::cli
