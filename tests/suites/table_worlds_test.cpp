// Table worlds solved exactly, against the answers their sources publish.

#include <cmath>

#include "solved.hpp"

namespace quoll {
namespace {

using world_tests::solved;

// Sutton, Barto 2018, example 6.5 ("15 steps is the minimum") and the known answer of exercise 6.9.
TEST(TableWorlds, WindyGrid) {
  EXPECT_NEAR(solved("windy-grid").start(), -15, 1e-6);
  EXPECT_NEAR(solved("windy-grid", {{"moves", "eight"}}).start(), -7, 1e-6);
  EXPECT_NEAR(solved("windy-grid", {{"moves", "nine"}}).start(), -7, 1e-6);
  EXPECT_LT(solved("windy-grid", {{"moves", "eight"}, {"stochastic", "true"}}).start(), -7);
}

// bsuite's optimal return: 1 - move_cost. Stochastic: the first fault of a right ends the hope,
// and from then on left costs nothing, so V = sum over k of (1 - 1/N)^k (-move_cost / N) and
// (1 - 1/N)^(N-1); bsuite's (1 - 1/N)^(N-1) - move_cost counts the cost as if it were always paid.
TEST(TableWorlds, DeepSea) {
  EXPECT_NEAR(solved("deep-sea").start(), 0.99, 1e-9);
  EXPECT_NEAR(solved("deep-sea", {{"size", "30"}, {"mapping_seed", "7"}}).start(), 0.99, 1e-9);
  double cost = 0.0;
  for (int k = 0; k < 10; ++k) cost += std::pow(0.9, k) * 0.001;
  const double value = solved("deep-sea", {{"stochastic", "true"}}).start();
  EXPECT_NEAR(value, std::pow(0.9, 9) - cost, 1e-9);
  EXPECT_GT(value, std::pow(0.9, 9) - 0.01);
}

// Lengths of the shortest paths: 14 in figure 8.2, 10 and 16 in figures 8.4 and 8.5; the reward
// comes with the last move.
TEST(TableWorlds, DynaMazes) {
  const auto start = [](const char* map, const char* stage) {
    return solved("dyna-maze", {{"map", map}, {"stage", stage}}).start();
  };
  EXPECT_NEAR(start("dyna", "before"), std::pow(0.95, 13), 1e-9);
  EXPECT_NEAR(start("blocking", "before"), std::pow(0.95, 9), 1e-9);
  EXPECT_NEAR(start("blocking", "after"), std::pow(0.95, 15), 1e-9);
  EXPECT_NEAR(start("shortcut", "before"), std::pow(0.95, 15), 1e-9);
  EXPECT_NEAR(start("shortcut", "after"), std::pow(0.95, 9), 1e-9);
}

// Without slip the best way from a cell beside no puddle is the shortest one, if it can pass.
TEST(TableWorlds, Puddle) {
  const auto dry = solved("puddle", {{"slip", "0"}});
  EXPECT_NEAR(dry.value("r0c0"), -19, 1e-9);
  EXPECT_NEAR(dry.value("r19c19"), -19, 1e-9);
  EXPECT_NEAR(dry.value("r19c0"), -38, 1e-9);
  EXPECT_LT(solved("puddle").value("r0c0"), -19);
}

TEST(TableWorlds, MazeByAnyNumbering) {
  const auto rows = solved("maze", {{"size", "31"}});
  const auto shuffled = solved("maze", {{"size", "31"}, {"numbering", "shuffled"}});
  for (State s = 0; s < rows.mdp().states(); ++s) {
    EXPECT_EQ(rows.value(s), shuffled.value(rows.mdp().state_name(s)));
  }
}

}  // namespace
}  // namespace quoll
