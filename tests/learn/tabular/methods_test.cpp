// Methods with memory on chains small enough for pen and paper.

#include <gtest/gtest.h>

#include <cmath>

#include "../worlds.hpp"
#include "quoll/learn/readers.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

using namespace learn_tests;
using Table = std::vector<double>;

// A, B, C and the end in a row, one action each, rewards 1, 2, 4, discount 1/2.
World chain(bool alternating = false) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", 1).move("B", "go", "C", 2).move("C", "go", "END", 4);
  builder.start("A");
  builder.alternating(alternating);
  return to_world("chain", *builder.build());
}

LearnSettings half_steps(std::string_view method) {
  LearnSettings settings;
  settings.method = method;
  settings.step_size = "0.5";
  if (!ignores(**find_learner(settings), "precision")) settings.precision = Precision::twofold;
  settings.until_stable = false;
  return settings;
}

// The table after each of the first steps.
std::vector<Table> tables(const LearnSettings& settings, const World& world, int steps) {
  const auto one = learner(settings, world);
  std::vector<Table> all;
  for (int i = 0; i < steps; ++i) {
    one->advance(1, {});
    all.push_back(one->estimates().q);
  }
  return all;
}

// First episode: 0 + 1/2 (1 + 0 - 0) = 0.5; 1; 2. Second: A: 0.5 + 1/2 (1 + 1/2 * 1 - 0.5) = 1;
// B: 1 + 1/2 (2 + 1/2 * 2 - 1) = 2; C: 2 + 1/2 (4 - 2) = 3.
TEST(Methods, OneStepOnAChain) {
  const std::vector<Table> expected = {{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 2},
                                       {1, 1, 2},   {1, 2, 2},   {1, 2, 3}};
  for (const char* method : {"q-learning", "sarsa", "expected-sarsa"}) {
    EXPECT_EQ(tables(half_steps(method), chain(), 6), expected) << method;
  }
}

// n = 2. Step 1 waits. Step 2: G(A) = 1 + 1/2 (2 + 1/2 * 0) = 2, half of it 1. Step 3: G(B) = 2 +
// 1/2 * 4 = 4, half 2, and at the end C: half of 4. Again: 5: G(A) = 1 + 1/2 (2 + 1/2 * 2) = 2.5:
// 1 + 1/2 * 1.5 = 1.75; 6: G(B) = 4: 3, and C: 3.
TEST(Methods, TwoStepReturnsOnAChain) {
  const std::vector<Table> expected = {{0, 0, 0}, {1, 0, 0},    {1, 2, 2},
                                       {1, 2, 2}, {1.75, 2, 2}, {1.75, 3, 3}};
  for (const char* method : {"n-step", "tree-backup"}) {
    LearnSettings settings = half_steps(method);
    settings.of_method.return_steps = 2;
    EXPECT_EQ(tables(settings, chain(), 6), expected) << method;
    settings.of_method.return_steps = 1;
    EXPECT_EQ(tables(settings, chain(), 6), tables(half_steps("q-learning"), chain(), 6)) << method;
    settings.of_method.return_steps = 100;  // whole returns, at the end: 1 + 2/2 + 4/4, 2 + 4/2, 4
    EXPECT_EQ(tables(settings, chain(), 3), (std::vector<Table>{{0, 0, 0}, {0, 0, 0}, {1.5, 2, 2}}))
        << method;
  }
}

// The turn passes at each step, so what follows counts negative: C: 4; B: 2 - 1/2 * 4 = 0; A: 1 -
// 1/2 * 0 = 1. n = 3 sees that in one episode.
TEST(Methods, ReturnsChangeSignWhenTheTurnPasses) {
  for (const char* method : {"n-step", "tree-backup", "reverse-replay"}) {
    LearnSettings settings = half_steps(method);
    settings.step_size = "1";
    if (settings.method != "reverse-replay") settings.of_method.return_steps = 3;
    EXPECT_EQ(tables(settings, chain(true), 3).back(), (Table{1, 0, 4})) << method;
  }
  // An episode each to see C, B and A; double-q needs some more until both tables have.
  for (const LearnerEntry& entry : learners()) {
    if (entry.traits.directed || entry.traits.plans || !entry.sound || entry.traits.approximates ||
        entry.method == "dyna-q-plus")
      continue;
    LearnSettings settings = half_steps(entry.method);
    if (!entry.rule.empty()) settings.rule = entry.rule;
    settings.step_size = ignores(entry, "step_size") ? "auto" : "1";
    EXPECT_EQ(tables(settings, chain(true), 90).back(), (Table{1, 0, 4})) << entry.method;
  }
}

// lambda = 1/2: a pair k steps back gets (1/4)^k of the error. 1: error 1: A 0.5. 2: error 2: B 1,
// A 0.5 + 1/2 * 2/4 = 0.75. 3: error 4: C 2, B 1.5, A 0.75 + 1/2 * 4/16 = 0.875. The traces end
// with the episode: 4: error 1 + 1/2 * 1.5 - 0.875 = 0.875 changes A alone: 1.3125.
TEST(Methods, TracesCarryErrorsBackWithinAnEpisode) {
  LearnSettings settings = half_steps("q-lambda");
  settings.of_method.trace_decay = 0.5;
  EXPECT_EQ(tables(settings, chain(), 4),
            (std::vector<Table>{{0.5, 0, 0}, {0.75, 1, 0}, {0.875, 1.5, 2}, {1.3125, 1.5, 2}}));
  // (-1/4)^k when the turn passes. 2: error 2: A 0.5 - 1/4; 3: error 4: B 1 - 1/2, A 0.25 + 1/8.
  EXPECT_EQ(tables(settings, chain(true), 3),
            (std::vector<Table>{{0.5, 0, 0}, {0.25, 1, 0}, {0.375, 0.5, 2}}));
  // At lambda 0 it is Q-learning.
  settings.of_method.trace_decay = 0.0;
  EXPECT_EQ(tables(settings, chain(), 6), tables(half_steps("q-learning"), chain(), 6));
}

// Cut off after two steps: B still has a future, C's value; nothing goes on into the next episode.
// C begins at 8. Step 2: B: 1/2 (2 + 1/2 * 8) = 3. n = 2: G(A) = 1 + 1/2 * 6 = 4, half 2. lambda =
// 1/2: first error 1 + 1/2 * 8 = 5 (every pair begins at 8): see the lines.
TEST(Methods, CutEpisodesKeepTheirFuture) {
  LearnSettings settings = half_steps("sarsa");
  settings.episode_steps = 2;
  settings.initial_value = "8";
  // A: 8 + 1/2 (1 + 4 - 8) = 6.5; B: 8 + 1/2 (2 + 4 - 8) = 7; A: 6.5 + 1/2 (1 + 3.5 - 6.5) = 5.5.
  const std::vector<Table> one = {{6.5, 8, 8}, {6.5, 7, 8}, {5.5, 7, 8}};
  for (const char* method : {"q-learning", "sarsa", "expected-sarsa"}) {
    settings.method = method;
    EXPECT_EQ(tables(settings, chain(), 3), one) << method;
  }
  // G(A) = 1 + 1/2 (2 + 1/2 * 8) = 4: 6; then B towards 6: 7; and nothing is pending.
  for (const char* method : {"n-step", "tree-backup"}) {
    settings.method = method;
    settings.of_method.return_steps = 2;
    EXPECT_EQ(tables(settings, chain(), 3), (std::vector<Table>{{8, 8, 8}, {6, 7, 8}, {6, 7, 8}}))
        << method;
  }
  // Errors -3 and -2: A 6.5, then A 6.5 + 1/2 * -2/4 = 6.25 and B 7; the third, 1 + 3.5 - 6.25 =
  // -1.75, changes A alone: 5.375.
  settings.method = "q-lambda";
  settings.of_method = {.trace_decay = 0.5};
  EXPECT_EQ(tables(settings, chain(), 3),
            (std::vector<Table>{{6.5, 8, 8}, {6.25, 7, 8}, {5.375, 7, 8}}));
}

// One pair of value 8: after its first visit one table holds 4, the mean is 2; the coin then
// decides between 6 and 0 (mean 3) and 4 and 4 (mean 4). Half of 400 seeds, within 5 deviations of
// 10.
TEST(Methods, DoubleQTossesAFairCoin) {
  MdpBuilder builder(0.5);
  builder.move("S", "go", "END", 8);
  const World world = to_world("one", *builder.build());
  LearnSettings settings = half_steps("double-q");
  int same = 0;
  for (settings.seed = 1; settings.seed <= 400; ++settings.seed) {
    const std::vector<Table> seen = tables(settings, world, 2);
    EXPECT_EQ(seen[0][0], 2.0);
    EXPECT_TRUE(seen[1][0] == 3.0 || seen[1][0] == 4.0);
    same += seen[1][0] == 3.0;
  }
  EXPECT_NEAR(same, 200, 50);
}

// c = 0.5, rewards 0 to 1, H = 2: k-th visit: bonus sqrt(2 / k) / 2, step 3 / (2 + k). S stays or
// ends, each by chance, and earns 0 or 1: Qmax = 2.
TEST(Methods, UcbQHopesLessWithEachVisitAndNeverRises) {
  MdpBuilder builder(0.5);
  builder.move("S", "go", "S", 1, 0.5).move("S", "go", "END", 0, 0.5);
  const World world = to_world("coin", *builder.build());
  LearnSettings settings = half_steps("ucb-q");
  settings.step_size = "auto";
  settings.of_method.ucb_bonus = 0.5;
  const auto one = learner(settings, world);
  EXPECT_EQ(one->estimates().q, Table{2.0});
  double q = 2.0, hat = 2.0;
  for (int k = 1; k <= 50; ++k) {
    Update update;
    one->advance(1, std::span(&update, 1));
    const double target =
        update.reward + 0.5 * std::sqrt(2.0 / k) + (update.terminated ? 0.0 : 0.5 * hat);
    q = q + 3.0 / (2.0 + k) * (target - q);
    hat = std::min(hat, q);
    EXPECT_DOUBLE_EQ(update.target, target);
    EXPECT_DOUBLE_EQ(update.new_value, hat);
  }
}

// Both actions begin at Qmax = 4 (at most 2 a step, discount 1/2). Whichever is tried falls, the
// other follows: after two visits each has its own value and the better one is taken for good.
TEST(Methods, UcbQTriesWhatItHopesForAndThenTheBest) {
  MdpBuilder builder(0.5);
  builder.move("S", "poor", "END", 1).move("S", "rich", "END", 1.5).move("S", "none", "END", 0);
  builder.move("T", "stay", "T", 2);
  builder.start("S");
  LearnSettings settings = half_steps("ucb-q");
  settings.step_size = "auto";
  const auto one = learner(settings, to_world("two", *builder.build()));
  one->advance(50, {});
  const Estimates estimates = one->estimates();
  EXPECT_EQ(estimates.q, (Table{1, 1.5, 0, 4}));
  EXPECT_EQ(estimates.visits, (std::vector<std::uint32_t>{1, 48, 1, 0}));
}

TEST(Methods, WhatUcbQNeedsIsSaid) {
  LearnSettings settings = half_steps("ucb-q");
  World world = without_model(chain());
  world.traits.reward_bounds.reset();
  const auto unknown = make_learner(settings, world);
  ASSERT_FALSE(unknown);
  EXPECT_NE(message(unknown.error()).find("--reward-range"), std::string::npos);
  settings.reward_range = "0,4";
  EXPECT_TRUE(make_learner(settings, world));
  const auto game = make_learner(settings, chain(true));
  ASSERT_FALSE(game);
  EXPECT_NE(message(game.error()).find("one player"), std::string::npos);
}

TEST(Methods, AReturnHasAtLeastOneReward) {
  for (const char* method : {"n-step", "tree-backup"}) {
    LearnSettings settings = half_steps(method);
    settings.of_method.return_steps = 0;
    const auto none = make_learner(settings, chain());
    ASSERT_FALSE(none) << method;
    EXPECT_EQ(none.error().file, "--return-steps");
  }
}

// A run saved with longer returns, or with traces, does not go into another world's learner.
TEST(Methods, ForeignMemoryIsRefused) {
  for (const char* method : {"n-step", "tree-backup", "q-lambda", "double-q", "ucb-q"}) {
    LearnSettings settings = half_steps(method);
    const bool returns = method[0] == 'n' || method[0] == 't';
    if (returns) settings.of_method.return_steps = 9;
    const auto one = learner(settings, corridor(6));
    one->advance(5, {});
    const std::vector<std::byte> bytes = saved(*one);
    const auto refused = [&](Learner& other) {
      Archive archive{std::span<const std::byte>(bytes)};
      archive("learner", other);
      return !archive.good();
    };
    EXPECT_TRUE(refused(*learner(settings, corridor(3)))) << method;
    if (!returns) continue;
    settings.of_method.return_steps = 2;
    EXPECT_TRUE(refused(*learner(settings, corridor(6)))) << method;
  }
}

}  // namespace
}  // namespace quoll
