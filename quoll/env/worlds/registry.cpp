// The built-in worlds, one line each. A world file of worlds/ is built in under its own name.

#include "quoll/env/world.hpp"
#include "quoll/env/worlds/adventure.hpp"

namespace quoll {
namespace {

constexpr WorldEntry entries[] = {
    {"adventure", "", "the lecture's game: six places, two ways to the goal", adventure},
};

}  // namespace

std::span<const WorldEntry> worlds() {
  return entries;
}

}  // namespace quoll
