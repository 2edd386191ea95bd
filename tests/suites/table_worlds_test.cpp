// Table worlds solved exactly, against the answers their sources publish.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solved.hpp"

namespace quoll {
namespace {

using world_tests::solved;

// Sutton, Barto 2018, example 6.5 ("15 steps is the minimum") and the known answer of exercise 6.9.
TEST(TableWorlds, WindyGrid) {
  EXPECT_NEAR(solved("windy-grid").start(), -15, 1e-6);
  EXPECT_NEAR(solved("windy-grid", {{"moves", "eight"}}).start(), -7, 1e-6);
  EXPECT_NEAR(solved("windy-grid", {{"moves", "nine"}}).start(), -7, 1e-6);
  EXPECT_LT(solved("windy-grid", {{"moves", "eight"}, {"stochastic", "true"}}).start(), -7);
}

// bsuite's optimal return: 1 - move_cost. Stochastic: the first fault of a right ends the hope,
// and from then on left costs nothing, so V = sum over k of (1 - 1/N)^k (-move_cost / N) and
// (1 - 1/N)^(N-1); bsuite's (1 - 1/N)^(N-1) - move_cost counts the cost as if it were always paid.
TEST(TableWorlds, DeepSea) {
  EXPECT_NEAR(solved("deep-sea").start(), 0.99, 1e-9);
  EXPECT_NEAR(solved("deep-sea", {{"size", "30"}, {"mapping_seed", "7"}}).start(), 0.99, 1e-9);
  double cost = 0.0;
  for (int k = 0; k < 10; ++k) cost += std::pow(0.9, k) * 0.001;
  const double value = solved("deep-sea", {{"stochastic", "true"}}).start();
  EXPECT_NEAR(value, std::pow(0.9, 9) - cost, 1e-9);
  EXPECT_GT(value, std::pow(0.9, 9) - 0.01);
}

// Lengths of the shortest paths: 14 in figure 8.2, 10 and 16 in figures 8.4 and 8.5; the reward
// comes with the last move.
TEST(TableWorlds, DynaMazes) {
  const auto start = [](const char* map, const char* stage) {
    return solved("dyna-maze", {{"map", map}, {"stage", stage}}).start();
  };
  EXPECT_NEAR(solved("dyna-maze", {{"map", "dyna"}}).start(), std::pow(0.95, 13), 1e-9);
  EXPECT_NEAR(start("blocking", "before"), std::pow(0.95, 9), 1e-9);
  EXPECT_NEAR(start("blocking", "after"), std::pow(0.95, 15), 1e-9);
  EXPECT_NEAR(start("shortcut", "before"), std::pow(0.95, 15), 1e-9);
  EXPECT_NEAR(start("shortcut", "after"), std::pow(0.95, 9), 1e-9);
}

// Without slip the best way from a cell beside no puddle is the shortest one, if it can pass.
TEST(TableWorlds, Puddle) {
  const auto dry = solved("puddle", {{"slip", "0"}});
  EXPECT_NEAR(dry.value("r0c0"), -19, 1e-9);
  EXPECT_NEAR(dry.value("r19c19"), -19, 1e-9);
  EXPECT_NEAR(dry.value("r19c0"), -38, 1e-9);
  EXPECT_LT(solved("puddle").value("r0c0"), -19);
}

TEST(TableWorlds, MazeByAnyNumbering) {
  const auto rows = solved("maze", {{"size", "31"}});
  const auto shuffled = solved("maze", {{"size", "31"}, {"numbering", "shuffled"}});
  for (State s = 0; s < rows.mdp().states(); ++s) {
    EXPECT_EQ(rows.value(s), shuffled.value(rows.mdp().state_name(s)));
  }
}

// Osband's river: always right is optimal in the long run, and its stationary distribution is
// 1 : 12 : 84 : 588 : 4116 : 3601.5 (flows there and back are equal), so that the gain per step is
// 3601.5 / 8402.5. With a discount near 1, (1 - discount) V is near the gain.
TEST(TableWorlds, RiverSwim) {
  const auto river = solved("river-swim", {{"variant", "osband"}}, 0.9999, 1e-4);
  EXPECT_NEAR(river.start() * 0.0001, 3601.5 / 8402.5, 0.005);
  for (State s = 0; s < 6; ++s) EXPECT_EQ(river.solution.policy[s], 1u) << s;
  const auto strehl = solved("river-swim", {}, 0.0, 1e-6);
  for (State s = 0; s < 6; ++s) EXPECT_EQ(strehl.solution.policy[s], 1u) << s;
}

TEST(TableWorlds, CombinationLock) {
  EXPECT_NEAR(solved("combination-lock").start(), std::pow(0.99, 19), 1e-9);
}

// Always forward: with c = 0.8 discount, V1 = (0.4 + 0.2 discount V1)(1 + c + c^2 + c^3) + c^4 V5
// and V5 = (8.4 + 0.2 discount V1) / (1 - c). In the long run 0.4 + 8 * 0.8^4 = 3.6768 a step:
// the 3677 in 1000 steps of Poupart et al. 2006.
TEST(TableWorlds, Chain) {
  const auto chain = solved("chain");
  const double c = 0.8 * 0.99, back = 0.2 * 0.99;
  const double sum = 1 + c + c * c + c * c * c, c4 = c * c * c * c;
  const double first = (0.4 * sum + c4 * 8.4 / (1 - c)) / (1 - back * (sum + c4 / (1 - c)));
  EXPECT_NEAR(chain.value("s0"), first, 1e-8);
  EXPECT_NEAR(chain.value("s4"), (8.4 + back * first) / (1 - c), 1e-8);
  for (State s = 0; s < 5; ++s) EXPECT_EQ(chain.solution.policy[s], 0u);
  EXPECT_NEAR(solved("chain", {}, 0.99999, 1e-4).start() * 0.00001, 3.6768, 1e-3);
}

// pymdptoolbox's documentation: PolicyIteration(forest, 0.9).V and policy (0, 0, 0).
TEST(TableWorlds, Forest) {
  const auto forest = solved("forest");
  EXPECT_NEAR(forest.value("age-0"), 26.244, 1e-8);
  EXPECT_NEAR(forest.value("age-1"), 29.484, 1e-8);
  EXPECT_NEAR(forest.value("age-2"), 33.484, 1e-8);
  for (State s = 0; s < 3; ++s) EXPECT_EQ(forest.solution.policy[s], 0u);
}

// Its ValueIteration(forest, 0.96) says V = (5.93215488, 9.38815488, 13.38815488), policy (0, 0, 0)
// after 4 sweeps: it stops when the policy is good enough, far from the value. The policy is right;
// the sweeps are repeated here, and the value itself is larger by the same amount everywhere to
// within a hundredth.
TEST(TableWorlds, ForestOfValueIteration) {
  const auto forest = solved("forest", {}, 0.96);
  for (State s = 0; s < 3; ++s) EXPECT_EQ(forest.solution.policy[s], 0u);
  const Mdp& mdp = forest.mdp();
  std::vector<double> v(3, 0.0);
  for (int sweep = 0; sweep < 4; ++sweep) {
    std::vector<double> now(3, -1e9);
    for (State s = 0; s < 3; ++s) {
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        double q = mdp.reward(c);
        for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          q += 0.96 * mdp.probability(o) * v[mdp.next(o)];
        }
        now[s] = std::max(now[s], q);
      }
    }
    v = now;
  }
  const double published[] = {5.93215488, 9.38815488, 13.38815488};
  for (State s = 0; s < 3; ++s) {
    EXPECT_NEAR(v[s], published[s], 1e-8);
    EXPECT_NEAR(forest.value(s) - v[s], forest.value(0u) - v[0], 0.01);
  }
}

// Sutton, Barto 2018, example 4.3. Bold play, optimal for p below 1/2 (Dubins, Savage 1965), has
// V(s) = p V(2 s) up to the half and p + (1 - p) V(2 s - 100) above.
double bold(double p, int capital) {
  double lost = 0.0, factor = 1.0;  // V = lost + factor * V(capital)
  for (int i = 0; i < 200 && capital > 0 && capital < 100; ++i) {
    if (capital >= 50) lost += factor * p;
    factor *= capital >= 50 ? 1 - p : p;
    capital = capital >= 50 ? 2 * capital - 100 : 2 * capital;
  }
  return lost + (capital >= 100 ? factor : 0.0);
}

TEST(TableWorlds, GamblersProblem) {
  const auto game = solved("gamblers-problem");
  EXPECT_NEAR(game.value("25"), 0.16, 1e-9);
  EXPECT_NEAR(game.value("50"), 0.4, 1e-9);
  EXPECT_NEAR(game.value("75"), 0.64, 1e-9);
  for (State s = 1; s < 100; ++s) EXPECT_NEAR(game.value(s), bold(0.4, static_cast<int>(s)), 1e-9);
  EXPECT_NEAR(solved("gamblers-problem", {{"p", "0.25"}}).value("50"), 0.25, 1e-9);
}

// Figure 4.3 shows the smallest best stakes: a tooth to each multiple of 25, and 25, 50 and 25 at
// the multiples themselves.
TEST(TableWorlds, GamblersFamousPolicy) {
  const auto game = solved("gamblers-problem");
  for (int s = 1; s < 100; ++s) {
    const int tooth = s % 25;
    const int famous = s == 50 ? 50 : tooth == 0 ? 25 : std::min(tooth, 25 - tooth);
    int smallest = 0;
    for (int stake = std::min(s, 100 - s); stake >= 1; --stake) {
      const auto at = [&](int capital) {
        return capital == 100 ? 1.0 : game.value(static_cast<State>(capital));
      };
      const double q = 0.4 * at(s + stake) + 0.6 * at(s - stake);
      if (q > game.value(static_cast<State>(s)) - 1e-8) smallest = stake;
    }
    EXPECT_EQ(smallest, famous) << s;
  }
}

// Sutton, Barto 2018, figure 4.2: axis of values from 420 to 612, and the last policy, as it is
// read off the figure and computed by others: cars moved from the first location (rows 0 to 20) to
// the second (columns).
constexpr int figure_4_2[21][21] = {
    {0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -2, -2, -2, -3, -3, -3, -3, -3, -4, -4, -4},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -2, -2, -2, -2, -2, -3, -3, -3, -3},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -2, -2, -2, -2, -2},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -2},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1},
    {1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {3, 2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {3, 3, 2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {4, 3, 3, 2, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {4, 4, 3, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 4, 4, 3, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 4, 3, 2, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 4, 3, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 4, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 5, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 5, 4, 3, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 5, 4, 3, 2, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 5, 4, 3, 3, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {5, 5, 5, 4, 4, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0},
    {5, 5, 5, 5, 4, 4, 3, 3, 3, 3, 2, 2, 2, 2, 2, 1, 1, 1, 0, 0, 0}};

TEST(TableWorlds, JacksCarRental) {
  const auto rental = solved("jacks-car-rental", {}, 0.0, 1e-6);
  const Mdp& mdp = rental.mdp();
  std::string different;
  for (State s = 0; s < 441; ++s) {
    const std::uint64_t c = mdp.choice_begin(s) + rental.solution.policy[s];
    const int moved = static_cast<int>(mdp.arrays().action[c]) - 5;
    if (moved != figure_4_2[s / 21][s % 21]) different += mdp.state_name(s) + " ";
  }
  EXPECT_EQ(different, "a17b8 ");
  // There, moving one car is better than the figure's none by four cents.
  const State close = rental.state("a17b8");
  std::uint64_t none = mdp.choice_begin(close);
  while (mdp.action_name(none) != "none") ++none;
  double q = mdp.reward(none);
  for (std::uint64_t o = mdp.outcome_begin(none); o < mdp.outcome_end(none); ++o) {
    q += 0.9 * mdp.probability(o) * rental.value(mdp.next(o));
  }
  EXPECT_NEAR(rental.value(close) - q, 0.0412, 1e-3);
  // The lower end is the figure's 420; the figure's axis ends at 612.
  EXPECT_NEAR(rental.value("a0b0"), 421.414, 1e-3);
  EXPECT_NEAR(rental.value("a20b20"), 636.990, 1e-3);
}

// With stock ordered up to S from s or less, and nothing ordered above.
TEST(TableWorlds, InventoryIsOfTypeSS) {
  const auto stock = solved("inventory", {}, 0.0, 1e-8);
  State up_to = 0, reorder = 0;
  for (State s = 0; s <= 20; ++s) {
    const State order = stock.solution.policy[s];
    if (s == 0) up_to = order;
    if (order > 0) {
      EXPECT_EQ(s + order, up_to) << s;
      EXPECT_EQ(reorder, s) << "orders at " << s << " again";
      ++reorder;
    }
  }
  EXPECT_GT(reorder, 1u);
  EXPECT_LT(reorder, up_to);
}

}  // namespace
}  // namespace quoll
