// The built-in worlds, two lines each: its entry is declared, and listed. A world file of worlds/
// is built in under its own name.

#include "quoll/env/world.hpp"

namespace quoll {

extern const WorldEntry adventure_world;
extern const WorldEntry bicycle_world;
extern const WorldEntry blackjack_world;
extern const WorldEntry cliff_walking_world;
extern const WorldEntry deep_sea_world;
extern const WorldEntry dyna_maze_world;
extern const WorldEntry frozen_lake_world;
extern const WorldEntry krk_world;
extern const WorldEntry maze_world;
extern const WorldEntry puddle_world;
extern const WorldEntry taxi_world;
extern const WorldEntry windy_grid_world;

namespace {

constexpr const WorldEntry* entries[] = {
    &adventure_world,
    &bicycle_world,
    &blackjack_world,
    &cliff_walking_world,
    &deep_sea_world,
    &dyna_maze_world,
    &frozen_lake_world,
    &krk_world,
    &maze_world,
    &puddle_world,
    &taxi_world,
    &windy_grid_world,
};

}  // namespace

std::span<const WorldEntry* const> worlds() {
  return entries;
}

}  // namespace quoll
