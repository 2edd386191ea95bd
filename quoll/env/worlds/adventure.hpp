#pragma once
// The lecture's adventure game, as worlds/adventure.toml says it.

#include "quoll/env/world.hpp"

namespace quoll {

/// Takes no parameters.
Result<World> adventure(const std::vector<std::pair<std::string, std::string>>& parameters);

/// The text of the world file, for copying and tests.
std::string_view adventure_toml();

}  // namespace quoll
