#pragma once
// What the tests of table worlds ask: the optimal value of a state, by name.

#include <gtest/gtest.h>

#include <string>

#include "quoll/env/world.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::world_tests {

struct Solved {
  World world;
  Solution solution;

  const Mdp& mdp() const { return *world.mdp; }
  State state(const std::string& name) const {
    const auto found = mdp().find_state(name);
    EXPECT_TRUE(found) << name;
    return found.value_or(0);
  }
  /// Middle of the certified interval.
  double value(State s) const { return (solution.lower[s] + solution.upper[s]) / 2; }
  double value(const std::string& name) const { return value(state(name)); }
  double start() const { return value(mdp().start()[0]); }
  std::string action(const std::string& name) const {
    const State s = state(name);
    return mdp().action_name(mdp().choice_begin(s) + solution.policy[s]);
  }
};

/// The world solved to intervals of 1e-9 (or as asked), with another discount if one is given.
inline Solved solved(const std::string& name, const Parameters& parameters = {},
                     double discount = 0.0, double width = 1e-9) {
  Result<World> world = find_world(name, parameters);
  EXPECT_TRUE(world) << (world ? "" : message(world.error()));
  SolveSettings settings;
  settings.width = width;
  if (discount > 0.0) settings.discount = discount;
  Result<Solution> solution = solve(*world->mdp, settings);
  EXPECT_TRUE(solution) << (solution ? "" : message(solution.error()));
  EXPECT_TRUE(solution->converged);
  return {std::move(*world), std::move(*solution)};
}

}  // namespace quoll::world_tests
