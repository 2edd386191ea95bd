#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(DeepSea, FallsLeftAndRight) {
  const World world = made("deep-sea", {{"size", "4"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 11u);
  EXPECT_EQ(led(mdp, "r0c0", "left").to, "r1c0");
  EXPECT_EQ(led(mdp, "r0c0", "left").reward, 0.0);
  EXPECT_EQ(led(mdp, "r2c1", "left").to, "r3c0");
  EXPECT_EQ(led(mdp, "r2c1", "right").to, "r3c2");
  EXPECT_EQ(led(mdp, "r2c1", "right").reward, -0.01 / 4);
  EXPECT_EQ(led(mdp, "r3c3", "right").to, "seabed");
  EXPECT_EQ(led(mdp, "r3c3", "right").reward, 1 - 0.01 / 4);
  EXPECT_EQ(led(mdp, "r3c3", "left").reward, 0.0);
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("seabed")));
  EXPECT_TRUE(mdp.deterministic());
}

TEST(DeepSea, RightFailsAndTheEndsAreNoisy) {
  const World world = made("deep-sea", {{"size", "4"}, {"stochastic", "true"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_DOUBLE_EQ(probability(mdp, "r1c1", "right", "r2c2"), 0.75);
  EXPECT_DOUBLE_EQ(probability(mdp, "r1c1", "right", "r2c1"), 0.25);
  EXPECT_EQ(led(mdp, "r1c1", "left").to, "r2c0");
  const State corner = *mdp.find_state("r3c0");
  const std::uint64_t left = mdp.choice_begin(corner);
  EXPECT_EQ(mdp.reward(left), 0.0);
  EXPECT_EQ(mdp.reward(left, mdp.outcome_begin(left)), 1.0);
  EXPECT_EQ(mdp.reward(left, mdp.outcome_begin(left) + 1), -1.0);
  EXPECT_EQ(led(mdp, "r3c1", "left").reward, 0.0);
}

TEST(DeepSea, TheMappingMovesOnlyTheOrder) {
  const World plain = made("deep-sea");
  const World mapped = made("deep-sea", {{"mapping_seed", "5"}});
  const Mdp& mdp = *mapped.mdp;
  std::uint32_t swapped = 0;
  for (State s = 0; s + 1 < mdp.states(); ++s) {
    const bool swap = mdp.action_name(mdp.choice_begin(s)) == "right";
    swapped += swap;
    EXPECT_EQ(mdp.next(mdp.choice_begin(s) + swap), plain.mdp->next(plain.mdp->choice_begin(s)));
  }
  EXPECT_GT(swapped, 15u);  // of 55 cells
  EXPECT_LT(swapped, 40u);
}

TEST(DeepSea, ShowsItself) {
  const World world = made("deep-sea", {{"size", "3"}});
  const auto environment = world.make({1, 1, 0, nullptr});
  EXPECT_EQ(environment->inspector()->text(0, 2), ".  \n.@ \n..G\n___\n");
  EXPECT_EQ(environment->inspector()->text(0, 6), ".  \n.. \n..G\n@__\n");
}

}  // namespace
}  // namespace quoll
