#include "quoll/model/maze.hpp"

#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;

TEST(Maze, IsTheMazeOfTheModel) {
  MazeSettings settings;
  settings.size = 21;
  settings.seed = 4;
  const Mdp expected = *to_mdp(make_maze(settings));
  const World world = made("maze", {{"size", "21"}, {"seed", "4"}});
  EXPECT_EQ(world.mdp->arrays().next, expected.arrays().next);
  EXPECT_EQ(world.mdp->state_name(world.mdp->start()[0]), "r0c0");
  EXPECT_EQ(world.discount, 1.0);
}

// Every state has the same name, the same picture and the same neighbours under another number.
TEST(Maze, ShuffledIsTheSameMaze) {
  const World rows = made("maze", {{"size", "20"}});
  const World shuffled = made("maze", {{"size", "20"}, {"numbering", "shuffled"}});
  const Mdp& a = *rows.mdp;
  const Mdp& b = *shuffled.mdp;
  ASSERT_EQ(a.states(), b.states());
  EXPECT_EQ(b.state_name(b.start()[0]), "r0c0");
  const auto lane_a = rows.make({1, 1, 0, nullptr});
  const auto lane_b = shuffled.make({1, 1, 0, nullptr});
  State moved = 0;
  for (State s = 0; s < a.states(); ++s) {
    const State t = *b.find_state(a.state_name(s));
    moved += s != t;
    EXPECT_EQ(lane_a->inspector()->text(0, s), lane_b->inspector()->text(0, t));
    EXPECT_EQ(a.layout()->cell[s], b.layout()->cell[t]);
    ASSERT_EQ(a.actions(s), b.actions(t));
    for (Action i = 0; i < a.actions(s); ++i) {
      const std::uint64_t from = a.choice_begin(s) + i;
      const std::uint64_t to = b.choice_begin(t) + i;
      EXPECT_EQ(a.state_name(a.next(from)), b.state_name(b.next(to)));
      EXPECT_EQ(a.action_name(from), b.action_name(to));
      EXPECT_EQ(a.reward(from), b.reward(to));
    }
  }
  EXPECT_GT(moved, a.states() * 9 / 10);
}

TEST(Maze, RefusesWhatIsNoMaze) {
  EXPECT_FALSE(find_world("maze", {{"size", "2"}}));
  EXPECT_FALSE(find_world("maze", {{"braid", "2"}}));
  EXPECT_FALSE(find_world("maze", {{"numbering", "columns"}}));
}

}  // namespace
}  // namespace quoll
