#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(Chain, SlipsToTheOtherAction) {
  const World world = made("NChain-v0");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 5u);
  EXPECT_EQ(world.episode_steps, 1000u);
  EXPECT_DOUBLE_EQ(probability(mdp, "s1", "forward", "s2"), 0.8);
  EXPECT_DOUBLE_EQ(probability(mdp, "s1", "back", "s2"), 0.2);
  EXPECT_DOUBLE_EQ(mdp.reward(0), 0.4);                        // 0.2 * 2
  EXPECT_DOUBLE_EQ(mdp.reward(mdp.choice_begin(4)), 8.4);      // 0.8 * 10 + 0.2 * 2
  EXPECT_DOUBLE_EQ(mdp.reward(mdp.choice_begin(4) + 1), 3.6);  // 0.2 * 10 + 0.8 * 2
}

TEST(Chain, WithoutSlip) {
  const World world = made("chain", {{"slip", "0"}, {"states", "3"}, {"large", "7"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(led(mdp, "s2", "forward").to, "s2");
  EXPECT_EQ(led(mdp, "s2", "forward").reward, 7.0);
  EXPECT_EQ(led(mdp, "s1", "back").reward, 2.0);
  EXPECT_TRUE(mdp.deterministic());
}

}  // namespace
}  // namespace quoll
