#include "quoll/experiment/race_suite.hpp"

#include "quoll/base/text.hpp"
#include "quoll/experiment/race.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t any = 1'000'000, few = 3;

// name, world, parameters, goal, from, discount, seeds at most, note
constexpr SuiteWorld standard[] = {
    {"adventure", "adventure", "", "", "", 0.8, any, "the lecture's game"},
    {"river-swim", "river-swim", "variant=osband", "", "", 0.99, any, ""},
    {"combination-lock", "combination-lock", "length=20", "", "", 0.99, any, ""},
    {"deep-sea", "deep-sea", "size=20 mapping_seed=1", "", "", 0.99, any,
     "cells off the triangle are no states here: 420 pairs, not 800"},
    {"cliff-walking", "cliff-walking", "", "", "", 0.99, any, ""},
    {"windy-grid", "windy-grid", "", "", "", 0.99, any, ""},
    {"frozen-lake", "frozen-lake", "map=8x8", "", "", 0.99, any, ""},
    {"taxi", "taxi", "", "", "", 0.99, any, "starts in any of 300 states"},
    {"garnet", "garnet", "states=100 actions=4 branching=5", "", "s0", 0.95, any,
     "every pair earns a reward from the normal distribution"},
    {"inventory", "inventory", "capacity=20", "", "stock-0", 0.95, any, ""},
    {"puddle", "puddle", "size=20 slip=0.1", "", "r19c0", 0.99, any, ""},
    {"maze-50", "maze", "size=70", "r69c69", "", 0.99, any,
     "as many free cells as 50 x 50 rooms; reward 1 at the goal"},
    {"maze-500", "maze", "size=700", "r699c699", "", 0.99, few,
     "as many free cells as 500 x 500 rooms; reward 1 at the goal"},
    {"krk", "krk", "", "", "", 0.99, few, "chess, king and rook against king; starts anywhere"},
};

constexpr SuiteWorld fresh[] = {
    {"garnet-a", "garnet", "states=100 actions=4 branching=5 seed=1001", "", "s0", 0.95, any, ""},
    {"garnet-b", "garnet", "states=50 actions=3 branching=3 seed=1002", "", "s0", 0.95, any, ""},
    {"garnet-c", "garnet", "states=200 actions=5 branching=10 seed=1003", "", "s0", 0.95, any, ""},
    {"garnet-d", "garnet", "states=100 actions=2 branching=2 seed=1004", "", "s0", 0.99, any, ""},
    {"garnet-e", "garnet", "states=30 actions=8 branching=4 seed=1005", "", "s0", 0.9, any, ""},
    {"maze-a", "maze", "size=70 seed=1001", "r69c69", "", 0.99, any, ""},
    {"maze-b", "maze", "size=30 seed=1002 braid=1", "r29c29", "", 0.99, any, ""},
    {"maze-c", "maze", "size=100 seed=1003 braid=0", "r99c99", "", 0.99, any, "one way only"},
    {"inventory-a", "inventory", "capacity=30 mean=8 order_cost=10", "", "stock-0", 0.95, any, ""},
    {"inventory-b", "inventory", "capacity=15 mean=3 holding_cost=0.5", "", "stock-0", 0.9, any,
     ""},
};

constexpr Suite all[] = {
    {"standard", "The worlds the methods' settings were chosen with", standard},
    {"fresh", "Worlds never used to choose a setting", fresh},
};

Parameters parameters_of(const SuiteWorld& row) {
  Parameters parameters;
  for (const std::string_view pair : split(row.with, ' ')) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos) continue;
    parameters.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  if (!row.goal.empty()) parameters.emplace_back("--goal", row.goal);
  return parameters;
}

}  // namespace

std::span<const Suite> suites() {
  return all;
}

const Suite* find_suite(std::string_view name) {
  for (const Suite& suite : all) {
    if (suite.name == name) return &suite;
  }
  return nullptr;
}

Result<World> open_world(const SuiteWorld& row) {
  Result<World> world = find_world(std::string(row.world), parameters_of(row));
  if (!world || row.from.empty()) return world;
  return world_from(*world, std::string(row.from));
}

std::string command_of(const SuiteWorld& row) {
  std::string command(row.world);
  for (const auto& [key, value] : parameters_of(row)) {
    command += key == "--goal" ? " --goal " + value : " --with " + key + "=" + value;
  }
  if (!row.from.empty()) command += " --from " + std::string(row.from);
  return command + " --discount " + shortest(row.discount);
}

}  // namespace quoll
