#include "quoll/learn/tabular/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// R = 100, discount 0.8: B = 500; reported from above 500 (1 + 1e-5) = 500.005 on.
TEST(Guard, ReportsTheFirstValueAboveTheBound) {
  Guard guard(500.0, 0.8, 0.0);
  EXPECT_TRUE(guard.fine(500.0));
  EXPECT_TRUE(guard.fine(-500.004));
  EXPECT_FALSE(guard.fine(500.006));
  Impossible first;
  EXPECT_FALSE(guard.halts(500.006, 0.0, {false, 7, 1, 2, 0.0, 0.0}, first));
  EXPECT_TRUE(first.found);
  EXPECT_EQ(first.step, 7u);
  EXPECT_EQ(first.value, 500.006);
  EXPECT_EQ(first.bound, 500.0);
  // Only the first is kept; learning goes on until the numbers are hopeless.
  EXPECT_TRUE(guard.fine(1e29));
  EXPECT_TRUE(guard.halts(1e31, 0.0, {false, 9, 0, 0, 0.0, 0.0}, first));
  EXPECT_EQ(first.step, 7u);
}

// Discount 0.5: the largest reward met so far, 3, allows 6, then 4 allows 8; the initial value 7
// too.
TEST(Guard, TakesTheLargestRewardMetWhereNoneIsDeclared) {
  Guard guard(0.0, 0.5, 7.0);
  Impossible first;
  EXPECT_FALSE(guard.halts(6.5, 3.0, {}, first));
  EXPECT_FALSE(guard.halts(7.5, 4.0, {}, first));
  EXPECT_FALSE(first.found);
  EXPECT_TRUE(guard.fine(8.0));
  EXPECT_FALSE(guard.fine(8.1));
  EXPECT_FALSE(guard.halts(8.1, 4.0, {}, first));
  EXPECT_TRUE(first.found);
  EXPECT_EQ(first.bound, 8.0);
}

TEST(Guard, WithoutDiscountOnlyHopelessNumbersHalt) {
  Guard guard(0.0, 1.0, 0.0);
  EXPECT_TRUE(guard.fine(1e30));
  for (const double value : {1.1e30, -1.1e30, HUGE_VAL, std::nan("")}) {
    EXPECT_FALSE(guard.fine(value));
    Impossible first;
    EXPECT_TRUE(guard.halts(value, 0.0, {}, first));
    EXPECT_TRUE(first.found);
  }
}

TEST(Guard, CatchesTheRuleAsPrinted) {
  LearnSettings settings;
  settings.rule = "as-printed";
  settings.until_stable = false;
  const World world = adventure();
  const auto one = learner(settings, world);
  const LearnProgress now = one->advance(100'000, {});
  ASSERT_TRUE(now.impossible.found);
  EXPECT_NEAR(now.impossible.bound, 500.0, 1e-9);  // 100 / (1 - 0.8)
  EXPECT_GT(now.impossible.value, 500.0);
}

TEST(Guard, StaysQuietWithEverySoundRule) {
  for (const World& world : {adventure(), slippery(5), lottery(), without_model(lottery())}) {
    for (const char* rule : {"standard", "reward-estimate"}) {
      LearnSettings settings;
      settings.rule = rule;
      settings.initial_value = "7";
      settings.until_stable = false;
      const auto one = learner(settings, world);
      const LearnProgress now = one->advance(50'000, {});
      EXPECT_FALSE(now.impossible.found) << world.name << " " << rule;
      EXPECT_EQ(now.steps, 50'000u);
    }
  }
}

// A cycle that gains 1e29 a step at discount 1 passes 1e30 at its 11th step, where learning halts.
TEST(Guard, HaltsWhereValuesGrowWithoutEnd) {
  MdpBuilder builder(1.0);
  builder.move("A", "round", "A", 1e29).move("A", "end", "END", 0.0);
  LearnSettings settings;
  settings.explore = "greedy";
  settings.ties = Ties::first;
  settings.precision = Precision::twofold;
  const auto one = learner(settings, to_world("pump", *builder.build()));
  const LearnProgress now = one->advance(1000, {});
  EXPECT_EQ(now.halt, LearnProgress::Halt::diverged);
  EXPECT_GE(now.steps, 10u);  // the sum of ten roundings may lie a little above 1e30
  EXPECT_LE(now.steps, 11u);
  EXPECT_EQ(now.impossible.state, 0u);
  EXPECT_EQ(one->advance(1000, {}).steps, now.steps);
}

}  // namespace
}  // namespace quoll
