// Learning from each step once, and what is scaled as it is seen.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../resume.hpp"
#include "../worlds.hpp"
#include "quoll/learn/deep/running_scale.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// 1, 2, 3, 4, 5: mean 3, variance (4 + 1 + 0 + 1 + 4) / 4.
TEST(RunningScale, IsTheMeanAndTheDeviationOfTheSample) {
  RunningScale scale(2);
  EXPECT_NEAR(scale.deviation(0), 1.0, 1e-8);
  for (int i = 1; i <= 5; ++i) {
    const float row[] = {static_cast<float>(i), 7.0F};
    scale.add(std::span<const float>(row));
    if (i == 1) {
      EXPECT_NEAR(scale.deviation(0), 1.0, 1e-8);
    }
  }
  EXPECT_DOUBLE_EQ(scale.mean(0), 3.0);
  EXPECT_NEAR(scale.deviation(0), std::sqrt(2.5), 1e-8);
  EXPECT_DOUBLE_EQ(scale.mean(1), 7.0);
  EXPECT_NEAR(scale.deviation(1), 1e-4, 1e-12);
}

LearnSettings stream() {
  LearnSettings settings;
  settings.method = "stream-q";
  settings.until_stable = false;
  return settings;
}

TEST(StreamQ, FindsTheWayInSmallWorlds) {
  for (const World& world : {adventure(), corridor(5), without_model(corridor(5))}) {
    LearnSettings settings = stream();
    settings.epsilon = "1:0.05:5000";
    const auto one = learner(settings, world);
    one->advance(20'000, {});
    const Estimates estimates = one->estimates();
    const std::vector<Action> policy = greedy_policy(estimates);
    for (const double q : estimates.q) EXPECT_TRUE(std::isfinite(q));
    if (world.name == "adventure") {
      // CAVE and WELL reach the goal at once.
      EXPECT_EQ(world.mdp->action_name(world.mdp->choice_begin(3) + policy[3]), "To-GOAL");
      EXPECT_EQ(world.mdp->action_name(world.mdp->choice_begin(4) + policy[4]), "To-GOAL");
    } else {
      for (std::size_t s = 0; s < 5; ++s) EXPECT_EQ(policy[s], 1u) << s;
    }
  }
}

// Episodes of one step, cut off: what follows counts (80 = 0.8 x 100 at HALL), and no trace reaches
// the step before.
TEST(StreamQ, ACutCountsWhatFollowsAndEndsTheTraces) {
  const World world = adventure();
  std::vector<double> values;
  for (const double lambda : {0.0, 0.9}) {
    LearnSettings settings = stream();
    settings.episode_steps = 1;
    settings.of_method.trace_decay = lambda;
    settings.epsilon = "1";
    const auto one = learner(settings, world);
    one->advance(20'000, {});
    const Estimates estimates = one->estimates();
    EXPECT_NEAR(estimates.q[estimates.row_begin[1]], 80.0, 0.5);
    if (values.empty()) values = estimates.q;
    EXPECT_EQ(estimates.q, values) << lambda;
  }
}

// An exploring step ends the traces: where steps one to three explored, lambda did nothing. One of
// up to nine actions is greedy, so most seeds explore in all of the steps that could hand on.
TEST(StreamQ, AnExploringStepEndsTheTraces) {
  const World world = *find_world("tic-tac-toe");
  int alike = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<double> values[2];
    for (const bool traces : {false, true}) {
      LearnSettings settings = stream();
      settings.seed = seed;
      settings.epsilon = "1";
      settings.of_method.trace_decay = traces ? 0.9 : 0.0;
      const auto one = learner(settings, world);
      one->advance(4, {});
      values[traces] = one->estimates().q;
    }
    alike += values[0] == values[1];
  }
  EXPECT_GE(alike, 10);
  EXPECT_LT(alike, 20);
}

// What is observed and earned on other scales is learned with the same numbers.
TEST(StreamQ, RewardsOfAnotherUnitChangeNoChoice) {
  LearnSettings settings = stream();
  const World world = *find_world("cartpole");
  const auto plain = learner(settings, world);
  settings.deep.reward_scale = 1024.0;  // a power of two: the same digits
  const auto scaled = learner(settings, world);
  plain->advance(3000, {});
  scaled->advance(3000, {});
  // The constant beside the variance differs: by 1e-8 of it, which moves no early choice.
  EXPECT_EQ(plain->progress().episodes, scaled->progress().episodes);
}

TEST(StreamQ, AResumedRunIsTheWholeRunWhereNumbersAreScaled) {
  const World world = *find_world("cartpole");
  const auto whole = learner(stream(), world);
  whole->advance(3000, {});
  for (const std::uint64_t cut : {1u, 500u, 2999u}) {
    const auto first = learner(stream(), world);
    first->advance(cut, {});
    const auto second = learner(stream(), world);
    ASSERT_NO_FATAL_FAILURE(resume(*first, *second));
    second->advance(3000 - cut, {});
    EXPECT_EQ(saved(*second), saved(*whole)) << cut;
  }
}

}  // namespace
}  // namespace quoll
