#include "quoll/experiment/run.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>

#include "../learn/worlds.hpp"
#include "quoll/base/file.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

using OneRun = Run;  // inside a test, Run is a member of the test

RunSettings limited(std::uint64_t steps) {
  RunSettings settings;
  settings.learn.until_stable = false;
  settings.steps = steps;
  return settings;
}

Run started(const World& world, const RunSettings& settings) {
  Result<Run> run = OneRun::start(settings, {world.name, {}}, world, {});
  EXPECT_TRUE(run) << (run ? "" : message(run.error()));
  return std::move(*run);
}

TEST(Runs, StopsAtExactlyTheStepsAskedFor) {
  for (const std::uint64_t steps : {1, 63, 64, 65, 1000, 70'000}) {
    OneRun run = started(adventure(), limited(steps));
    EXPECT_TRUE(run.advance(limited(steps), 0.0, {}, {}));
    EXPECT_EQ(run.trainings()[0].learner().progress().steps, steps);
    EXPECT_EQ(run.trainings()[0].stop(), Stop::steps);
    run.advance(limited(steps), 0.0, {}, {});
    run.advance(limited(1), 0.0, {}, {});
    EXPECT_EQ(run.trainings()[0].learner().progress().steps, steps);
  }
}

TEST(Runs, StopsWithTheStepThatEndsTheLastEpisode) {
  RunSettings settings = limited(0);
  settings.episodes = 25;
  OneRun run = started(adventure(), settings);
  run.advance(settings, 0.0, {}, {});
  const LearnProgress now = run.trainings()[0].learner().progress();
  EXPECT_EQ(now.episodes, 25u);
  EXPECT_EQ(run.trainings()[0].stop(), Stop::episodes);
  // One step less would have been one episode less.
  OneRun shorter = started(adventure(), limited(now.steps - 1));
  shorter.advance(limited(now.steps - 1), 0.0, {}, {});
  EXPECT_EQ(shorter.trainings()[0].learner().progress().episodes, 24u);
}

TEST(Runs, WithoutALimitStopsWhenStableWithTheProvedOptimum) {
  RunSettings settings;
  settings.seeds = 3;
  OneRun run = started(adventure(), settings);
  run.advance(settings, 0.0, {}, {});
  const RunResult result = run.result(true);
  ASSERT_TRUE(result.exact);
  ASSERT_EQ(result.seeds.size(), 3u);
  for (const SeedResult& seed : result.seeds) {
    EXPECT_EQ(seed.stop, Stop::stable);
    ASSERT_TRUE(seed.optimality && seed.optimality->optimal);
    EXPECT_TRUE(*seed.optimality->optimal);
    EXPECT_EQ(seed.played.mean, 100.0);
  }
  EXPECT_EQ(result.seeds[2].seed, 3u);
  EXPECT_NE(result.seeds[0].steps, result.seeds[1].steps);
}

TEST(Runs, GivesUpOnStabilityAfterTheBudget) {
  EXPECT_EQ(default_budget(adventure()), 1'000'000u);
  RunSettings settings;
  settings.learn.explore = "greedy";  // never tries what once looked worse
  settings.learn.ties = Ties::first;
  settings.learn.episode_steps = 5;
  OneRun run = started(corridor(20), settings);
  run.advance(settings, 0.0, {}, {});
  EXPECT_EQ(run.trainings()[0].stop(), Stop::budget);
  EXPECT_EQ(run.trainings()[0].learner().progress().steps, 1'000'000u);
}

TEST(Runs, CanBeInterruptedAndTold) {
  OneRun run = started(adventure(), limited(1'000'000));
  std::uint64_t seen = 0;
  run.advance(limited(1'000'000), 0.0,
              [&](const RunProgress& now) {
                seen = now.steps;
                return now.steps < 1000;
              },
              {});
  EXPECT_EQ(run.trainings()[0].stop(), Stop::interrupted);
  EXPECT_GE(seen, 1000u);
  EXPECT_LT(seen, 2000u);
  EXPECT_EQ(run.trainings()[0].learner().progress().steps, seen);
}

TEST(Runs, MeansLeaveOutSeedsThatWereInterrupted) {
  RunSettings settings = limited(3000);
  settings.seeds = 3;
  settings.threads = 1;
  OneRun run = started(adventure(), settings);
  // Seed 1 ends, seed 2 is stopped on its way, seed 3 never begins.
  run.advance(settings, 0.0, [](const RunProgress& now) { return now.steps < 4000; }, {});
  const RunResult result = run.result(false);
  EXPECT_EQ(result.seeds[0].stop, Stop::steps);
  EXPECT_EQ(result.seeds[1].stop, Stop::interrupted);
  EXPECT_EQ(result.seeds[2].steps, 0u);
  EXPECT_EQ(result.counted, 1u);
  EXPECT_EQ(result.statistics.mean, result.seeds[0].played.mean);
  EXPECT_EQ(result.statistics.minimum, result.seeds[0].played.mean);
}

// Fits are due at the very last step, too: pauses within them change nothing.
TEST(Runs, PausesDoNotCutTheLastFit) {
  RunSettings settings = limited(100);
  settings.learn.method = "nfq";
  settings.learn.deep.hidden = "8";
  settings.learn.deep.train_every = 50;
  settings.learn.deep.fits = 3;
  OneRun whole = started(adventure(), settings), parts = started(adventure(), settings);
  EXPECT_TRUE(whole.advance(settings, 0.0, {}, {}));
  std::uint64_t pauses = 0;
  while (!parts.advance(settings, 1e-9, {}, {})) ++pauses;
  EXPECT_GE(pauses, 2u);
  EXPECT_EQ(parts.trainings()[0].stop(), Stop::steps);
  EXPECT_EQ(parts.trainings()[0].learner().estimates().q,
            whole.trainings()[0].learner().estimates().q);
}

TEST(Runs, RecordsEachBinOnce) {
  OneRun run = started(adventure(), limited(64 * 10));
  std::uint64_t last = 0, returns = 0;
  run.advance(limited(64 * 10), 0.0, {}, [&](const Record& record) {
    if (record.name != "episodic_return") return;
    EXPECT_EQ(record.step % 64, 0u);
    EXPECT_GT(record.step, last);
    EXPECT_EQ(record.value, 100.0);
    last = record.step;
    ++returns;
  });
  EXPECT_EQ(returns, 10u);
}

TEST(Runs, RefusesWhatIsNotDefined) {
  MdpBuilder builder(1.0);
  builder.move("A", "round", "A", 1.0).move("A", "end", "END");
  const World gaining = to_world("gaining", *builder.build());
  const auto refused = OneRun::start({}, {"gaining", {}}, gaining, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(message(refused.error()).find("A"), std::string::npos);
  RunSettings forced;
  forced.force = true;
  EXPECT_TRUE(OneRun::start(forced, {"gaining", {}}, gaining, {}));
  RunSettings wrong;
  wrong.learn.explore = "greedly";
  const auto misspelt = OneRun::start(wrong, {"adventure", {}}, adventure(), {});
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(misspelt.error().nearest, "greedy");
  EXPECT_FALSE(OneRun::start({}, {"adventure", {}}, adventure(), {1.0, 2.0}));
}

// 501 states with at most 2 actions: the model knows 1000 pairs (the end has none); without it they
// are 501 x 2 = 1002, so 2000 x 1002 steps.
TEST(Runs, TheBudgetCountsPairsWithAndWithoutAModel) {
  EXPECT_EQ(default_budget(corridor(500)), 2'000'000u);
  EXPECT_EQ(default_budget(without_model(corridor(500))), 2'004'000u);
}

TEST(Runs, RefusesSeedsThatDoNotExist) {
  RunSettings settings;
  settings.learn.seed = ~std::uint64_t{0} - 1;
  settings.seeds = 3;
  const auto refused = OneRun::start(settings, {"adventure", {}}, adventure(), {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().file, "--seeds");
  settings.seeds = 2;
  EXPECT_TRUE(OneRun::start(settings, {"adventure", {}}, adventure(), {}));
}

TEST(Runs, RefusesAValueThatTheTableCannotHold) {
  RunSettings settings;
  settings.learn.initial_value = "-1e39";
  const auto refused = OneRun::start(settings, {"adventure", {}}, adventure(), {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().file, "--initial-value");
  settings.learn.precision = Precision::twofold;
  EXPECT_TRUE(OneRun::start(settings, {"adventure", {}}, adventure(), {}));
}

TEST(Runs, RefusesATolerance) {
  RunSettings settings;
  for (const double tolerance : {-0.5, -0.999}) {
    settings.learn.tolerance = tolerance;
    EXPECT_FALSE(OneRun::start(settings, {"adventure", {}}, adventure(), {}));
  }
  for (const double tolerance : {-1.0, 0.0, 0.5}) {
    settings.learn.tolerance = tolerance;
    EXPECT_TRUE(OneRun::start(settings, {"adventure", {}}, adventure(), {}));
  }
}

TEST(Runs, JudgesNoRuleThatExistsToBeStudied) {
  RunSettings settings = limited(1000);
  settings.learn.rule = "as-printed";
  settings.seeds = 2;
  OneRun run = started(adventure(), settings);
  run.advance(settings, 0.0, {}, {});
  for (const SeedResult& seed : run.result(true).seeds) EXPECT_FALSE(seed.optimality);
}

TEST(Runs, LearnsInAWorldWithoutAModel) {
  RunSettings settings = limited(20'000);
  OneRun run = started(without_model(adventure()), settings);
  run.advance(settings, 0.0, {}, {});
  const RunResult result = run.result(true);
  EXPECT_FALSE(result.exact);
  EXPECT_FALSE(result.no_exact.empty());
  EXPECT_FALSE(result.seeds[0].optimality);
  EXPECT_EQ(result.seeds[0].played.mean, 100.0);
}

// A run file as somebody might forge it: right checksum, wrong content. Each byte of the content is
// changed in turn; whatever loads must still be able to go on.
TEST(Runs, AForgedFileIsRefusedOrHarmless) {
  const std::string path = testing::TempDir() + "quoll-run-" + std::to_string(getpid());
  RunSettings settings = limited(100);
  OneRun run = started(adventure(), settings);
  run.advance(settings, 0.0, {}, {});
  ASSERT_TRUE(run.save(path));
  const auto content = load_archive(path, "run");
  ASSERT_TRUE(content);
  for (std::size_t i = 0; i < content->size(); i += 7) {
    auto forged = *content;
    forged[i] ^= std::byte{0x81};
    std::remove(path.c_str());
    ASSERT_TRUE(save_archive(path, "run", forged));
    auto loaded = OneRun::load(path, i % 2 == 0);
    if (!loaded) {
      EXPECT_EQ(loaded.error().file, path);
      EXPECT_FALSE(loaded.error().expected.empty());
      continue;
    }
    int chunks = 0;
    loaded->advance(limited(200), 0.0, [&](const RunProgress&) { return ++chunks < 100; }, {});
  }
  std::remove(path.c_str());
}

}  // namespace
}  // namespace quoll
