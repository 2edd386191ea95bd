// linear-q against tables, where each state has a feature of its own, and in worlds of observed
// numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSettings linear(double trace_decay, double step_size) {
  LearnSettings settings;
  settings.method = "linear-q";
  settings.of_method.trace_decay = trace_decay;
  settings.linear.tile_step_size = step_size;
  return settings;
}

// Whole steps without traces are the lecture's formula: the same numbers as the table's, from the
// same draws.
TEST(LinearQ, WithoutTracesItIsTheTablesQLearning) {
  for (const World& world : {adventure(), star(), game()}) {
    const World source = without_model(world);
    LearnSettings settings = linear(0.0, 1.0), table;
    settings.explore = table.explore = "uniform";
    table.step_size = "1";
    table.until_stable = false;
    const auto one = learner(settings, source), other = learner(table, source);
    one->advance(20'000, {});
    other->advance(20'000, {});
    EXPECT_EQ(one->estimates().q, other->estimates().q) << world.name;
    EXPECT_EQ(one->estimates().visits, other->estimates().visits) << world.name;
    EXPECT_EQ(one->progress().episodes, other->progress().episodes);
    EXPECT_EQ(one->progress().return_sum, other->progress().return_sum);
  }
}

// A -> B -> C -> end with rewards 1, 2, 4, discount 1/2, lambda 1/2, half steps. 1: error 1:
// A 0.5. 2: error 2, trace of A 1/4: B 1, A 0.5 + 1/2 * 2/4 = 0.75. 3: error 4: C 2, B 1.5,
// A 0.75 + 1/2 * 4/16 = 0.875. 4, a new episode: error 1 + 1.5 / 2 - 0.875 = 0.875: A 1.3125.
TEST(LinearQ, TracesCarryErrorsBackWithinAnEpisode) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", 1).move("B", "go", "C", 2).move("C", "go", "END", 4);
  builder.start("A");
  const World world = to_world("chain", *builder.build());
  const auto one = learner(linear(0.5, 0.5), world);
  one->advance(3, {});
  EXPECT_EQ(one->estimates().q, (std::vector<double>{0.875, 1.5, 2}));
  one->advance(1, {});
  EXPECT_EQ(one->estimates().q, (std::vector<double>{1.3125, 1.5, 2}));
  ASSERT_EQ(one->finished().size(), 0u);
  one->advance(2, {});
  ASSERT_EQ(one->finished().size(), 1u);
  EXPECT_EQ(one->finished()[0].step, 6u);
  EXPECT_EQ(one->finished()[0].total, 7.0);
  EXPECT_EQ(one->finished()[0].steps, 3u);
}

// The same cut off after two steps: 3, a new episode: error 1 + 1 / 2 - 0.75 = 0.75: A 1.125, and
// B, a step of the episode before, stays.
TEST(LinearQ, ACutEndsTheTraces) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", 1).move("B", "go", "C", 2).move("C", "go", "END", 4);
  builder.start("A");
  LearnSettings settings = linear(0.5, 0.5);
  settings.episode_steps = 2;
  const auto one = learner(settings, to_world("chain", *builder.build()));
  one->advance(3, {});
  EXPECT_EQ(one->estimates().q, (std::vector<double>{1.125, 1, 0}));
}

TEST(LinearQ, MeasuresAreSumsOverTheSteps) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", 1).move("B", "go", "END", 2);
  builder.start("A");
  const auto one = learner(linear(0.0, 0.5), to_world("chain", *builder.build()));
  one->advance(3, {});  // errors 1, 2, then 1 + 1/2 - 1/2; values 0, 0, 1/2
  const std::vector<Measure> measures = one->measures();
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].name, "td_loss");
  EXPECT_EQ(measures[0].sum, 6.0);
  EXPECT_EQ(measures[0].count, 3u);
  EXPECT_EQ(measures[1].name, "q_values");
  EXPECT_EQ(measures[1].sum, 0.5);
}

TEST(LinearQ, TheCutIsASetting) {
  LearnSettings with = linear(0.9, 0.5), without = with;
  without.linear.keep_traces = true;
  const World world = slippery(6);
  const auto one = learner(with, world), other = learner(without, world);
  one->advance(500, {});
  other->advance(500, {});
  EXPECT_NE(one->estimates().q, other->estimates().q);
}

TEST(LinearQ, ACutRunIsTheWholeRun) {
  const World world = *find_world("cartpole");
  const LearnSettings settings = linear(0.9, 0.5);
  const auto whole = learner(settings, world);
  whole->advance(3'000, {});
  const auto first = learner(settings, world), second = learner(settings, world);
  first->advance(1'234, {});
  const auto bytes = saved(*first);
  Archive archive{std::span<const std::byte>(bytes)};
  archive("learner", *second);
  ASSERT_TRUE(archive.good() && archive.at_end());
  second->advance(3'000 - 1'234, {});
  EXPECT_EQ(saved(*second), saved(*whole));
}

TEST(LinearQ, DamagedWeightsAreRefused) {
  const World car = *find_world("mountain-car"), pole = *find_world("cartpole");
  const auto one = learner(linear(0.9, 0.5), car), other = learner(linear(0.9, 0.5), pole);
  one->advance(100, {});
  const auto bytes = saved(*one);
  Archive archive{std::span<const std::byte>(bytes)};
  archive("learner", *other);
  EXPECT_FALSE(archive.good());
  other->advance(100, {});  // and stands on its feet
}

std::string refusal(LearnSettings settings, const char* world) {
  const auto made = make_learner(settings, *find_world(world));
  return made ? "none" : message(made.error());
}

TEST(LinearQ, RefusesWhatItCannotDo) {
  LearnSettings settings = linear(0.9, 0.5);
  EXPECT_EQ(refusal(settings, "minatar-breakout"),
            "--method: linear-q needs numbered states, or observed numbers whose ranges are known, "
            "which minatar-breakout has not");
  settings.explore = "ucb";
  EXPECT_EQ(refusal(settings, "mountain-car"),
            "--explore: linear-q counts no visits of what it observes: no ucb; did you "
            "mean 'epsilon-greedy'?");
  settings = linear(0.9, 0.5);
  settings.step_size = "0.1";
  EXPECT_EQ(refusal(settings, "mountain-car"),
            "--step-size: is for tables, but --method is linear-q");
  settings = linear(0.9, 0.5);
  settings.start = "uniform";
  EXPECT_EQ(refusal(settings, "adventure"),
            "--start: linear-q begins its episodes where the world does; only --start world");
}

}  // namespace
}  // namespace quoll
