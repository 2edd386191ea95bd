// Every rule on updates computed by hand, by replaying a script of transitions and by learning.
#include "quoll/learn/tabular/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "../worlds.hpp"
#include "quoll/learn/tabular/rule.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

struct Step {
  const char *state, *action, *next;
  double reward = 0.0;
  bool terminated = false;
};

std::vector<Update> replayed(const LearnerEntry& entry, const World& world, LearnSettings settings,
                             const std::vector<Step>& steps) {
  settings.rule = entry.rule;
  const auto setup = resolve(settings, world);
  EXPECT_TRUE(setup);
  std::vector<Update> script;
  for (const Step& step : steps) {
    Update update;
    update.step = script.size() + 1;
    update.state = *world.mdp->find_state(step.state);
    update.next = *world.mdp->find_state(step.next);
    update.reward = step.reward;
    update.terminated = step.terminated;
    for (Action a = 0; a < world.mdp->actions(update.state); ++a) {
      if (world.mdp->action_name(world.mdp->choice_begin(update.state) + a) == step.action) {
        update.action = a;
      }
    }
    script.push_back(update);
  }
  return entry.replay(*setup, script);
}

const std::vector<Step> slides = {{"HALL", "To-CAVE", "CAVE"},
                                  {"CAVE", "To-GOAL", "GOAL", 100, true},
                                  {"HALL", "To-CAVE", "CAVE"},
                                  {"HALL", "To-CAVE", "CAVE"},
                                  {"HALL", "To-CAVE", "CAVE"}};

// The lecture's trace: nothing, 100, 0.8 * 100 = 80, and then nothing changes any more.
TEST(Rules, StandardGivesTheSlides) {
  const auto updates = replayed(q_learning_standard, adventure(), {}, slides);
  const double expected[] = {0, 100, 80, 80, 80};
  for (std::size_t i = 0; i < slides.size(); ++i) EXPECT_EQ(updates[i].new_value, expected[i]);
  EXPECT_EQ(updates[2].old_value, 0.0);
  EXPECT_EQ(updates[2].best_next, 100.0);
  EXPECT_EQ(updates[2].target, 80.0);
  EXPECT_EQ(updates[2].step_size, 1.0);
}

// As printed rE takes over QE, so the future is counted again: 80, 80 + 80, 160 + 80.
TEST(Rules, AsPrintedCountsTheFutureAgain) {
  const auto updates = replayed(q_learning_as_printed, adventure(), {}, slides);
  const double expected[] = {0, 100, 80, 160, 240};
  for (std::size_t i = 0; i < slides.size(); ++i) EXPECT_EQ(updates[i].new_value, expected[i]);
  EXPECT_EQ(updates[3].reward, 80.0);
}

TEST(Rules, AsPrintedWithoutGivenRewardsLearnsNothing) {
  LearnSettings settings;
  settings.initial_rewards = "zero";
  for (const Update& update : replayed(q_learning_as_printed, adventure(), settings, slides)) {
    EXPECT_EQ(update.new_value, 0.0);
  }
}

TEST(Rules, RewardEstimateGivesTheSlides) {
  const auto updates = replayed(q_learning_reward_estimate, adventure(), {}, slides);
  const double expected[] = {0, 100, 80, 80, 80};
  for (std::size_t i = 0; i < slides.size(); ++i) EXPECT_EQ(updates[i].new_value, expected[i]);
}

// B draw: prizes 8, 0, 0 and 4: means 8, 4, 8/3, 3. A walk then is 0 + 0.5 * 3 = 1.5.
TEST(Rules, RewardEstimateIsTheMeanOfWhatWasSeen) {
  LearnSettings settings;
  settings.precision = Precision::twofold;
  const auto updates = replayed(q_learning_reward_estimate, lottery(), settings,
                                {{"B", "draw", "END", 8, true},
                                 {"B", "draw", "END", 0, true},
                                 {"B", "draw", "END", 0, true},
                                 {"B", "draw", "END", 4, true},
                                 {"A", "walk", "B"}});
  EXPECT_EQ(updates[0].new_value, 8.0);
  EXPECT_EQ(updates[1].new_value, 4.0);
  EXPECT_NEAR(updates[2].new_value, 8.0 / 3, 1e-15);
  EXPECT_NEAR(updates[3].new_value, 3.0, 1e-15);
  EXPECT_NEAR(updates[4].new_value, 1.5, 1e-15);
}

// Step size 1/2 from 4: A stay: best next is 4: target 1 + 0.5 * 4 = 3: 4 - 0.5 = 3.5; then target
// 1 + 0.5 * 4 (walk still has 4) = 3: 3.25.
TEST(Rules, AConstantStepGoesPartOfTheWay) {
  LearnSettings settings;
  settings.step_size = "0.5";
  settings.initial_value = "4";
  const auto updates = replayed(q_learning_standard, lottery(), settings,
                                {{"A", "stay", "A", 1}, {"A", "stay", "A", 1}});
  EXPECT_EQ(updates[0].target, 3.0);
  EXPECT_EQ(updates[0].new_value, 3.5);
  EXPECT_EQ(updates[1].new_value, 3.25);
}

// Discount 0.5, H = 2: steps (2 + 1) / (2 + N): 1, 3/4. B draw from 0: 8, then 8 + 3/4 (0 - 8) = 2.
TEST(Rules, DiminishingStepsCountTheVisitsOfTheirPair) {
  const auto updates = replayed(q_learning_standard, lottery(), {},
                                {{"B", "draw", "END", 8, true}, {"B", "draw", "END", 0, true}});
  EXPECT_EQ(updates[0].step_size, 1.0);
  EXPECT_EQ(updates[1].step_size, 0.75);
  EXPECT_EQ(updates[1].new_value, 2.0);
}

TEST(Rules, RoundingAtRandomIsRightOnAverage) {
  EXPECT_EQ(round_at_random(0.5, 0), 0.5f);
  const float low = 1.0f, high = std::nextafterf(1.0f, 2.0f);
  const double x = low + 0.25 * (double{high} - low);
  EXPECT_EQ(round_at_random(x, 0), high);
  EXPECT_EQ(round_at_random(x, 0x3fffffff), high);
  EXPECT_EQ(round_at_random(x, 0x40000000), low);
  EXPECT_EQ(round_at_random(x, nearest_rounding), low);
  EXPECT_EQ(round_at_random(-x, 0), -high);
  EXPECT_EQ(round_at_random(-x, 0x40000000), -low);
  EXPECT_EQ(round_at_random(1e300, 5), HUGE_VALF);
}

// One pair whose target is 1 +- 1 by a coin, learned as a running mean in a float. After N visits
// the coin itself leaves a deviation of 1 / sqrt(N) (3e-4 at 10^7, 1e-4 at 10^8), random rounding
// sqrt(ulp / 2) = 2.4e-4 at most; rounding to nearest would stand still from 1.7 * 10^7 visits on.
TEST(Rules, ANoisyMeanIsLearnedToAThousandth) {
  const bool full = std::getenv("QUOLL_FULL") != nullptr;
  MdpBuilder builder(0.5);
  builder.move("A", "toss", "END", 0.0, 0.5).move("A", "toss", "END", 2.0, 0.5);
  const World world = to_world("coin", *builder.build());
  for (const char* step : {"1/N", "rescaled-linear"}) {
    LearnSettings settings;
    settings.step_size = step;
    settings.until_stable = false;
    const auto one = learner(settings, world);
    one->advance(full ? 100'000'000 : 10'000'000, {});
    EXPECT_NEAR(one->estimates().q[0], 1.0, 1e-3) << step;
  }
}

// A constant step so small that its increments are below half an ulp of the float: from
// 100 towards 99 with 1e-7 moves 1e-7 a step. After 10^7 steps 99 + exp(-1) = 99.368, give or take
// sqrt(10^7 * 1e-7 * ulp) = 0.003.
TEST(Rules, ATinyConstantStepStillMoves) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "END", 99.0);
  LearnSettings settings;
  settings.step_size = "1e-7";
  settings.initial_value = "100";
  settings.until_stable = false;
  const auto one = learner(settings, to_world("slope", *builder.build()));
  one->advance(10'000'000, {});
  EXPECT_NEAR(one->estimates().q[0], 99.368, 0.015);
}

}  // namespace
}  // namespace quoll
