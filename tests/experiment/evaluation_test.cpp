#include "quoll/experiment/evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../learn/worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// Five cells: four steps of nothing, then 1. Discounted 0.9^4 = 0.6561.
TEST(Play, FollowsThePolicyToTheEnd) {
  const World world = corridor(5);
  std::vector<Action> right(world.mdp->states(), 1);
  const Played played = play(world, TablePolicy(right), 10, 1, 0.9, 100);
  EXPECT_EQ(played.episodes, 10u);
  EXPECT_EQ(played.mean, 1.0);
  EXPECT_NEAR(played.mean_discounted, 0.6561, 1e-15);
  EXPECT_EQ(played.mean_steps, 5.0);
  EXPECT_EQ(played.ended, 1.0);
}

TEST(Play, EndsWhereThePolicyKnowsNothingAndAtTheCut) {
  const World world = corridor(5);
  std::vector<Action> left(world.mdp->states(), 0), none(world.mdp->states(), no_action);
  Played played = play(world, TablePolicy(left), 3, 1, 0.9, 7);
  EXPECT_EQ(played.mean_steps, 7.0);
  EXPECT_EQ(played.unknown, 0.0);
  EXPECT_EQ(played.ended, 0.0);
  played = play(world, TablePolicy(none), 3, 1, 0.9, 7);
  EXPECT_EQ(played.mean_steps, 0.0);
  EXPECT_EQ(played.unknown, 1.0);
  EXPECT_EQ(play(world, TablePolicy(left), 0, 1, 0.9, 7).mean, 0.0);
  EXPECT_EQ(play(world, TablePolicy(left), 3, 1, 0.9, 0).mean_steps, 0.0);
}

// A game that is told to stop counts what it has played, and nothing else.
TEST(Play, StopsBeforeAnEpisodeWhenTold) {
  const World world = slippery(5);
  const TablePolicy right(std::vector<Action>(world.mdp->states(), 1));
  int asked = 0;
  const Played some = play(world, right, 10, 1, 0.9, 100, [&] { return ++asked <= 3; });
  const Played three = play(world, right, 3, 1, 0.9, 100);
  EXPECT_EQ(some.episodes, 3u);
  EXPECT_EQ(some.mean, three.mean);
  EXPECT_EQ(some.mean_steps, three.mean_steps);
  EXPECT_EQ(play(world, right, 10, 1, 0.9, 100, [] { return false; }).episodes, 0u);
}

// Draw at once: 8 or 0. 10,000 episodes: 4 within 5 * 4 / 100 = 0.2 (false alarm 1 in 1.7 million).
TEST(Play, UsesTheWorldsOwnChance) {
  World world = lottery();
  MdpBuilder builder(0.5);
  builder.move("B", "draw", "END", 8.0, 0.5).move("B", "draw", "END", 0.0, 0.5);
  world = to_world("prize", *builder.build());
  const Played played = play(world, TablePolicy({0, no_action}), 10'000, 1, 0.5, 10);
  EXPECT_NEAR(played.mean, 4.0, 0.2);
  EXPECT_EQ(played.mean, play(world, TablePolicy({0, no_action}), 10'000, 1, 0.5, 10).mean);
  EXPECT_NE(played.mean, play(world, TablePolicy({0, no_action}), 10'000, 2, 0.5, 10).mean);
}

// Sorted 1 2 3 4 5 6 7 100: mean 16, median 4.5, middle half 3..6: 4.5.
TEST(Statistics, OfEightValues) {
  const double values[] = {7, 1, 100, 3, 2, 6, 4, 5};
  const Statistics all = statistics(values);
  EXPECT_EQ(all.mean, 16.0);
  EXPECT_EQ(all.median, 4.5);
  EXPECT_EQ(all.iqm, 4.5);
  EXPECT_EQ(all.minimum, 1.0);
  ASSERT_TRUE(all.lower && all.upper);
  EXPECT_LT(*all.lower, 16.0);
  EXPECT_GT(*all.upper, 16.0);
  EXPECT_GE(*all.lower, 1.0);
  EXPECT_LE(*all.upper, 100.0);
  const double again[] = {100, 7, 6, 5, 4, 3, 2, 1};
  EXPECT_EQ(statistics(again).lower, all.lower);  // the order of the seeds does not matter
}

TEST(Statistics, OfFewValues) {
  EXPECT_EQ(statistics({}).mean, 0.0);
  const double one[] = {3.0}, two[] = {1.0, 2.0}, same[] = {5.0, 5.0, 5.0};
  EXPECT_EQ(statistics(one).iqm, 3.0);
  EXPECT_FALSE(statistics(one).lower);
  EXPECT_EQ(statistics(two).median, 1.5);
  EXPECT_EQ(statistics(two).iqm, 1.5);
  EXPECT_EQ(statistics(same).lower, 5.0);
  EXPECT_EQ(statistics(same).upper, 5.0);
}

// 400 samples of 20 uniform numbers: the 95 % interval of the bootstrap covers 1/2 in about 93 % of
// them (it is a little short for 20 values); outside [89 %, 97 %] lies 3 deviations away.
TEST(Statistics, TheIntervalCoversTheMean) {
  Rng rng = stream(4, "samples");
  int covered = 0;
  for (int sample = 0; sample < 400; ++sample) {
    std::vector<double> values(20);
    for (double& value : values) value = rng.uniform();
    const Statistics all = statistics(values);
    covered += *all.lower <= 0.5 && 0.5 <= *all.upper;
  }
  EXPECT_GE(covered, 356);
  EXPECT_LE(covered, 388);
}

}  // namespace
}  // namespace quoll
