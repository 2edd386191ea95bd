#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(Puddle, DeeperIsDearer) {
  const World world = made("puddle", {{"slip", "0"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 400u);
  EXPECT_EQ(mdp.start().size(), 399u);
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r0c19")));
  EXPECT_FALSE(mdp.terminal(*mdp.find_state("r0c18")));
  // Row 5 is y = 0.725, column 4 x = 0.225: 0.025 from the segment at y = 0.75, depth 0.075.
  EXPECT_NEAR(led(mdp, "r5c3", "E").reward, -1 - 400 * 0.075, 1e-9);
  // Row 10 is y = 0.475, column 6 x = 0.325: 0.125 from the segment at x = 0.45.
  EXPECT_EQ(led(mdp, "r10c5", "E").reward, -1.0);
  // Column 7, x = 0.375: 0.075 from it, depth 0.025.
  EXPECT_NEAR(led(mdp, "r10c6", "E").reward, -1 - 400 * 0.025, 1e-9);
  EXPECT_EQ(led(mdp, "r0c0", "W").to, "r0c0");
}

TEST(Puddle, Slips) {
  const World world = made("puddle", {{"slip", "0.2"}, {"size", "3"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_NEAR(probability(mdp, "r1c1", "E", "r1c2"), 0.8, 1e-15);
  EXPECT_NEAR(probability(mdp, "r1c1", "E", "r0c1"), 0.1, 1e-15);
  EXPECT_NEAR(probability(mdp, "r1c1", "E", "r2c1"), 0.1, 1e-15);
  EXPECT_NEAR(probability(mdp, "r2c0", "W", "r2c0"), 0.9, 1e-15);
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r0c2")));
}

}  // namespace
}  // namespace quoll
