// The built-in worlds, two lines each: its entry is declared, and listed. A world file of worlds/
// is built in under its own name.

#include "quoll/env/world.hpp"

namespace quoll {

extern const WorldEntry adventure_world;

namespace {

constexpr const WorldEntry* entries[] = {
    &adventure_world,
};

}  // namespace

std::span<const WorldEntry* const> worlds() {
  return entries;
}

}  // namespace quoll
