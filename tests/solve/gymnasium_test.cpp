// The optima of Gymnasium's table worlds as value iteration over its own tables gives them: the
// solvers' intervals contain them, and are narrow.

#include <gtest/gtest.h>

#include <string>

#include "quoll/env/world.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

struct Optimum {
  const char* world;
  Parameters parameters;
  double far, near;  // at discount 0.99 and 0.9, mean over the starts
  double digit;      // half a unit of the last digit
};

TEST(Gymnasium, TheSolversIntervalsContainTheKnownOptima) {
  const Optimum optima[] = {
      {"frozen-lake", {}, 0.542025932000, 0.068890904889, 5e-13},
      {"frozen-lake", {{"map", "8x8"}}, 0.414640361800, 0.006411114262, 5e-13},
      {"frozen-lake", {{"slippery", "false"}}, 0.950990, 0.590490, 5e-7},
      {"frozen-lake", {{"map", "8x8"}, {"slippery", "false"}}, 0.877521, 0.254187, 5e-7},
      {"cliff-walking", {}, -12.247897700103, -7.458134171671, 5e-13},
      {"cliff-walking", {{"slippery", "true"}}, -46.352672181652, -9.936417277211, 5e-13},
      {"taxi", {}, 6.327464314919, -1.263323099040, 5e-13},
      {"taxi", {{"rainy", "true"}}, 2.247629323605, -3.763146500302, 5e-13},
      {"blackjack", {{"rules", "sab"}}, -0.043026190, -0.042220653, 5e-10},
      {"blackjack", {{"rules", "natural"}}, -0.025642267, -0.024836730, 5e-10},
      {"blackjack", {{"rules", "plain"}}, -0.046469062, -0.045663525, 5e-10},
  };
  for (const Optimum& row : optima) {
    const Result<World> world = find_world(row.world, row.parameters);
    ASSERT_TRUE(world) << message(world.error());
    const Mdp& mdp = *world->mdp;
    for (const double discount : {0.99, 0.9}) {
      SolveSettings settings;
      settings.width = 1e-8;
      settings.discount = discount;
      const Result<Solution> found = solve(mdp, settings);
      ASSERT_TRUE(found) << message(found.error());
      EXPECT_TRUE(found->converged) << row.world;
      double lower = 0.0, upper = 0.0;
      for (std::size_t i = 0; i < mdp.start().size(); ++i) {
        lower += mdp.start_probability(i) * found->lower[mdp.start()[i]];
        upper += mdp.start_probability(i) * found->upper[mdp.start()[i]];
      }
      const double known = discount == 0.99 ? row.far : row.near;
      EXPECT_LE(lower, known + row.digit) << row.world << " " << discount;
      EXPECT_GE(upper, known - row.digit) << row.world << " " << discount;
      EXPECT_LE(upper - lower, 1e-8) << row.world << " " << discount;
    }
  }
}

}  // namespace
}  // namespace quoll
