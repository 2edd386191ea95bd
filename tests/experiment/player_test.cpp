#include "quoll/experiment/player.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

Tree numbers(const std::vector<double>& of) {
  Tree::List list;
  for (const double x : of) list.emplace_back(x);
  return Tree(std::move(list));
}

TEST(Player, AGivenEndIsShownAsOne) {
  const auto pole = find_world("cartpole");
  ASSERT_TRUE(pole);
  Player player(*pole, Lanes(), 1.0);
  ASSERT_TRUE(player.restart(numbers({3.0, 0.0, 0.0, 0.0})));  // beyond the track, +-2.4
  EXPECT_TRUE(player.now().terminated);
  EXPECT_TRUE(player.now().over());
  EXPECT_EQ(player.now().t, 0u);
  ASSERT_TRUE(player.restart(numbers({2.399, 100.0, 0.0, 0.0})));  // about to leave it
  EXPECT_FALSE(player.now().over());
  player.step(1);
  EXPECT_TRUE(player.now().terminated);
}

TEST(Player, AGameThatIsOverIsShownAsOver) {
  const auto game = find_world("minatar-breakout", {{"sticky", "0"}});
  ASSERT_TRUE(game);
  Player player(*game, Lanes(), 1.0);
  player.restart();
  EXPECT_FALSE(player.now().over());
  while (!player.now().over()) player.step(1);  // to the left, away from the ball
  const Tree last = player.now().state;
  player.restart();
  ASSERT_TRUE(player.restart(last));
  EXPECT_TRUE(player.now().terminated);
}

// In every world: the beginning of an episode, given as data, is no end, and the last state is one.
TEST(Player, StatesGivenBackAreTheEndsTheyWere) {
  for (const WorldEntry* const entry : worlds()) {
    if (entry->offer) continue;  // takes long to make
    const auto world = entry->make({});
    ASSERT_TRUE(world) << entry->name;
    Player player(*world, Lanes(), 1.0);
    player.restart();
    const Tree first = player.now().state;
    Rng dice = stream(1, "test");
    for (int i = 0; i < 2000 && !player.now().over(); ++i)
      player.step(dice.below(player.actions()));
    const Tree last = player.now().state;
    const bool ended = player.now().terminated;
    ASSERT_TRUE(player.restart(first)) << entry->name;
    EXPECT_FALSE(player.now().terminated) << entry->name;
    ASSERT_TRUE(player.restart(last)) << entry->name;
    EXPECT_EQ(player.now().terminated, ended) << entry->name;
  }
}

}  // namespace
}  // namespace quoll
