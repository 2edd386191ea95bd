#pragma once
// What the tests of table worlds ask of a model, by name.

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "quoll/env/world.hpp"

namespace quoll::world_tests {

inline World made(const std::string& name, const Parameters& parameters = {}) {
  Result<World> world = find_world(name, parameters);
  EXPECT_TRUE(world) << (world ? "" : message(world.error()));
  return std::move(*world);
}

/// The reward of an action, and where it leads; for a deterministic move.
struct Led {
  std::string to;
  double reward;
};
inline Led led(const Mdp& mdp, const std::string& state, const std::string& action) {
  const std::optional<State> found = mdp.find_state(state);
  const State s = found.value_or(0);
  EXPECT_TRUE(found) << state;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (mdp.action_name(c) != action) continue;
    EXPECT_EQ(mdp.outcome_end(c) - mdp.outcome_begin(c), 1u) << state << " " << action;
    return {mdp.state_name(mdp.next(mdp.outcome_begin(c))), mdp.reward(c)};
  }
  ADD_FAILURE() << state << " has no " << action;
  return {"", 0.0};
}

/// Probability that an action leads to a state.
inline double probability(const Mdp& mdp, const std::string& state, const std::string& action,
                          const std::string& to) {
  const std::optional<State> found = mdp.find_state(state);
  const State s = found.value_or(0);
  EXPECT_TRUE(found) << state;
  double sum = 0.0;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (mdp.action_name(c) != action) continue;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      if (mdp.state_name(mdp.next(o)) == to) sum += mdp.probability(o);
    }
  }
  return sum;
}

}  // namespace quoll::world_tests
