#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;
using world_tests::probability;

TEST(Inventory, StatesHaveUnequallyManyActions) {
  const World world = made("inventory");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 21u);
  EXPECT_EQ(mdp.choices(), 231u);
  EXPECT_EQ(mdp.actions(20), 1u);
  // Poisson of mean 5: no demand with probability e^-5.
  EXPECT_NEAR(probability(mdp, "stock-3", "order-2", "stock-5"), 0.006737946999085467, 1e-15);
  EXPECT_DOUBLE_EQ(probability(mdp, "stock-0", "order-0", "stock-0"), 1.0);
}

// Puterman 1994, section 4.6.1: three months, no value afterwards; the values of the first month.
TEST(Inventory, PutermansThreeMonths) {
  const World world = made("inventory", {{"demand", "book"}, {"capacity", "3"}});
  const Mdp& mdp = *world.mdp;
  std::vector<double> value(4, 0.0);
  std::vector<Action> order(4);
  for (int month = 3; month >= 1; --month) {
    std::vector<double> now(4);
    for (State s = 0; s < 4; ++s) {
      for (Action a = 0; a < mdp.actions(s); ++a) {
        const std::uint64_t c = mdp.choice_begin(s) + a;
        double q = mdp.reward(c);
        for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          q += mdp.probability(o) * value[mdp.next(o)];
        }
        if (a == 0 || q > now[s]) {
          now[s] = q;
          order[s] = a;
        }
      }
    }
    value = now;
  }
  EXPECT_EQ(value, (std::vector<double>{67.0 / 16, 129.0 / 16, 194.0 / 16, 227.0 / 16}));
  EXPECT_EQ(order, (std::vector<Action>{3, 0, 0, 0}));
}

}  // namespace
}  // namespace quoll
