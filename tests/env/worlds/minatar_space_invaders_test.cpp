#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

// The aliens at these cells, with timers that let nothing happen in this step.
Fields quiet(const Cells& aliens) {
  return {
      {"aliens", board(aliens)}, {"alien_move_timer", number(3)}, {"alien_shot_timer", number(3)}};
}

Cells field() {
  Cells cells;
  for (int y = 0; y < 4; ++y) {
    for (int x = 2; x < 8; ++x) cells.emplace_back(x, y);
  }
  return cells;
}

TEST(SpaceInvaders, Start) {
  Game game("minatar-space-invaders");
  EXPECT_EQ(game.at("aliens"), board(field()));
  game.step(stay);
  EXPECT_EQ(game.cells(0), (Cells{{5, 9}}));
  EXPECT_EQ(game.cells(1), field());
  EXPECT_EQ(game.cells(2), field());
  EXPECT_EQ(game.cells(3), Cells{});
}

// The bullet leaves row 9 in the step that fires it; the next one can be fired five steps later.
TEST(SpaceInvaders, Firing) {
  Game game("minatar-space-invaders");
  game.step(fire);
  EXPECT_EQ(game.at("bullets"), board({{5, 8}}));
  EXPECT_EQ(game.whole("shot_timer"), 4);
  for (int t = 0; t < 4; ++t) game.step(fire);
  EXPECT_EQ(game.at("bullets"), board({{5, 4}}));
  const Feedback feedback = game.step(fire);  // an alien at (5, 3)
  EXPECT_EQ(feedback.reward, 1.0);
  EXPECT_EQ(game.at("bullets"), board({{5, 8}}));
  EXPECT_EQ(game.cells(1).size(), 23u);
}

TEST(SpaceInvaders, BulletsLeaveAtTheTop) {
  Game game("minatar-space-invaders");
  game.set(quiet({{0, 5}}));
  game.set({{"bullets", board({{3, 0}, {4, 1}})}});
  game.step(stay);
  EXPECT_EQ(game.at("bullets"), board({{4, 0}}));
}

TEST(SpaceInvaders, AliensMoveSideways) {
  Game game("minatar-space-invaders");
  game.set(quiet({{2, 3}, {5, 1}}));
  game.set({{"alien_move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.at("aliens"), board({{1, 3}, {4, 1}}));
  EXPECT_EQ(game.whole("alien_move_timer"), 1);  // two aliens, less the step
  game.set({{"aliens", board(field())}, {"alien_move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.whole("alien_move_timer"), 11);  // the interval, 12
}

TEST(SpaceInvaders, AliensTurnAndComeDownAtTheEdgeTheyFace) {
  Game game("minatar-space-invaders");
  const Cells both{{0, 3}, {9, 5}};
  game.set(quiet(both));
  game.set({{"alien_move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.at("aliens"), board({{0, 4}, {9, 6}}));
  EXPECT_EQ(game.words("alien_direction"), "right");
  game.set({{"alien_move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.at("aliens"), board({{0, 5}, {9, 7}}));
  EXPECT_EQ(game.words("alien_direction"), "left");
  game.set(quiet({{9, 3}}));  // on the other edge: sideways
  game.set({{"alien_move_timer", number(0)}});
  game.step(stay);
  EXPECT_EQ(game.at("aliens"), board({{8, 3}}));
}

// Turning with an alien on row 9 is the end, and that alien comes back in row 0.
TEST(SpaceInvaders, Landing) {
  Game game("minatar-space-invaders");
  game.set(quiet({{0, 9}, {3, 4}}));
  EXPECT_FALSE(game.step(stay).terminated);
  game.set({{"alien_move_timer", number(0)}});
  EXPECT_TRUE(game.step(stay).terminated);
  EXPECT_EQ(game.at("aliens"), board({{0, 0}, {3, 5}}));
}

TEST(SpaceInvaders, WhatMeetsTheCannonEnds) {
  Game game("minatar-space-invaders");
  const auto ends = [&](const Cells& aliens, const Cells& bullets, int move_timer, Action action) {
    game.set(quiet(aliens));
    game.set({{"alien_bullets", board(bullets)},
              {"alien_move_timer", number(move_timer)},
              {"alien_direction", word("left")},
              {"x", number(5)},
              {"over", Tree(false)}});
    return game.step(action).terminated;
  };
  EXPECT_TRUE(ends({{1, 1}}, {{5, 8}}, 3, stay));
  EXPECT_FALSE(ends({{1, 1}}, {{5, 8}}, 3, left));  // the cannon moves first
  EXPECT_TRUE(ends({{1, 1}}, {{4, 8}}, 3, left));
  EXPECT_FALSE(ends({{1, 1}}, {{5, 9}}, 3, stay));  // it leaves the grid
  EXPECT_TRUE(ends({{5, 9}}, {}, 3, stay));
  EXPECT_TRUE(ends({{6, 9}}, {}, 0, stay));          // moves onto it
  EXPECT_TRUE(ends({{0, 1}, {5, 8}}, {}, 0, stay));  // comes down onto it
}

// The column nearest to the cannon, of two the left one; its lowest alien; the bullet stays there.
TEST(SpaceInvaders, WhoShoots) {
  Game game("minatar-space-invaders");
  const auto shot = [&](const Cells& aliens, int x) {
    game.set(quiet(aliens));
    game.set({{"alien_shot_timer", number(0)},
              {"alien_bullets", board({})},
              {"x", number(x)},
              {"over", Tree(false)}});
    game.step(stay);
    EXPECT_EQ(game.whole("alien_shot_timer"), 9);
    return game.at("alien_bullets");
  };
  EXPECT_EQ(shot({{3, 1}, {3, 6}, {3, 4}, {7, 8}}, 5), board({{3, 6}}));
  EXPECT_EQ(shot({{2, 1}, {7, 8}}, 5), board({{7, 8}}));
  EXPECT_EQ(shot({{0, 0}}, 9), board({{0, 0}}));
  EXPECT_EQ(shot({{9, 2}, {9, 1}}, 0), board({{9, 2}}));
  EXPECT_EQ(shot({{4, 2}, {5, 0}}, 5), board({{5, 0}}));
}

TEST(SpaceInvaders, EveryHitCounts) {
  Game game("minatar-space-invaders");
  game.set(quiet({{1, 1}, {2, 5}, {3, 3}}));
  game.set({{"bullets", board({{1, 2}, {2, 6}, {7, 5}})}});
  EXPECT_EQ(game.step(stay).reward, 2.0);
  EXPECT_EQ(game.at("aliens"), board({{3, 3}}));
  EXPECT_EQ(game.at("bullets"), board({{7, 4}}));
}

// A cleared field: 24 new aliens that keep the direction, and an interval shorter by 1, down to 6.
TEST(SpaceInvaders, ANewField) {
  Game game("minatar-space-invaders");
  const auto clear = [](Game& in, int interval) {
    in.set(quiet({{3, 3}}));
    in.set({{"bullets", board({{3, 4}})},
            {"alien_interval", number(interval)},
            {"alien_direction", word("right")}});
    EXPECT_EQ(in.step(stay).reward, 1.0);
    EXPECT_EQ(in.at("aliens"), board(field()));
    EXPECT_EQ(in.words("alien_direction"), "right");
    return in.whole("alien_interval");
  };
  EXPECT_EQ(clear(game, 12), 11);
  EXPECT_EQ(game.whole("ramp_index"), 1);
  EXPECT_EQ(clear(game, 6), 6);
  EXPECT_EQ(game.whole("ramp_index"), 1);
  Game flat("minatar-space-invaders", {{"ramping", "false"}});
  EXPECT_EQ(clear(flat, 12), 12);
}

}  // namespace
}  // namespace quoll::minatar_tests
