#include "quoll/solve/finite_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models.hpp"
#include "quoll/env/world.hpp"

namespace quoll {
namespace {

HorizonSolution solved(const Mdp& mdp, HorizonSettings settings) {
  settings.keep_policy = true;
  Result<HorizonSolution> solution = solve_horizon(mdp, settings);
  EXPECT_TRUE(solution);
  return std::move(*solution);
}

HorizonSolution solved(const Mdp& mdp, std::uint64_t steps, double discount) {
  HorizonSettings settings;
  settings.steps = steps;
  settings.discount = discount;
  return solved(mdp, settings);
}

// What the policy of all steps earns, played from every state.
std::vector<double> earned(const Mdp& mdp, const HorizonSolution& solution) {
  std::vector<std::vector<Action>> policy(solution.steps, solution.policy);
  for (const PolicyChange& change : solution.changes) {
    for (std::uint64_t t = change.step; t < solution.steps; ++t) {
      policy[t][change.state] = change.action;
    }
  }
  std::vector<double> value(mdp.states(), 0.0);
  for (std::uint64_t t = solution.steps; t-- > 0;) {
    std::vector<double> before(mdp.states(), 0.0);
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      const std::uint64_t c = mdp.choice_begin(s) + policy[t][s];
      before[s] = mdp.reward(c);
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        before[s] += solution.discount * mdp.probability(o) * value[mdp.next(o)];
      }
    }
    value = before;
  }
  return value;
}

TEST(Horizon, IsExactForIntegersWithoutDiscount) {
  // GATE-POOL-CAVE-GOAL takes three steps: with two nothing is to be had from GATE.
  const Mdp mdp = test::adventure();
  const State gate = *mdp.find_state("GATE");
  for (const auto& [steps, value] : {std::pair{1, 0.0}, {2, 0.0}, {3, 100.0}, {1000, 100.0}}) {
    const HorizonSolution solution = solved(mdp, static_cast<std::uint64_t>(steps), 1.0);
    EXPECT_EQ(solution.lower[gate], value);
    EXPECT_EQ(solution.upper[gate], value);
    EXPECT_EQ(solution.gap, 0.0);
    EXPECT_EQ(solution.lower[*mdp.find_state("GOAL")], 0.0);
  }
}

TEST(Horizon, TheLastStepsAreOthers) {
  // Investing costs 1 and pays 4 one step later, grabbing pays 1 at once: V(n) = V(n - 2) + 3, with
  // V(1) = 1 and V(2) = 3, and only the last step has to grab.
  MdpBuilder b(1.0);
  b.move("FIELD", "grab", "FIELD", 1).move("FIELD", "invest", "TREE", -1);
  b.move("TREE", "pick", "FIELD", 4);
  const Mdp mdp = test::built(b);
  const HorizonSolution solution = solved(mdp, 10, 1.0);
  EXPECT_EQ(solution.lower[0], 15.0);  // five times -1 + 4
  EXPECT_EQ(solution.policy[0], 1u);
  const HorizonSolution odd = solved(mdp, 11, 1.0);
  EXPECT_EQ(odd.lower[0], 16.0);
  EXPECT_EQ(earned(mdp, odd)[0], 16.0);
  EXPECT_EQ(earned(mdp, solution)[0], 15.0);
  ASSERT_FALSE(solution.changes.empty());
  EXPECT_EQ(solution.changes.back().step, 9u);
  EXPECT_EQ(solution.changes.back().action, 0u);
}

TEST(Horizon, FrozenLakeAsGymnasiumLimitsIt) {
  // Backward induction over Gymnasium's own table FrozenLake8x8-v1.P in 200 steps gives
  // 0.9132201502016288, in 50 0.22835123662011475.
  const auto world = find_world("frozen-lake", {{"map", "8x8"}});
  ASSERT_TRUE(world);
  for (const auto& [steps, value] :
       {std::pair{200, 0.9132201502016288}, {50, 0.22835123662011475}}) {
    const HorizonSolution solution = solved(*world->mdp, static_cast<std::uint64_t>(steps), 1.0);
    const State start = world->mdp->start()[0];
    EXPECT_NEAR(solution.lower[start], value, 1e-11);
    EXPECT_LE(solution.lower[start], value);
    EXPECT_GE(solution.upper[start], value);
    EXPECT_LE(solution.gap, 1e-11);
    EXPECT_NEAR(earned(*world->mdp, solution)[start], value, 1e-12);
  }
}

TEST(Horizon, HoldsAgainstAllPoliciesOfRandomModels) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Mdp mdp = test::random_model(seed, 4 + seed % 5, 1.0);
    const double discount = seed % 3 == 0 ? 1.0 : 0.9;
    const HorizonSolution solution = solved(mdp, 1 + seed % 20, discount);
    std::vector<double> value(mdp.states(), 0.0);
    for (std::uint64_t k = 0; k < 1 + seed % 20; ++k) {
      std::vector<double> next(mdp.states(), 0.0);
      for (State s = 0; s < mdp.states(); ++s) {
        double best = mdp.terminal(s) ? 0.0 : -1e300;
        for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
          double q = mdp.reward(c);
          for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
            q += discount * mdp.probability(o) * value[mdp.next(o)];
          }
          best = std::max(best, q);
        }
        next[s] = best;
      }
      value = next;
    }
    const std::vector<double> policy_value = earned(mdp, solution);
    for (State s = 0; s < mdp.states(); ++s) {
      EXPECT_LE(solution.lower[s], value[s] + 1e-14) << seed;
      EXPECT_GE(solution.upper[s], value[s] - 1e-14) << seed;
      EXPECT_GE(policy_value[s], solution.lower[s] - 1e-14) << seed;
    }
    EXPECT_LE(solution.gap, 1e-11);
  }
}

TEST(Horizon, CostsAndPlayersInTurn) {
  MdpBuilder b(1.0);
  b.move("A", "slow", "A", 1).move("A", "out", "END", 3);
  const Mdp costs = test::built(b);
  HorizonSettings settings;
  settings.steps = 2;
  settings.maximise = false;
  EXPECT_EQ(solved(costs, settings).upper[0], 2.0);
  settings.steps = 9;
  EXPECT_EQ(solved(costs, settings).lower[0], 3.0);
  // Who moves at A gains 1 and hands B over, where the other can take 5.
  MdpBuilder game(1.0);
  game.alternating(true);
  game.move("A", "give", "B", 1).move("B", "take", "END", 5).move("B", "leave", "END", 0);
  const HorizonSolution played = solved(test::built(game), 2, 1.0);
  EXPECT_EQ(played.lower[0], -4.0);
}

TEST(Horizon, StopsWhereNothingChanges) {
  MdpBuilder b(1.0);
  b.move("A", "go", "END", 1);
  const HorizonSolution solution = solved(test::built(b), 1'000'000, 1.0);
  EXPECT_LE(solution.sweeps, 3u);
  EXPECT_EQ(solution.steps, 1'000'000u);
}

TEST(Horizon, StoppedEarlyTheBoundsHoldStill) {
  MdpBuilder b(1.0);
  b.move("A", "stay", "A", 1).move("A", "gamble", "A", 2, 0.5).move("A", "gamble", "B", 0, 0.5);
  b.move("B", "stay", "B", -1);
  const Mdp mdp = test::built(b);
  HorizonSettings settings;
  settings.steps = 50;
  settings.keep_going = [](const SolveProgress& now) { return now.sweeps < 5; };
  const HorizonSolution solution = solved(mdp, settings);
  EXPECT_LT(solution.steps, 50u);
  EXPECT_LE(solution.lower[0], 50.0);
  EXPECT_GE(solution.upper[0], 50.0);
}

}  // namespace
}  // namespace quoll
