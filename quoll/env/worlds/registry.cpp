// The built-in worlds, two lines each: its entry is declared, and listed. A world file of worlds/
// is built in under its own name.

#include "quoll/env/world.hpp"

namespace quoll {

extern const WorldEntry acrobot_world;
extern const WorldEntry adventure_world;
extern const WorldEntry bicycle_world;
extern const WorldEntry blackjack_world;
extern const WorldEntry cartpole_world;
extern const WorldEntry chain_world;
extern const WorldEntry cliff_walking_world;
extern const WorldEntry combination_lock_world;
extern const WorldEntry connect_four_world;
extern const WorldEntry deep_sea_world;
extern const WorldEntry dyna_maze_world;
extern const WorldEntry forest_world;
extern const WorldEntry frozen_lake_world;
extern const WorldEntry gamblers_problem_world;
extern const WorldEntry garnet_world;
extern const WorldEntry gridworld_world;
extern const WorldEntry inventory_world;
extern const WorldEntry jacks_car_rental_world;
extern const WorldEntry krk_world;
extern const WorldEntry maze_world;
extern const WorldEntry minatar_asterix_world;
extern const WorldEntry minatar_breakout_world;
extern const WorldEntry minatar_freeway_world;
extern const WorldEntry minatar_seaquest_world;
extern const WorldEntry minatar_space_invaders_world;
extern const WorldEntry mountain_car_world;
extern const WorldEntry pendulum_world;
extern const WorldEntry puddle_world;
extern const WorldEntry racetrack_world;
extern const WorldEntry river_swim_world;
extern const WorldEntry taxi_world;
extern const WorldEntry tic_tac_toe_world;
extern const WorldEntry windy_grid_world;

namespace {

constexpr const WorldEntry* entries[] = {
    &acrobot_world,
    &adventure_world,
    &bicycle_world,
    &blackjack_world,
    &cartpole_world,
    &chain_world,
    &cliff_walking_world,
    &combination_lock_world,
    &connect_four_world,
    &deep_sea_world,
    &dyna_maze_world,
    &forest_world,
    &frozen_lake_world,
    &gamblers_problem_world,
    &garnet_world,
    &gridworld_world,
    &inventory_world,
    &jacks_car_rental_world,
    &krk_world,
    &maze_world,
    &minatar_asterix_world,
    &minatar_breakout_world,
    &minatar_freeway_world,
    &minatar_seaquest_world,
    &minatar_space_invaders_world,
    &mountain_car_world,
    &pendulum_world,
    &puddle_world,
    &racetrack_world,
    &river_swim_world,
    &taxi_world,
    &tic_tac_toe_world,
    &windy_grid_world,
};

}  // namespace

std::span<const WorldEntry* const> worlds() {
  return entries;
}

}  // namespace quoll
