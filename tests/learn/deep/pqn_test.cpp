// PQN in small worlds whose values are known.

#include <gtest/gtest.h>

#include <vector>

#include "../worlds.hpp"
#include "exact_values.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// One-step returns, many passes: the table's values, up to the steps that go on for ever.
TEST(Pqn, ALinearNetworkFindsTheTable) {
  for (const World& world : {adventure(), corridor(5)}) {
    LearnSettings settings = network("pqn");
    settings.deep.layer_norm = Switch::off;
    settings.deep.learning_rate = "2:0.1:60000";
    settings.deep.return_decay = 0.0;
    const auto one = learner(settings, world);
    one->advance(60'000, {});
    EXPECT_LT(error_of(world, *one), 1e-3) << world.name;
  }
}

// One way from each state, so that every return is that of the best policy whatever lambda is: a
// mistake at the end of an episode, at a cut or between two players shows.
World one_way(bool alternating) {
  MdpBuilder builder(0.75);
  builder.move("a", "go", "b", 4).move("b", "go", "c", -2).move("c", "go", "d", 1);
  builder.move("d", "go", "END", 8).move("e", "go", "c", 3);
  for (const char* const start : {"a", "b", "c", "d", "e"}) builder.start(start);
  builder.alternating(alternating);
  return to_world("one way", *builder.build());
}

TEST(Pqn, ReturnsOfEveryLengthAgreeWhereThereIsOneWay) {
  for (const bool alternating : {false, true}) {
    const World world = one_way(alternating);
    for (const double lambda : {0.0, 0.65, 1.0}) {
      for (const std::uint64_t most : {1u, 2u, 100u}) {  // steps of an episode
        LearnSettings settings = network("pqn");
        settings.deep.layer_norm = Switch::off;
        settings.deep.learning_rate = "1";
        settings.deep.return_decay = lambda;
        settings.deep.reward_scale = 0.5;
        settings.episode_steps = most;
        const auto one = learner(settings, world);
        one->advance(40'000, {});
        EXPECT_LT(error_of(world, *one), 1e-4) << alternating << " " << lambda << " " << most;
      }
    }
  }
}

TEST(Pqn, TheRateFallsWithTheSteps) {
  LearnSettings settings = network("pqn");
  settings.deep.learning_rate = "1:0:2000";
  const auto one = learner(settings, one_way(false));
  one->advance(1500, {});
  const std::vector<double> before = one->estimates().q;
  one->advance(2500, {});
  const std::vector<double> after = one->estimates().q;
  EXPECT_NE(before, after);
  one->advance(4000, {});
  EXPECT_EQ(one->estimates().q, after);
}

}  // namespace
}  // namespace quoll
