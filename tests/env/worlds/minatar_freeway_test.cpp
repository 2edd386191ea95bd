#include "minatar_game.hpp"

namespace quoll::minatar_tests {
namespace {

// Speeds 1, 2, 3, 4, 5, 1, 1, 1, the first four to the left.
std::vector<double> draws() {
  return {0, 1, 2, 3, 4, 0, 0, 0, 0.1, 0.2, 0.3, 0.4999, 0.5001, 0.6, 0.7, 0.8};
}

Tree eight(std::vector<int> values) {
  Tree::List list;
  for (const int value : values) list.push_back(number(value));
  return Tree(std::move(list));
}

Tree all(int value) {
  return eight(std::vector<int>(8, value));
}

TEST(Freeway, Step2501IsTheLast) {
  Game game("minatar-freeway", {}, draws());
  for (int t = 1; t <= 2500; ++t) ASSERT_FALSE(game.step(stay).terminated) << t;
  EXPECT_TRUE(game.step(stay).terminated);
  EXPECT_EQ(game.whole("steps_left"), -1);
}

TEST(Freeway, Start) {
  Game game("minatar-freeway", {}, draws());
  EXPECT_TRUE(game.draws_left());
  EXPECT_EQ(game.at("car_speed"), eight({-1, -2, -3, -4, 5, 1, 1, 1}));
  EXPECT_EQ(game.at("car_timer"), eight({1, 2, 3, 4, 5, 1, 1, 1}));
  EXPECT_EQ(game.at("car_x"), all(0));
  EXPECT_EQ(game.whole("y"), 9);
  EXPECT_EQ(game.whole("move_timer"), 3);
}

// A car of speed k moves on every (k+1)-th step, around the edge; its trail too goes around.
TEST(Freeway, CarsMoveAndTrail) {
  Game game("minatar-freeway", {}, draws());
  game.step(stay);
  EXPECT_EQ(game.cells(1).size(), 8u);
  EXPECT_EQ(game.cells(2), (Cells{{1, 1}, {9, 6}, {9, 7}, {9, 8}}));
  EXPECT_EQ(game.cells(3), (Cells{{1, 2}}));
  EXPECT_EQ(game.cells(6), (Cells{{9, 5}}));
  game.step(stay);
  EXPECT_EQ(game.at("car_x"), eight({9, 0, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(game.at("car_timer"), eight({1, 0, 1, 2, 3, 1, 1, 1}));
  EXPECT_EQ(game.cells(2), (Cells{{0, 1}, {0, 6}, {0, 7}, {0, 8}}));
  for (int t = 2; t < 6; ++t) game.step(stay);
  EXPECT_EQ(game.at("car_x"), eight({7, 8, 9, 9, 1, 3, 3, 3}));
}

TEST(Freeway, MovesOnEveryThirdStep) {
  Game game("minatar-freeway", {}, draws());
  for (int t = 0; t < 3; ++t) game.step(up);
  EXPECT_EQ(game.whole("y"), 9);
  game.step(up);
  EXPECT_EQ(game.whole("y"), 8);
  EXPECT_EQ(game.whole("move_timer"), 2);
  game.step(up);
  game.step(up);
  EXPECT_EQ(game.whole("y"), 8);
  game.step(down);
  EXPECT_EQ(game.whole("y"), 9);
}

// Down at the lowest row takes the move as well; other actions do not.
TEST(Freeway, DownAtTheBottomTakesTheMove) {
  Game game("minatar-freeway", {}, draws());
  game.set({{"move_timer", number(0)}});
  game.step(left);
  game.step(fire);
  EXPECT_EQ(game.whole("move_timer"), 0);
  game.step(down);
  EXPECT_EQ(game.whole("move_timer"), 2);
  EXPECT_EQ(game.whole("y"), 9);
}

// Cars keep their places, get new speeds, and move in the same step's count of their timers.
TEST(Freeway, ACrossing) {
  Game game("minatar-freeway", {}, draws());
  game.set(
      {{"y", number(1)}, {"move_timer", number(0)}, {"car_x", eight({1, 2, 3, 4, 5, 6, 7, 8})}});
  const Feedback feedback =
      game.step(up, {4, 3, 2, 1, 0, 0, 0, 0, 0.9, 0.9, 0.1, 0.1, 0.5, 0.5, 0.2, 0.2});
  EXPECT_TRUE(game.draws_left());
  EXPECT_EQ(feedback.reward, 1.0);
  EXPECT_EQ(game.whole("y"), 9);
  EXPECT_EQ(game.at("car_speed"), eight({5, 4, -3, -2, 1, 1, -1, -1}));
  EXPECT_EQ(game.at("car_timer"), eight({4, 3, 2, 1, 0, 0, 0, 0}));
  EXPECT_EQ(game.at("car_x"), eight({1, 2, 3, 4, 5, 6, 7, 8}));
  game.step(stay);
  EXPECT_TRUE(game.draws_left());
}

// A car in the chicken's column hits before it leaves and after it comes.
TEST(Freeway, Hits) {
  Game game("minatar-freeway", {}, draws());
  const auto after = [&](int x, int timer, int speed, int y, Action action) {
    EXPECT_EQ(game.set({{"y", number(y)},
                        {"move_timer", number(0)},
                        {"car_x", eight({0, 0, x, 0, 0, 0, 0, 0})},
                        {"car_timer", eight({5, 5, timer, 5, 5, 5, 5, 5})},
                        {"car_speed", eight({5, 5, speed, 5, 5, 5, 5, 5})}}),
              "");
    EXPECT_EQ(game.step(action).reward, 0.0);
    return game.whole("y");
  };
  EXPECT_EQ(after(4, 2, 3, 3, stay), 9);   // stands there
  EXPECT_EQ(after(4, 0, 3, 3, stay), 9);   // leaves
  EXPECT_EQ(after(3, 0, 3, 3, stay), 9);   // comes
  EXPECT_EQ(after(5, 0, -3, 3, stay), 9);  // comes from the right
  EXPECT_EQ(after(3, 1, 3, 3, stay), 3);   // not yet
  EXPECT_EQ(after(4, 2, 3, 4, up), 9);     // walked into
  EXPECT_EQ(after(4, 2, 3, 3, up), 2);     // walked away from
}

}  // namespace
}  // namespace quoll::minatar_tests
