#include <cmath>

#include "moves.hpp"
#include "quoll/env/worlds/poisson.hpp"

namespace quoll {
namespace {

using world_tests::made;
using world_tests::probability;

TEST(Poisson, TheLastOneTakesTheRest) {
  const std::vector<double> p = poisson_up_to(3.0, 4);
  ASSERT_EQ(p.size(), 5u);
  EXPECT_NEAR(p[0], std::exp(-3.0), 1e-16);
  EXPECT_NEAR(p[3], std::exp(-3.0) * 27 / 6, 1e-16);
  EXPECT_NEAR(p[4], 0.35276811121776874, 1e-15);  // 1 - 13 e^-3
  EXPECT_EQ(poisson_up_to(3.0, 0), std::vector<double>{1.0});
}

TEST(JacksCarRental, MovesWhatIsThere) {
  const World world = made("jacks-car-rental");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 441u);
  EXPECT_EQ(mdp.actions(0), 1u);                        // nothing to move
  EXPECT_EQ(mdp.actions(*mdp.find_state("a2b3")), 6u);  // 3 back, none, 2 on
  EXPECT_EQ(mdp.actions(*mdp.find_state("a20b20")), 11u);
  EXPECT_EQ(mdp.reward(0), 0.0);  // no cars, no rent
  // One car at each: it is rented unless nobody comes, 10 (1 - e^-3) + 10 (1 - e^-4).
  EXPECT_NEAR(mdp.reward(mdp.choice_begin(*mdp.find_state("a1b1")) + 1),
              20 - 10 * std::exp(-3.0) - 10 * std::exp(-4.0), 1e-12);
  // Nothing there, nobody returns: e^-3 e^-2.
  EXPECT_NEAR(probability(mdp, "a0b0", "none", "a0b0"), std::exp(-5.0), 1e-15);
  // One car moved for 2 arrives before the day.
  EXPECT_NEAR(mdp.reward(mdp.choice_begin(*mdp.find_state("a1b0")) + 1),
              10 * (1 - std::exp(-4.0)) - 2, 1e-12);
}

TEST(JacksCarRental, Modified) {
  const World plain = made("jacks-car-rental");
  const World modified = made("jacks-car-rental", {{"modified", "true"}});
  const auto dearer = [&](const char* state, const char* action) {
    const State s = *plain.mdp->find_state(state);
    for (std::uint64_t c = plain.mdp->choice_begin(s); c < plain.mdp->choice_end(s); ++c) {
      if (plain.mdp->action_name(c) == action)
        return plain.mdp->reward(c) - modified.mdp->reward(c);
    }
    return -1e9;
  };
  EXPECT_NEAR(dearer("a5b5", "none"), 0.0, 1e-12);
  EXPECT_NEAR(dearer("a5b5", "a-to-b-1"), -2.0, 1e-12);  // the shuttle
  EXPECT_NEAR(dearer("a5b5", "a-to-b-3"), -2.0, 1e-12);
  EXPECT_NEAR(dearer("a5b5", "b-to-a-1"), 0.0, 1e-12);
  EXPECT_NEAR(dearer("a11b10", "none"), 4.0, 1e-12);
  EXPECT_NEAR(dearer("a11b10", "a-to-b-1"), 2.0, 1e-12);  // now the second has 11
  EXPECT_NEAR(dearer("a20b20", "none"), 8.0, 1e-12);
}

}  // namespace
}  // namespace quoll
