// Learners that know no table, from the run around them.

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "../learn/worlds.hpp"
#include "quoll/experiment/run.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSettings linear() {
  LearnSettings settings;
  settings.method = "linear-q";
  settings.of_method.trace_decay = 0.9;
  return settings;
}

double earned(const World& world, const Learner& learner, std::uint64_t episodes) {
  return play(world, *learner.policy(), episodes, 7, world.discount, world.episode_steps).mean;
}

// 60,000 steps are some 400 episodes; a policy that knows nothing earns -200.
TEST(Approximating, DrivesTheCarUpTheMountain) {
  const World world = *find_world("mountain-car");
  const auto one = learner(linear(), world);
  EXPECT_EQ(earned(world, *one, 10), -200.0);
  one->advance(60'000, {});
  EXPECT_GT(earned(world, *one, 50), -150.0);
  EXPECT_TRUE(one->estimates().row_begin.empty());
  EXPECT_TRUE(greedy_policy(one->estimates()).empty());
}

// A policy is what the learner was when it was asked for.
TEST(Approximating, APolicyDoesNotChangeWithTheLearner) {
  const World world = *find_world("mountain-car");
  const auto one = learner(linear(), world);
  one->advance(5'000, {});
  const std::unique_ptr<Policy> policy = one->policy();
  const double before = play(world, *policy, 20, 7, 1.0, 200).mean;
  one->advance(50'000, {});
  EXPECT_EQ(play(world, *policy, 20, 7, 1.0, 200).mean, before);
}

RunSettings run_settings(std::uint64_t seeds) {
  RunSettings settings;
  settings.learn = linear();
  settings.seeds = seeds;
  settings.evaluation_episodes = 10;
  return settings;
}

Run started(const RunSettings& settings, const char* name) {
  auto run = Run::start(settings, {name, {}}, *find_world(name), {});
  EXPECT_TRUE(run) << message(run.error());
  return std::move(*run);
}

// CartPole is solved by its first 475; where nothing is asked for, 500,000 steps are walked.
TEST(Approximating, ARunEndsWhenItsReturnIsReached) {
  RunSettings settings = run_settings(2);
  settings.until = "return:195";
  auto run = started(settings, "cartpole");
  EXPECT_TRUE(run.advance(settings, 0.0, {}, {}));
  const RunResult result = run.result(true);
  for (const SeedResult& seed : result.seeds) {
    EXPECT_EQ(seed.stop, Stop::reached);
    ASSERT_TRUE(seed.reached);
    EXPECT_GE(seed.reached->mean, 195.0);
    EXPECT_GE(seed.reached->episodes, 100u);
    EXPECT_LE(seed.reached->steps, seed.steps);
    EXPECT_LE(seed.reached->processor_seconds, seed.processor_seconds);
    EXPECT_TRUE(seed.policy.empty());
    EXPECT_FALSE(seed.optimality);
    EXPECT_GT(seed.played.mean, 100.0);
  }
  settings.until = "return:501";
  settings.steps = 30'000;
  EXPECT_TRUE(run.advance(settings, 0.0, {}, {}));
  EXPECT_EQ(run.trainings()[0].stop(), Stop::steps);
  EXPECT_FALSE(run.trainings()[0].reached());
}

TEST(Approximating, WithoutALimitARunHasItsNumberOfSteps) {
  const RunSettings settings = run_settings(1);
  auto run = started(settings, "adventure");
  EXPECT_TRUE(run.advance(settings, 0.0, {}, {}));
  EXPECT_EQ(run.trainings()[0].learner().progress().steps, default_steps);
  EXPECT_EQ(run.trainings()[0].stop(), Stop::steps);
  const RunResult result = run.result(true);
  ASSERT_TRUE(result.seeds[0].optimality);
  EXPECT_EQ(result.seeds[0].optimality->optimal, true);
}

TEST(Approximating, AGoalForTablesIsRefused) {
  RunSettings settings = run_settings(1);
  const auto run = started(settings, "cartpole");
  settings.until = "stable";
  EXPECT_EQ(message(run.allows(settings).error()),
            "--until: stable is for tables; linear-q keeps none: return:R or a limit expected");
  settings = run_settings(1);
  settings.certified = "0.1";
  const auto refused = Run::start(settings, {"adventure", {}}, adventure(), {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      message(refused.error()),
      "--until: certified:EPS from experience counts in tables; linear-q keeps none: return:R "
      "or, where the model is known, certified:EPS,model expected");
}

// A table's log tells its episodes: the lecture's game is won each time, by a random walk too.
TEST(Approximating, TablesReachAReturnToo) {
  RunSettings settings;
  settings.learn.until_stable = false;
  settings.until = "return:100";
  auto run = Run::start(settings, {"adventure", {}}, adventure(), {});
  ASSERT_TRUE(run);
  EXPECT_TRUE(run->advance(settings, 0.0, {}, {}));
  ASSERT_EQ(run->trainings()[0].stop(), Stop::reached);
  EXPECT_EQ(run->trainings()[0].reached()->episodes, 100u);
  EXPECT_EQ(run->trainings()[0].reached()->mean, 100.0);
}

TEST(Approximating, AResumedRunIsTheWholeRun) {
  const std::string file =
      testing::TempDir() + "quoll-" + std::to_string(getpid()) + "-linear.quoll";
  RunSettings settings = run_settings(2);
  settings.steps = 20'000;
  auto whole = started(settings, "mountain-car");
  EXPECT_TRUE(whole.advance(settings, 0.0, {}, {}));
  RunSettings part = settings;
  part.steps = 7'777;
  auto first = started(part, "mountain-car");
  EXPECT_TRUE(first.advance(part, 0.0, {}, {}));
  ASSERT_TRUE(first.save(file));
  auto second = Run::load(file);
  std::remove(file.c_str());
  ASSERT_TRUE(second) << message(second.error());
  EXPECT_TRUE(second->advance(settings, 0.0, {}, {}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(saved(second->trainings()[i].learner()), saved(whole.trainings()[i].learner()));
    Archive one, other;
    LearningCurve a = whole.trainings()[i].curve(), b = second->trainings()[i].curve();
    a.persist(one);
    b.persist(other);
    EXPECT_EQ(one.bytes(), other.bytes());
  }
}

}  // namespace
}  // namespace quoll
