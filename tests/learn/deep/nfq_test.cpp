// Neural fitted Q in small worlds whose values are known.

#include <gtest/gtest.h>

#include <algorithm>

#include "../resume.hpp"
#include "../worlds.hpp"
#include "exact_values.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

LearnSettings fitted() {
  LearnSettings settings = network("nfq");
  settings.deep.optimiser = "rprop";
  settings.deep.learning_rate = "0.1";
  settings.deep.train_every = 500;
  settings.deep.fits = 10;
  settings.deep.epochs = 40;
  return settings;
}

// What settles within a thousandth of the targets is within a few of Q*.
constexpr double one_in_200 = 0.005;

// Rprop leaves what is not asked as it was, whatever is asked more often.
TEST(Nfq, ALinearNetworkOfOneNumberPerStateFindsTheTable) {
  for (const World& world : {adventure(), star(), corridor(5), game()}) {
    for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::separate}) {
      LearnSettings settings = fitted();
      settings.deep.layout = layout;
      const auto one = learner(settings, world);
      one->advance(1000, {});
      EXPECT_LT(error_of(world, *one), one_in_200) << world.name;
    }
  }
}

TEST(Nfq, ANetworkThatReadsTheActionFindsItToo) {
  LearnSettings settings = fitted();
  settings.deep.layout = NetworkLayout::joint;
  settings.deep.hidden = "32";
  settings.deep.learning_rate = "0.01";
  settings.deep.epochs = 300;
  settings.deep.reward_scale = 0.01;
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(1000, {});
  EXPECT_LT(error_of(world, *one), 0.02);
}

// Of one step each, cut off: what follows counts, and what was forgotten does not.
TEST(Nfq, ACutCountsWhatFollows) {
  const World world = adventure();
  LearnSettings settings = fitted();
  settings.episode_steps = 1;
  settings.deep.replay = 400;
  const auto one = learner(settings, world);
  one->advance(1000, {});
  EXPECT_LT(error_of(world, *one), one_in_200);
}

// All that was seen counts once, however it is cut into parts: Q is the mean of the prizes.
TEST(Nfq, EveryStepCountsOnce) {
  MdpBuilder builder(0.5);
  builder.move("A", "gamble", "END", 0.0, 0.5).move("A", "gamble", "END", 8.0, 0.5).start("A");
  LearnSettings settings = fitted();
  settings.deep.train_every = 300;
  const auto one = learner(settings, to_world("prize", *builder.build()));
  const LearnProgress done = one->advance(300, {});
  EXPECT_NEAR(one->estimates().q[0], done.return_sum / 300.0, 0.01);
}

// Fits that nobody wants to wait for are left, saved and gone on with.
TEST(Nfq, GoesOnWithWhatItLeft) {
  const World world = adventure();
  LearnSettings settings = fitted();
  settings.deep.epochs = 7;
  const auto whole = learner(settings, world);
  whole->advance(1200, {});
  auto parts = learner(settings, world);
  std::uint64_t asked = 0, left = 0, steps = 0;
  while (steps < 1200) {
    parts->ask([&] { return ++asked % 5 != 0; });
    const std::uint64_t goal = std::min<std::uint64_t>(1200, steps + 300);
    steps = parts->advance(goal - steps, {}).steps;
    left += steps < goal;
    auto next = learner(settings, world);
    ASSERT_NO_FATAL_FAILURE(resume(*parts, *next));
    parts = std::move(next);
  }
  EXPECT_GT(left, 10u);
  EXPECT_EQ(saved(*parts), saved(*whole));
}

// Rewards of three steps and a third as many fits: as good.
TEST(Nfq, SeveralRewardsComeSooner) {
  double error[2];
  for (const bool several : {false, true}) {
    LearnSettings settings = fitted();
    settings.deep.fits = 2;
    settings.deep.multi_step = several ? 3 : 1;
    const World world = corridor(7, 0.99);
    const auto one = learner(settings, world);
    one->advance(500, {});
    error[several] = error_of(world, *one);
  }
  EXPECT_LT(error[1], error[0]);
}

}  // namespace
}  // namespace quoll
