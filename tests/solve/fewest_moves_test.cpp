#include "quoll/solve/fewest_moves.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/solve/functional_graph.hpp"
#include "tests/solve/models.hpp"

namespace quoll {
namespace {

// Bounds found once for each number of moves are, bit for bit, those of following the policy from
// every state, and those already hold for the best of all actions.
TEST(FewestMoves, BoundsAreThoseOfFollowingThePolicy) {
  for (const char* seed : {"1", "2", "3"}) {
    for (const char* braid : {"0", "0.5", "1"}) {
      for (const double discount : {1.0, 0.99, 0.5, 0.1}) {
        const Result<World> world =
            find_world("maze", {{"size", "12"}, {"seed", seed}, {"braid", braid}});
        ASSERT_TRUE(world);
        const Mdp& mdp = *world->mdp;
        const Discount factor(discount);
        const auto rewards = two_rewards(mdp);
        ASSERT_TRUE(rewards && fewer_moves_win(*rewards, factor, false));
        Solution solution;
        ASSERT_TRUE(solve_by_moves(mdp, *rewards, factor, solution));
        GraphValues values = evaluate_graph(mdp, solution.policy, factor);
        EXPECT_EQ(solution.lower, values.lower);
        EXPECT_EQ(solution.upper, values.upper);
        ASSERT_TRUE(raise_until_inductive(mdp, factor, values.order, values.upper));
        EXPECT_EQ(solution.upper, values.upper);
      }
    }
  }
}

// A state from which no way ends, and two kinds of ends.
TEST(FewestMoves, LeavesOthersToTheSolver) {
  MdpBuilder b(0.9);
  b.move("a", "on", "b", -1).move("a", "off", "trap", -1);
  b.move("b", "on", "end", -1);
  b.move("trap", "stay", "trap", -1);
  const Mdp mdp = test::built(b);
  const auto rewards = two_rewards(mdp);
  ASSERT_TRUE(rewards);
  Solution solution;
  EXPECT_FALSE(solve_by_moves(mdp, *rewards, Discount(0.9), solution));
  EXPECT_EQ(solution.policy[0], 0);  // the policy is set all the same
  EXPECT_TRUE(solution.lower.empty());
}

}  // namespace
}  // namespace quoll
