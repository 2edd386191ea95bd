#include "quoll/learn/tabular/engine.hpp"

#include <gtest/gtest.h>

#include "../worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSettings plain() {
  LearnSettings settings;
  settings.until_stable = false;
  return settings;
}

TEST(Engine, TheLogTellsEveryStepFromTheFirst) {
  const World world = adventure();
  LearnSettings settings = plain();
  settings.precision = Precision::twofold;
  const auto one = learner(settings, world);
  std::vector<Update> log(500);
  const LearnProgress now = one->advance(400, log);
  ASSERT_EQ(now.logged, 400u);
  std::uint64_t ends = 0;
  for (std::uint64_t i = 0; i < now.logged; ++i) {
    const Update& update = log[i];
    EXPECT_EQ(update.step, i + 1);
    EXPECT_EQ(update.terminated, world.mdp->terminal(update.next));
    EXPECT_EQ(update.target, update.reward + 0.8 * update.best_next);
    EXPECT_EQ(update.new_value, update.target);
    if (update.terminated) {
      EXPECT_EQ(update.best_next, 0.0);
    }
    if (i > 0 && !log[i - 1].terminated) {
      EXPECT_EQ(update.state, log[i - 1].next);
    }
    ends += update.terminated;
  }
  EXPECT_EQ(now.episodes, ends);
  EXPECT_EQ(now.return_sum, 100.0 * ends);
}

TEST(Engine, AFullLogStopsTheLearner) {
  const auto one = learner(plain(), adventure());
  std::vector<Update> log(10);
  EXPECT_EQ(one->advance(25, log).steps, 10u);
  EXPECT_EQ(one->advance(25, {}).steps, 35u);
  EXPECT_EQ(one->advance(0, log).logged, 0u);
}

// Always left in a corridor: nothing ends, so each third step is cut off, and the next begins in
// c0.
TEST(Engine, EpisodesAreCutOffAfterTheirSteps) {
  LearnSettings settings = plain();
  settings.episode_steps = 3;
  const auto one = learner(settings, corridor(50));
  std::vector<Update> log(30);
  const LearnProgress now = one->advance(30, log);
  EXPECT_EQ(now.episodes, 10u);
  for (std::uint64_t i = 0; i < 30; ++i) {
    EXPECT_EQ(log[i].truncated, i % 3 == 2);
    if (i % 3 == 0) {
      EXPECT_EQ(log[i].state, 0u);
    }
  }
}

// The bootstrap goes on over a cut: c1, reached at the cut, is worth what it promises.
TEST(Engine, ACutEpisodeStillHasAFuture) {
  LearnSettings settings = plain();
  settings.episode_steps = 1;
  settings.start = "uniform";
  const auto one = learner(settings, corridor(3));
  one->advance(5000, {});
  const Estimates estimates = one->estimates();
  // right: 0.81, 0.9, 1; left: 0.9 times the best of where it leads.
  const float expected[] = {0.729f, 0.81f, 0.729f, 0.9f, 0.81f, 1.0f};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(estimates.q[i], expected[i], 1e-6);
}

TEST(Engine, AnyNumberOfStepsMayBeAskedFor) {
  LearnSettings settings;
  const auto one = learner(settings, adventure());
  one->advance(10, {});
  const LearnProgress now = one->advance(~std::uint64_t{0}, {});
  EXPECT_EQ(now.halt, LearnProgress::Halt::stable);
}

TEST(Engine, VisitsAddUpToTheSteps) {
  for (const World& world : {adventure(), star(), without_model(star())}) {
    const auto one = learner(plain(), world);
    one->advance(1234, {});
    std::uint64_t sum = 0;
    for (const std::uint32_t visits : one->estimates().visits) sum += visits;
    EXPECT_EQ(sum, 1234u) << world.name;
  }
}

// Rewards that floats hold exactly and one start: the environment must give the bits of the table.
TEST(Engine, AnEnvironmentGivesTheBitsOfItsTable) {
  for (const World& world : {corridor(6), slippery(6), star()}) {
    for (const char* explore : {"uniform", "greedy", "epsilon-greedy", "softmax", "ucb"}) {
      LearnSettings settings = plain();
      settings.explore = explore;
      const auto left = learner(settings, world), right = learner(settings, without_model(world));
      left->advance(20'000, {});
      right->advance(20'000, {});
      const Estimates a = left->estimates();
      Estimates b = right->estimates();
      // Without a model an end has one pair, which nobody visits.
      std::vector<double> q;
      std::vector<std::uint32_t> visits;
      for (State s = 0; s < world.mdp->states(); ++s) {
        for (Action i = 0; i < world.mdp->actions(s); ++i) {
          q.push_back(b.q[b.row_begin[s] + i]);
          visits.push_back(b.visits[b.row_begin[s] + i]);
        }
      }
      EXPECT_EQ(a.q, q) << world.name << " " << explore;
      EXPECT_EQ(a.visits, visits);
    }
  }
}

TEST(Engine, StabilityIsFoundWithoutAModelToo) {
  for (const World& world : {adventure(), corridor(6), star()}) {
    World bare = without_model(world);
    const auto one = learner({}, bare);
    const LearnProgress now = one->advance(1'000'000, {});
    EXPECT_EQ(now.halt, LearnProgress::Halt::stable) << world.name;
  }
}

TEST(Engine, AWorldMayBeginInAnEnd) {
  MdpBuilder builder(0.9);
  builder.move("A", "go", "END", 1.0).start("A").start("END");
  const World world = to_world("halves", *builder.build());
  for (const World& one_world : {world, without_model(world)}) {
    const auto one = learner(plain(), one_world);
    EXPECT_EQ(one->advance(1000, {}).episodes, 1000u);
    EXPECT_EQ(one->estimates().q[0], 1.0);
  }
}

TEST(Engine, DeclaredEndsStopTheBootstrap) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", 1.0).move("B", "more", "A", 50.0).terminal("B");
  const World world = to_world("declared", *builder.build());
  const auto one = learner(plain(), world);
  EXPECT_EQ(one->advance(100, {}).episodes, 100u);
  EXPECT_EQ(one->estimates().q[0], 1.0);
  EXPECT_EQ(one->estimates().visits[1], 0u);
}

TEST(Engine, TheGreedyPolicyTakesOnlyVisitedActions) {
  Estimates estimates;
  estimates.row_begin = {0, 3, 3, 5, 6};
  estimates.q = {5, 1, 1, 0, -1, 9};
  estimates.visits = {0, 2, 1, 1, 1, 0};
  EXPECT_EQ(greedy_policy(estimates), (std::vector<Action>{1, no_action, 0, no_action}));
}

// Every field of a saved learner that leads into a table is checked on the way in.
TEST(Engine, ASavedLearnerOfAnotherWorldIsRefused) {
  const auto small = learner(plain(), corridor(3)), large = learner(plain(), corridor(4));
  Archive out;
  out("learner", *large);
  Archive in{std::span<const std::byte>(out.bytes())};
  in("learner", *small);
  EXPECT_FALSE(in.good());
  small->advance(100, {});  // still usable
  // Values that a checksum cannot vouch for: each byte in turn may be anything.
  const auto bytes = saved(*learner(plain(), slippery(3)));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{0xff};
    const auto one = learner(plain(), slippery(3));
    Archive archive{std::span<const std::byte>(damaged)};
    archive("learner", *one);
    if (archive.good()) one->advance(50, {});
  }
}

}  // namespace
}  // namespace quoll
