#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

Fields ball(int x, int y, const char* direction, int paddle) {
  return {{"ball_x", number(x)},
          {"ball_y", number(y)},
          {"direction", word(direction)},
          {"paddle", number(paddle)}};
}

Cells all_bricks() {
  Cells cells;
  for (int y = 1; y <= 3; ++y) {
    for (int x = 0; x < 10; ++x) cells.emplace_back(x, y);
  }
  return cells;
}

TEST(Breakout, StartsAtEitherSide) {
  Game left_side("minatar-breakout", {}, {0}), right_side("minatar-breakout", {}, {1});
  EXPECT_EQ(left_side.whole("ball_x"), 0);
  EXPECT_EQ(left_side.words("direction"), "down-right");
  EXPECT_EQ(right_side.whole("ball_x"), 9);
  EXPECT_EQ(right_side.words("direction"), "down-left");
  EXPECT_EQ(right_side.whole("last_x"), 9);
  right_side.step(left);
  EXPECT_EQ(right_side.cells(0), (Cells{{3, 9}}));
  EXPECT_EQ(right_side.cells(1), (Cells{{8, 4}}));
  EXPECT_EQ(right_side.cells(2), (Cells{{9, 3}}));
  EXPECT_EQ(right_side.cells(3), all_bricks());
}

TEST(Breakout, ABrokenBrickTurnsTheBallInItsOldRow) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(4, 4, "up-right", 4));
  EXPECT_EQ(game.step(stay).reward, 1.0);
  EXPECT_EQ(game.whole("ball_x"), 5);
  EXPECT_EQ(game.whole("ball_y"), 4);
  EXPECT_EQ(game.words("direction"), "down-right");
  EXPECT_TRUE(game.flag("strike"));
  EXPECT_EQ(game.cells(3).size(), 29u);
}

// With a strike pending the ball enters bricks without breaking them; the strike ends on the first
// step without one.
TEST(Breakout, AfterAStrikeBricksArePassedThrough) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(4, 4, "up-right", 4));
  game.set({{"strike", Tree(true)}});
  EXPECT_EQ(game.step(stay).reward, 0.0);
  EXPECT_EQ(game.whole("ball_y"), 3);
  EXPECT_EQ(game.words("direction"), "up-right");
  EXPECT_TRUE(game.flag("strike"));
  EXPECT_EQ(game.cells(3), all_bricks());
  game.step(stay);
  game.step(stay);
  EXPECT_EQ(game.whole("ball_y"), 1);
  game.step(stay);  // row 0: no brick there
  EXPECT_FALSE(game.flag("strike"));
  EXPECT_EQ(game.step(stay).reward, 0.0);  // above the top: row 0 again, downwards
  EXPECT_EQ(game.whole("ball_y"), 0);
  EXPECT_EQ(game.words("direction"), "down-right");
  EXPECT_EQ(game.step(stay).reward, 1.0);  // off the side wall into the brick of (9, 1)
  EXPECT_EQ(game.whole("ball_x"), 9);
  EXPECT_EQ(game.whole("ball_y"), 0);
  EXPECT_EQ(game.words("direction"), "up-left");
}

TEST(Breakout, WallsAndCorner) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(0, 6, "up-left", 4));
  game.step(stay);
  EXPECT_EQ(game.whole("ball_x"), 0);
  EXPECT_EQ(game.whole("ball_y"), 5);
  EXPECT_EQ(game.words("direction"), "up-right");
  game.set(ball(9, 6, "down-right", 4));
  game.step(stay);
  EXPECT_EQ(game.whole("ball_x"), 9);
  EXPECT_EQ(game.words("direction"), "down-left");
  game.set(ball(0, 0, "up-left", 4));
  game.step(stay);
  EXPECT_EQ(game.whole("ball_x"), 0);
  EXPECT_EQ(game.whole("ball_y"), 0);
  EXPECT_EQ(game.words("direction"), "down-right");
}

// Under the ball's old column it bounces; under the new one it goes back where it came from.
TEST(Breakout, TwoWaysToMeetThePaddle) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(4, 8, "down-right", 4));
  EXPECT_FALSE(game.step(stay).terminated);
  EXPECT_EQ(game.whole("ball_x"), 5);
  EXPECT_EQ(game.whole("ball_y"), 8);
  EXPECT_EQ(game.words("direction"), "up-right");
  game.set(ball(4, 8, "down-right", 4));
  EXPECT_FALSE(game.step(right).terminated);  // the paddle moves first
  EXPECT_EQ(game.whole("ball_x"), 5);
  EXPECT_EQ(game.words("direction"), "up-left");
  game.set(ball(4, 8, "down-right", 4));
  EXPECT_TRUE(game.step(left).terminated);
  EXPECT_EQ(game.whole("ball_y"), 9);
}

// At a wall old and new column are the same.
TEST(Breakout, ThePaddleInTheCorner) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(0, 8, "down-left", 0));
  game.step(stay);
  EXPECT_EQ(game.words("direction"), "up-right");
  EXPECT_EQ(game.whole("ball_y"), 8);
}

// The bricks return when the ball reaches row 9 without any left, even when it is lost.
TEST(Breakout, BricksReturnAtThePaddlesRow) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(4, 7, "down-right", 4));
  game.set({{"bricks", board({})}});
  game.step(stay);
  EXPECT_EQ(game.cells(3), Cells{});
  game.step(stay);
  EXPECT_TRUE(game.flag("over"));
  EXPECT_EQ(game.cells(3), all_bricks());
}

TEST(Breakout, ThePaddleStaysInTheGrid) {
  Game game("minatar-breakout", {}, {0});
  game.set(ball(4, 5, "up-right", 0));
  game.step(left);
  EXPECT_EQ(game.whole("paddle"), 0);
  game.set({{"paddle", number(9)}});
  game.step(right);
  EXPECT_EQ(game.whole("paddle"), 9);
  game.step(up);
  game.step(fire);
  EXPECT_EQ(game.whole("paddle"), 9);
}

}  // namespace
}  // namespace quoll::minatar_tests
