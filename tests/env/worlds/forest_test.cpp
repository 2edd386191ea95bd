#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

// The matrices that pymdptoolbox prints for example.forest().
TEST(Forest, IsPymdptoolboxs) {
  const World world = made("forest");
  const Mdp& mdp = *world.mdp;
  const double wait[3][3] = {{0.1, 0.9, 0}, {0.1, 0, 0.9}, {0.1, 0, 0.9}};
  const double reward[3][2] = {{0, 0}, {0, 1}, {4, 2}};
  for (State s = 0; s < 3; ++s) {
    for (State t = 0; t < 3; ++t) {
      EXPECT_DOUBLE_EQ(probability(mdp, mdp.state_name(s), "wait", mdp.state_name(t)), wait[s][t]);
    }
    EXPECT_EQ(led(mdp, mdp.state_name(s), "cut").to, "age-0");
    for (Action a = 0; a < 2; ++a) {
      EXPECT_EQ(mdp.reward(mdp.choice_begin(s) + a), reward[s][a]);
    }
  }
}

}  // namespace
}  // namespace quoll
