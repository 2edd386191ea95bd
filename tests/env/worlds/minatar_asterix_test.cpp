#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

Tree crosser(const char* kind, int x, bool rightwards) {
  return object({{"kind", word(kind)}, {"x", number(x)}, {"right", Tree(rightwards)}});
}

// Rows 1 to 8, all empty but those given.
Tree rows(const std::vector<std::pair<int, Tree>>& taken) {
  Tree::List all(8, crosser("none", 0, false));
  for (const auto& [row, what] : taken) all[row - 1] = what;
  return Tree(std::move(all));
}

// The move timer, 5 at first, is 0 at the sixth and at the eleventh step.
TEST(Asterix, SomethingAppearsAtTheEleventhStep) {
  Game game("minatar-asterix");
  for (int t = 0; t < 10; ++t) game.step(stay);
  EXPECT_EQ(game.whole("spawn_timer"), 0);
  EXPECT_EQ(game.whole("move_timer"), 0);
  EXPECT_EQ(game.at("rows"), rows({}));
  game.step(stay, {0.49, 0.3, 2});  // from the left, gold, the third free row; then it moves
  EXPECT_EQ(game.at("rows"), rows({{3, crosser("gold", 1, true)}}));
  EXPECT_EQ(game.whole("spawn_timer"), 9);
  game.set({{"spawn_timer", number(0)}});
  game.step(stay, {0.5, 0.34, 2});  // row 3 is taken: the third free one is row 4
  EXPECT_EQ(game.at("rows"),
            rows({{3, crosser("gold", 1, true)}, {4, crosser("enemy", 9, false)}}));
  EXPECT_TRUE(game.draws_left());
  // Trails lie behind, where that is in the grid.
  EXPECT_EQ(game.cells(2), (Cells{{0, 3}}));
  game.set({{"move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.cells(3), (Cells{{2, 3}}));
  EXPECT_EQ(game.cells(1), (Cells{{8, 4}}));
  EXPECT_EQ(game.cells(2), (Cells{{1, 3}, {9, 4}}));
  EXPECT_EQ(game.cells(0), (Cells{{5, 5}}));
}

// Two draws and no third when every row is taken; the timer restarts.
TEST(Asterix, NothingAppearsInAFullGrid) {
  Game game("minatar-asterix");
  const Tree full(Tree::List(8, crosser("gold", 2, true)));
  game.set({{"rows", full}, {"spawn_timer", number(0)}});
  game.step(stay, {0.1, 0.1});
  game.step(stay);
  EXPECT_TRUE(game.draws_left());
  EXPECT_EQ(game.whole("spawn_timer"), 8);
}

TEST(Asterix, GoldIsTakenAndEnemiesEnd) {
  Game game("minatar-asterix");
  game.set({{"rows", rows({{5, crosser("gold", 6, true)}})}});
  EXPECT_EQ(game.step(right).reward, 1.0);
  EXPECT_EQ(game.at("rows"), rows({}));
  game.set({{"rows", rows({{6, crosser("enemy", 6, true)}})}});
  const Feedback end = game.step(down);
  EXPECT_TRUE(end.terminated);
  EXPECT_EQ(end.reward, 0.0);
}

// The player is touched after its own move and after theirs: gold that comes is taken too.
TEST(Asterix, TouchedTwiceInAStep) {
  Game game("minatar-asterix");
  game.set({{"rows", rows({{5, crosser("gold", 4, true)}})}, {"move_timer", number(0)}});
  EXPECT_EQ(game.step(stay).reward, 1.0);
  game.set({{"rows", rows({{5, crosser("enemy", 6, false)}})}, {"move_timer", number(0)}});
  EXPECT_TRUE(game.step(stay).terminated);
  // Changing places is the touch of the player's move; the enemy then moves on all the same.
  Game other("minatar-asterix");
  other.set({{"rows", rows({{5, crosser("enemy", 6, false)}})}, {"move_timer", number(0)}});
  EXPECT_TRUE(other.step(right).terminated);
  EXPECT_EQ(other.at("rows"), rows({{5, crosser("enemy", 5, false)}}));
}

TEST(Asterix, WhatLeavesTheGridIsGone) {
  Game game("minatar-asterix");
  game.set({{"rows", rows({{1, crosser("gold", 9, true)}, {2, crosser("enemy", 0, false)}})},
            {"move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.at("rows"), rows({}));
  EXPECT_EQ(game.whole("move_timer"), 4);
}

TEST(Asterix, ThePlayerStaysInRows1To8) {
  Game game("minatar-asterix");
  game.set({{"x", number(0)}, {"y", number(1)}});
  game.step(left);
  game.step(up);
  EXPECT_EQ(game.whole("x"), 0);
  EXPECT_EQ(game.whole("y"), 1);
  game.set({{"x", number(9)}, {"y", number(8)}});
  game.step(right);
  game.step(down);
  EXPECT_EQ(game.whole("x"), 9);
  EXPECT_EQ(game.whole("y"), 8);
}

// 100 falls to -1 in 101 steps; the step after that ramps: every 102 steps.
TEST(Asterix, TheRamp) {
  Game game("minatar-asterix");
  const auto quiet = [&](int steps) {
    for (int t = 0; t < steps; ++t) {
      game.set({{"spawn_timer", number(1)}});
      game.step(stay);
    }
  };
  quiet(101);
  EXPECT_EQ(game.whole("ramp_timer"), -1);
  EXPECT_EQ(game.whole("spawn_speed"), 10);
  quiet(1);
  EXPECT_EQ(game.whole("ramp_timer"), 100);
  EXPECT_EQ(game.whole("spawn_speed"), 9);
  EXPECT_EQ(game.whole("move_speed"), 5);  // index 0 is even
  EXPECT_EQ(game.whole("ramp_index"), 1);
  quiet(102);
  EXPECT_EQ(game.whole("spawn_speed"), 8);
  EXPECT_EQ(game.whole("move_speed"), 4);
  game.set({{"spawn_speed", number(1)}, {"move_speed", number(1)}, {"ramp_timer", number(-1)}});
  quiet(1);
  EXPECT_EQ(game.whole("ramp_timer"), -1);
  EXPECT_EQ(game.whole("ramp_index"), 2);
}

TEST(Asterix, WithoutRamping) {
  Game game("minatar-asterix", {{"ramping", "false"}});
  game.set({{"ramp_timer", number(-1)}});
  game.step(stay);
  EXPECT_EQ(game.whole("ramp_timer"), -1);
  EXPECT_EQ(game.whole("spawn_speed"), 10);
}

}  // namespace
}  // namespace quoll::minatar_tests
