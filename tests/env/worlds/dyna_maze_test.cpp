#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::led;
using world_tests::made;

TEST(DynaMaze, HasTheWallsOfTheFigure) {
  const World world = made("dyna-maze");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 54u - 7u);
  EXPECT_EQ(mdp.discount(), 0.95);
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "r2c0");
  for (const char* wall : {"r1c2", "r2c2", "r3c2", "r4c5", "r0c7", "r1c7", "r2c7"}) {
    EXPECT_FALSE(mdp.find_state(wall)) << wall;
  }
  EXPECT_EQ(led(mdp, "r1c8", "N").to, "r0c8");
  EXPECT_EQ(led(mdp, "r1c8", "N").reward, 1.0);
  EXPECT_EQ(led(mdp, "r2c0", "E").reward, 0.0);
}

TEST(DynaMaze, TheGapMoves) {
  const auto open = [](const char* map, const char* stage, const char* cell) {
    return made("dyna-maze", {{"map", map}, {"stage", stage}}).mdp->find_state(cell).has_value();
  };
  EXPECT_TRUE(open("blocking", "before", "r3c8"));
  EXPECT_FALSE(open("blocking", "before", "r3c0"));
  EXPECT_FALSE(open("blocking", "after", "r3c8"));
  EXPECT_TRUE(open("blocking", "after", "r3c0"));
  EXPECT_FALSE(open("shortcut", "before", "r3c8"));
  EXPECT_TRUE(open("shortcut", "after", "r3c8"));
  EXPECT_TRUE(open("shortcut", "after", "r3c0"));
  EXPECT_FALSE(open("shortcut", "after", "r3c4"));
  EXPECT_EQ(made("blocking-maze").mdp->state_name(made("blocking-maze").mdp->start()[0]), "r5c3");
  EXPECT_FALSE(find_world("dyna-maze", {{"stage", "after"}}));
}

}  // namespace
}  // namespace quoll
