#include "quoll/solve/average_reward.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models.hpp"
#include "quoll/env/world.hpp"

namespace quoll {
namespace {

AverageSolution solved(const Mdp& mdp, const SolveSettings& settings = {}) {
  Result<AverageSolution> solution = solve_average(mdp, settings);
  EXPECT_TRUE(solution);
  return std::move(*solution);
}

// The gain of a policy in each state by P* = lim of ((I + P) / 2)^n, squared again and again.
std::vector<double> gain_of(const Mdp& mdp, const std::vector<Action>& policy) {
  const std::size_t n = mdp.states();
  std::vector<double> p(n * n, 0.0);
  std::vector<double> reward(n, 0.0);
  for (State s = 0; s < n; ++s) {
    p[s * n + s] = 0.5;
    if (mdp.terminal(s)) {
      p[s * n + s] = 1.0;
      continue;
    }
    const std::uint64_t c = mdp.choice_begin(s) + policy[s];
    reward[s] = mdp.reward(c);
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      p[s * n + mdp.next(o)] += 0.5 * mdp.probability(o);
    }
  }
  for (int k = 0; k < 30; ++k) {
    std::vector<double> square(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t m = 0; m < n; ++m) square[i * n + m] += p[i * n + j] * p[j * n + m];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {  // rows sum to 1 in spite of rounding
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) sum += square[i * n + j];
      for (std::size_t j = 0; j < n; ++j) square[i * n + j] /= sum;
    }
    p = std::move(square);
  }
  std::vector<double> gain(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) gain[i] += p[i * n + j] * reward[j];
  }
  return gain;
}

// The best gain in each state over all policies.
std::vector<double> best_gain(const Mdp& mdp) {
  std::vector<Action> policy(mdp.states(), 0);
  std::vector<double> best(mdp.states(), -1e300);
  for (;;) {
    const std::vector<double> gain = gain_of(mdp, policy);
    for (State s = 0; s < mdp.states(); ++s) best[s] = std::max(best[s], gain[s]);
    State s = 0;
    while (s < mdp.states() && (mdp.terminal(s) || ++policy[s] == mdp.actions(s))) policy[s++] = 0;
    if (s == mdp.states()) return best;
  }
}

/// Howard 1960, "Dynamic Programming and Markov Processes", the taxicab of chapter 5.
Mdp taxicab() {
  struct Trip {
    const char* from;
    const char* action;
    double p[3], fare[3];
  };
  const Trip trips[]{{"A", "cruise", {1 / 2., 1 / 4., 1 / 4.}, {10, 4, 8}},
                     {"A", "stand", {1 / 16., 3 / 4., 3 / 16.}, {8, 2, 4}},
                     {"A", "radio", {1 / 4., 1 / 8., 5 / 8.}, {4, 6, 4}},
                     {"B", "cruise", {1 / 2., 0, 1 / 2.}, {14, 0, 18}},
                     {"B", "stand", {1 / 16., 7 / 8., 1 / 16.}, {8, 16, 8}},
                     {"C", "cruise", {1 / 4., 1 / 4., 1 / 2.}, {10, 2, 8}},
                     {"C", "stand", {1 / 8., 3 / 4., 1 / 8.}, {6, 4, 2}},
                     {"C", "radio", {3 / 4., 1 / 16., 3 / 16.}, {4, 0, 8}}};
  MdpBuilder b(1.0);
  for (const char* town : {"A", "B", "C"}) b.state(town);
  for (const Trip& trip : trips) {
    for (int to = 0; to < 3; ++to) {
      if (trip.p[to] == 0.0) continue;
      b.move(trip.from, trip.action, std::string(1, static_cast<char>('A' + to)), trip.fare[to],
             trip.p[to]);
    }
  }
  return test::built(b);
}

TEST(Average, HowardsTaxicab) {
  // Published: the stand in every town, gain 13.34, relative values -1.18, 12.66, 0 (C = 0); as
  // fractions by elimination 1588/119 and -20/17, 1506/119.
  const AverageSolution solution = solved(taxicab());
  EXPECT_EQ(solution.structure, ChainStructure::unichain);
  EXPECT_TRUE(solution.converged);
  for (State s = 0; s < 3; ++s) {
    EXPECT_LE(solution.lower[s], 1588.0 / 119.0);
    EXPECT_GE(solution.upper[s], 1588.0 / 119.0);
    EXPECT_EQ(solution.policy[s], 1u);
  }
  EXPECT_LE(solution.gap, 1e-6);
  EXPECT_NEAR(solution.bias[0] - solution.bias[2], -20.0 / 17.0, 1e-5);
  EXPECT_NEAR(solution.bias[1] - solution.bias[2], 1506.0 / 119.0, 1e-5);
}

TEST(Average, ACircleHasItsMean) {
  // Two steps that earn 3 and 0: the gain is 3/2 although the rewards never settle.
  MdpBuilder b(1.0);
  b.move("A", "go", "B", 3).move("B", "go", "A", 0).move("B", "wait", "B", 1);
  const AverageSolution solution = solved(test::built(b));
  EXPECT_LE(solution.lower[0], 1.5);
  EXPECT_GE(solution.upper[1], 1.5);
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.structure, ChainStructure::unichain);  // nothing avoids B
}

TEST(Average, RiverSwim) {
  // Always to the right: a birth-death chain, whose stationary distribution is a product.
  const auto world = find_world("river-swim");
  ASSERT_TRUE(world);
  const Mdp& mdp = *world->mdp;
  const AverageSolution solution = solved(mdp);
  std::vector<Action> right(mdp.states(), 0);
  for (State s = 0; s < mdp.states(); ++s) {
    for (Action a = 0; a < mdp.actions(s); ++a) {
      if (mdp.action_name(mdp.choice_begin(s) + a) == "right") right[s] = a;
    }
  }
  EXPECT_EQ(solution.policy, right);
  EXPECT_NEAR(solution.lower[0], gain_of(mdp, right)[0], 1e-5 * std::fabs(solution.upper[0]));
  EXPECT_TRUE(solution.converged);
}

TEST(Average, SeveralClassesAreNamedAndTheBestIsGoneTo) {
  // From START a coin decides between LEFT (2 a step for ever) and RIGHT (5): 3.5; 100 at once are
  // nothing in the long run. POOR and POORER earn 1 a step, and POORER can be left for START.
  MdpBuilder b(1.0);
  b.move("START", "toss", "LEFT", 0, 0.5).move("START", "toss", "RIGHT", 0, 0.5);
  b.move("START", "sure", "LEFT", 100);
  b.move("LEFT", "stay", "LEFT", 2).move("RIGHT", "stay", "RIGHT", 5);
  b.move("POOR", "stay", "POOR", 1).move("POOR", "turn", "POORER", 1);
  b.move("POORER", "back", "POOR", 1).move("POORER", "leave", "START", -50);
  b.move("DOOMED", "fall", "END", 7);
  const Mdp mdp = test::built(b);
  const AverageSolution solution = solved(mdp);
  EXPECT_EQ(solution.structure, ChainStructure::multichain);
  ASSERT_EQ(solution.classes.size(), 4u);
  const auto gain = [&](const char* name) { return solution.lower[*mdp.find_state(name)]; };
  EXPECT_NEAR(gain("START"), 3.5, 1e-9);
  EXPECT_EQ(gain("LEFT"), 2.0);  // proved without rounding where nothing moves
  EXPECT_EQ(gain("RIGHT"), 5.0);
  EXPECT_NEAR(gain("POOR"), 3.5, 1e-9);
  EXPECT_NEAR(gain("DOOMED"), 0.0, 1e-12);
  EXPECT_EQ(solution.policy[*mdp.find_state("POOR")], 1u);
  EXPECT_FALSE(solution.classes[solution.part[*mdp.find_state("POOR")]].stays);
  EXPECT_TRUE(std::isnan(solution.bias[*mdp.find_state("POOR")]));
  EXPECT_TRUE(solution.classes.back().ends);
}

TEST(Average, WhereAllEndsTheAverageIsNought) {
  const AverageSolution solution = solved(test::gambler());
  EXPECT_EQ(solution.structure, ChainStructure::unichain);
  EXPECT_EQ(solution.gap, 0.0);
  EXPECT_EQ(solution.upper[0], 0.0);
  EXPECT_NEAR(solution.bias[0], 1.0 / 16.0, 1e-5);  // what is earned until then
}

// States with up to three actions; each action keeps to one, two or three successors in eighths.
Mdp loose_model(std::uint64_t seed, unsigned states, bool ends) {
  std::uint64_t x = seed * 2862933555777941757u + 3037000493u;
  const auto draw = [&x](unsigned below) {
    x = x * 6364136223846793005u + 1442695040888963407u;
    return static_cast<unsigned>((x >> 33) % below);
  };
  MdpBuilder b(1.0);
  for (unsigned s = 0; s < states; ++s) b.state(std::to_string(s));
  for (unsigned s = 0; s < states; ++s) {
    if (ends && s + 1 == states) break;
    const unsigned actions = 1 + draw(3);
    for (unsigned a = 0; a < actions; ++a) {
      const std::uint32_t action = b.action("a" + std::to_string(a));
      const double reward = 0.5 * draw(17) - 4.0;
      unsigned left = 8;
      for (unsigned k = 0; k < 3 && left > 0; ++k) {
        const unsigned share = k == 2 || draw(2) == 0 ? left : 1 + draw(left);
        b.move(s, action, draw(states), reward, share / 8.0);
        left -= share;
      }
    }
  }
  return test::built(b);
}

TEST(Average, HoldsAgainstEveryPolicyOfRandomModels) {
  int kinds[4] = {};
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Mdp mdp = loose_model(seed, 2 + seed % 4, seed % 5 == 0);
    SolveSettings settings;
    settings.width = 1e-8;
    const AverageSolution solution = solved(mdp, settings);
    ++kinds[static_cast<int>(solution.structure)];
    const std::vector<double> best = best_gain(mdp);
    const std::vector<double> own = gain_of(mdp, solution.policy);
    for (State s = 0; s < mdp.states(); ++s) {
      EXPECT_LE(solution.lower[s], best[s] + 1e-7) << seed;
      EXPECT_GE(solution.upper[s], best[s] - 1e-7) << seed;
      EXPECT_GE(own[s], solution.lower[s] - 1e-7) << seed;
    }
    EXPECT_TRUE(solution.converged) << seed << " gap " << solution.gap;
    if (solution.structure == ChainStructure::multichain) continue;
    EXPECT_NEAR(*std::max_element(best.begin(), best.end()),
                *std::min_element(best.begin(), best.end()), 1e-7)
        << seed;
  }
  for (const int kind : kinds) EXPECT_GT(kind, 0);
}

TEST(Average, CostsAndGames) {
  const Mdp mdp = taxicab();
  SolveSettings settings;
  settings.maximise = false;
  const AverageSolution least = solved(mdp, settings);
  const Mdp same = taxicab();
  std::vector<Action> policy(3, 0);
  double worst = 1e300;
  for (policy[0] = 0; policy[0] < 3; ++policy[0]) {
    for (policy[1] = 0; policy[1] < 2; ++policy[1]) {
      for (policy[2] = 0; policy[2] < 3; ++policy[2]) {
        worst = std::min(worst, gain_of(mdp, policy)[0]);
      }
    }
  }
  EXPECT_NEAR(least.lower[0], worst, 1e-5);
  EXPECT_LE(least.lower[0], worst + 1e-8);
  EXPECT_GE(least.upper[0], worst - 1e-8);
  MdpBuilder game(1.0);
  game.alternating(true);
  game.move("A", "pass", "A", 1);
  EXPECT_FALSE(solve_average(test::built(game)));
}

TEST(Average, StoppedEarlyTheBoundsHoldStill) {
  const Mdp mdp = taxicab();
  SolveSettings settings;
  settings.keep_going = [](const SolveProgress& now) { return now.sweeps < 3; };
  const AverageSolution solution = solved(mdp, settings);
  EXPECT_FALSE(solution.converged);
  EXPECT_LE(solution.lower[0], 1588.0 / 119.0);
  EXPECT_GE(solution.upper[0], 1588.0 / 119.0);
}

}  // namespace
}  // namespace quoll
