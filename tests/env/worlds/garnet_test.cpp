#include <set>

#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;

TEST(Garnet, HasTheSizesAskedFor) {
  const World world = made("garnet", {{"states", "50"}, {"actions", "4"}, {"branching", "5"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 50u);
  EXPECT_EQ(mdp.choices(), 200u);
  EXPECT_EQ(mdp.outcomes(), 1000u);
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
    std::set<State> successors;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      successors.insert(mdp.next(o));
    }
    EXPECT_EQ(successors.size(), 5u);
    sum += mdp.reward(c);
    squares += mdp.reward(c) * mdp.reward(c);
  }
  EXPECT_NEAR(sum / 200, 0.0, 0.3);  // four standard errors
  EXPECT_NEAR(squares / 200, 1.0, 0.4);
}

TEST(Garnet, TheSeedIsTheModel) {
  const auto first = made("garnet", {{"seed", "3"}}).mdp;
  const auto again = made("garnet", {{"seed", "3"}}).mdp;
  const auto other = made("garnet", {{"seed", "4"}}).mdp;
  EXPECT_EQ(first->arrays().reward, again->arrays().reward);
  EXPECT_EQ(first->arrays().probability, again->arrays().probability);
  EXPECT_NE(first->arrays().reward, other->arrays().reward);
}

TEST(Garnet, AllStatesAsSuccessors) {
  const World world = made("garnet", {{"states", "3"}, {"branching", "3"}});
  for (std::uint64_t c = 0; c < world.mdp->choices(); ++c) {
    std::set<State> successors;
    for (std::uint64_t i = 0; i < 3; ++i) successors.insert(world.mdp->next(3 * c + i));
    EXPECT_EQ(successors.size(), 3u);
  }
  EXPECT_TRUE(made("garnet", {{"branching", "1"}}).traits.deterministic);
  const auto wide = find_world("garnet", {{"branching", "21"}});
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().file, "--with branching");
}

}  // namespace
}  // namespace quoll
