#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;
using world_tests::probability;

TEST(GamblersProblem, StakesWhatIsOwnedOrMissing) {
  const World world = made("gamblers-problem");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 101u);
  EXPECT_EQ(mdp.choices(), 2500u);
  EXPECT_EQ(mdp.actions(30), 30u);
  EXPECT_EQ(mdp.actions(50), 50u);
  EXPECT_EQ(mdp.actions(70), 30u);
  EXPECT_TRUE(mdp.terminal(0));
  EXPECT_TRUE(mdp.terminal(100));
  EXPECT_DOUBLE_EQ(probability(mdp, "30", "stake-7", "37"), 0.4);
  EXPECT_DOUBLE_EQ(probability(mdp, "30", "stake-7", "23"), 0.6);
  EXPECT_DOUBLE_EQ(mdp.reward(mdp.choice_begin(70) + 29), 0.4);  // wins the game
  EXPECT_EQ(mdp.reward(mdp.choice_begin(70) + 28), 0.0);
}

}  // namespace
}  // namespace quoll
