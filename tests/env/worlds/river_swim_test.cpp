#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(RiverSwim, OfStrehlAndLittman) {
  const World world = made("river-swim");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 6u);
  ASSERT_EQ(mdp.start().size(), 2u);
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "s1");
  EXPECT_EQ(mdp.start_probability(1), 0.5);
  EXPECT_EQ(led(mdp, "s0", "left").reward, 5.0);
  EXPECT_EQ(led(mdp, "s3", "left").to, "s2");
  EXPECT_DOUBLE_EQ(probability(mdp, "s0", "right", "s1"), 0.3);
  EXPECT_DOUBLE_EQ(probability(mdp, "s3", "right", "s2"), 0.1);
  EXPECT_DOUBLE_EQ(probability(mdp, "s3", "right", "s3"), 0.6);
  EXPECT_DOUBLE_EQ(probability(mdp, "s3", "right", "s4"), 0.3);
  EXPECT_DOUBLE_EQ(probability(mdp, "s5", "right", "s4"), 0.7);
  EXPECT_NEAR(mdp.reward(mdp.choice_begin(5) + 1), 3000.0, 1e-9);  // 0.3 * 10000
}

TEST(RiverSwim, OfOsband) {
  const World world = made("river-swim", {{"variant", "osband"}, {"states", "4"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "s0");
  EXPECT_EQ(led(mdp, "s0", "left").reward, 0.005);
  EXPECT_DOUBLE_EQ(probability(mdp, "s0", "right", "s1"), 0.6);
  EXPECT_DOUBLE_EQ(probability(mdp, "s1", "right", "s0"), 0.05);
  EXPECT_DOUBLE_EQ(probability(mdp, "s1", "right", "s2"), 0.35);
  EXPECT_DOUBLE_EQ(probability(mdp, "s3", "right", "s3"), 0.6);
  EXPECT_EQ(mdp.reward(mdp.choice_begin(3) + 1), 1.0);
}

}  // namespace
}  // namespace quoll
