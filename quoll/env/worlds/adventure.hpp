#pragma once
// The lecture's adventure game, as worlds/adventure.toml says it.

#include <string_view>

namespace quoll {

/// The text of the world file, for copying and tests.
std::string_view adventure_toml();

}  // namespace quoll
