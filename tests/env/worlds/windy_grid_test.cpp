#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;
using world_tests::probability;

TEST(WindyGrid, TheWindBlowsUpwards) {
  const World world = made("windy-grid");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 70u);
  EXPECT_EQ(mdp.choices(), 69u * 4);
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "r3c0");
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r3c7")));
  EXPECT_EQ(led(mdp, "r3c0", "E").to, "r3c1");
  EXPECT_EQ(led(mdp, "r3c3", "E").to, "r2c4");  // wind 1
  EXPECT_EQ(led(mdp, "r3c6", "E").to, "r1c7");  // wind 2
  EXPECT_EQ(led(mdp, "r3c6", "S").to, "r2c6");
  EXPECT_EQ(led(mdp, "r0c6", "S").to, "r0c6");  // the edge stops it
  EXPECT_EQ(led(mdp, "r0c0", "N").to, "r0c0");
  EXPECT_EQ(led(mdp, "r4c8", "W").to, "r3c7");
  EXPECT_EQ(led(mdp, "r4c8", "W").reward, -1.0);
}

TEST(WindyGrid, KingsAndGusts) {
  const World king = made("windy-grid", {{"moves", "nine"}, {"stochastic", "true"}});
  const Mdp& mdp = *king.mdp;
  EXPECT_EQ(mdp.choices(), 69u * 9);
  EXPECT_EQ(led(mdp, "r3c0", "SE").to, "r4c1");
  EXPECT_EQ(led(mdp, "r3c0", "stay").to, "r3c0");
  for (const char* to : {"r0c6", "r1c6", "r2c6"}) {
    EXPECT_DOUBLE_EQ(probability(mdp, "r3c6", "stay", to), 1.0 / 3.0) << to;
  }
  EXPECT_DOUBLE_EQ(probability(mdp, "r0c6", "stay", "r0c6"), 1.0);
}

TEST(WindyGrid, ShowsItself) {
  const World world = made("windy-grid");
  const auto environment = world.make({1, 1, 0, nullptr});
  EXPECT_EQ(environment->inspector()->text(0, 31),
            "..........\n..........\n..........\nS@.....G..\n..........\n..........\n..........\n");
  EXPECT_EQ(environment->inspector()->drawing(0, 31).shapes.size(), 71u);
}

}  // namespace
}  // namespace quoll
