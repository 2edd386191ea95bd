#include "quoll/learn/deep/walkers.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSetup setup_of(const World& world, std::uint64_t episode_steps = 0) {
  LearnSettings settings;
  settings.method = "linear-q";
  settings.episode_steps = episode_steps;
  const Result<LearnSetup> setup = resolve(settings, world);
  EXPECT_TRUE(setup) << message(setup.error());
  return *setup;
}

// Two cells; always to the right: the second step ends with 1. Both lanes end together.
TEST(Walkers, CountStepsEpisodesAndReturnsOfAllLanes) {
  const World world = corridor(2);
  const LearnSetup setup = setup_of(world);
  Walkers walkers(setup, 2);
  EXPECT_EQ(walkers.count(), 2u);
  for (int t = 0; t < 5; ++t) {
    for (Action& action : walkers.actions()) action = 1;
    EXPECT_EQ(walkers.now().state[0], static_cast<State>(t % 2));
    walkers.step();
    EXPECT_EQ(walkers.now().feedback[1].terminated, t % 2 == 1);
    walkers.go_on();
  }
  const LearnProgress& progress = walkers.progress();
  EXPECT_EQ(progress.steps, 10u);
  EXPECT_EQ(progress.episodes, 4u);
  EXPECT_EQ(progress.return_sum, 4.0);
  ASSERT_EQ(walkers.finished().size(), 4u);
  const FinishedEpisode last = walkers.finished()[3];  // the fourth round's second lane
  EXPECT_EQ(last.step, 8u);
  EXPECT_EQ(last.total, 1.0);
  EXPECT_EQ(last.steps, 2u);
  walkers.forget_finished();
  EXPECT_TRUE(walkers.finished().empty());
}

TEST(Walkers, KnowTheActionsOfEachState) {
  const World ragged = star(), even = corridor(3);
  const LearnSetup of_ragged = setup_of(ragged), of_even = setup_of(even);
  Walkers walkers(of_ragged, 1), same(of_even, 1);
  EXPECT_EQ(walkers.actions_now(0), 5u);
  EXPECT_EQ(same.actions_now(0), 2u);
  walkers.actions()[0] = 3;
  walkers.step();
  EXPECT_EQ(walkers.actions_next(0), 2u);
  EXPECT_EQ(walkers.now().feedback[0].reward, 3.0);
}

TEST(Walkers, EpisodesAreCutOffAndTurnsPass) {
  const World world = game();
  const LearnSetup setup = setup_of(world, 3);
  Walkers walkers(setup, 1);
  for (int t = 0; t < 3; ++t) {
    walkers.actions()[0] = 0;
    walkers.step();
    EXPECT_TRUE(walkers.now().feedback[0].turn_passes);
    EXPECT_EQ(walkers.now().feedback[0].truncated, t == 2);
    walkers.go_on();
  }
  EXPECT_EQ(walkers.now().state[0], 0u);
  EXPECT_EQ(walkers.progress().episodes, 1u);
}

// What a walk is like, however often it is saved and read back in other lanes.
TEST(Walkers, ASavedWalkGoesOnBitForBit) {
  const World cartpole = *find_world("cartpole"), car = *find_world("mountain-car");
  for (const World* world : {&cartpole, &car}) {
    for (const std::uint32_t count : {1u, 3u, 17u}) {
      const LearnSetup setup = setup_of(*world, 50);
      std::vector<std::byte> whole;
      for (const bool cut : {false, true}) {
        auto walkers = std::make_unique<Walkers>(setup, count);
        Rng coin = stream(3, "behaviour");
        for (int t = 0; t < 300; ++t) {
          if (cut && t % 29 == 0) {
            Archive out;
            out("walkers", *walkers);
            walkers = std::make_unique<Walkers>(setup, count);
            Archive in{std::span<const std::byte>(out.bytes())};
            in("walkers", *walkers);
            ASSERT_TRUE(in.good() && in.at_end());
          }
          for (Action& action : walkers->actions()) action = coin.below(2);
          walkers->step();
          walkers->go_on();
        }
        Archive end;
        end("walkers", *walkers);
        if (!cut) whole = end.bytes();
        EXPECT_EQ(end.bytes(), whole) << world->name << ", " << count << " lanes";
        EXPECT_GT(walkers->progress().episodes, 0u);
      }
    }
  }
}

TEST(Walkers, LanesDoNotDependOnEachOther) {
  const World world = *find_world("cartpole");
  const LearnSetup setup = setup_of(world);
  Walkers few(setup, 2), many(setup, 20);
  for (int t = 0; t < 200; ++t) {
    for (Action& action : few.actions()) action = t % 2;
    for (Action& action : many.actions()) action = t % 2;
    few.step();
    many.step();
    ASSERT_EQ(few.now().feedback[1].reward, many.now().feedback[1].reward);
    for (std::size_t i = 0; i < 8; ++i) {
      ASSERT_EQ(few.now().next_observation[i], many.now().next_observation[i]) << t;
    }
    few.go_on();
    many.go_on();
  }
}

}  // namespace
}  // namespace quoll
