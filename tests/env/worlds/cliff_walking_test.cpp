#include "quoll/env/world.hpp"

#include <gtest/gtest.h>

#include "played.hpp"

namespace quoll::world_tests {
namespace {

// Value iteration over the tables of Gymnasium's program (CliffWalking-v1) gives these digits.
TEST(CliffWalking, HasTheKnownOptima) {
  const World dry = made("cliff-walking"), wet = made("CliffWalkingSlippery-v1");
  EXPECT_NEAR(optimum(dry, 0.99), -12.247897700103, 6e-13);
  EXPECT_NEAR(optimum(dry, 0.9), -7.458134171671, 6e-13);
  EXPECT_EQ(optimum(dry, 1.0), -13.0);  // along the edge: 13 moves
  EXPECT_NEAR(optimum(wet, 0.99), -46.352672181652, 1e-12);
  EXPECT_NEAR(optimum(wet, 0.9), -9.936417277211, 6e-13);
}

TEST(CliffWalking, FallsBackToTheStart) {
  const World world = made("cliff-walking");
  const Played played = play(world, 1, 4, [](int t) { return std::vector<Action>{1, 2, 3, 0}[t]; });
  EXPECT_EQ(played.observed, numbers({36, 36, 36, 24}));
  EXPECT_EQ(played.rewards, (std::vector<double>{-100, -1, -1, -1}));
  EXPECT_EQ(world.episode_steps, 0u);
  EXPECT_TRUE(world.traits.deterministic);
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.next(mdp.choice_begin(35) + 2), 47u);
  EXPECT_EQ(mdp.reward(mdp.choice_begin(35) + 2), -1.0);
  EXPECT_TRUE(mdp.terminal(47));
  EXPECT_EQ(mdp.state_name(36), "r3c0");
  EXPECT_EQ(played.text, "............\n............\n@...........\nSCCCCCCCCCCG\n");
}

// Gymnasium 1.4 in preparation, CliffWalkingSlippery-v1, env.reset(seed=1).
TEST(CliffWalking, FollowsGymnasiumForTheSameSeed) {
  const World world = made("CliffWalkingSlippery-v1", {{"seeding", "gymnasium"}});
  const Played played = play(world, 1, 24, [](int t) { return Action(t % 4 == 0 ? 0 : 1); });
  EXPECT_EQ(played.observed, numbers({36, 24, 36, 24, 12, 24, 25, 26, 25, 36, 36, 24,
                                      25, 13, 14, 2,  2,  2,  2,  14, 13, 14, 26, 36}));
  EXPECT_EQ(played.rewards[0], -100.0);
  EXPECT_EQ(played.rewards[23], -100.0);
}

}  // namespace
}  // namespace quoll::world_tests
