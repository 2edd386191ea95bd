#include "quoll/solve/evaluate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "models.hpp"

namespace quoll {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

void expect_value(const Evaluation& value, const Mdp& mdp, const char* name, double expected) {
  const State s = *mdp.find_state(name);
  EXPECT_LE(value.lower[s], expected) << name;
  EXPECT_GE(value.upper[s], expected) << name;
  if (std::isfinite(expected)) {
    EXPECT_LE(value.upper[s] - value.lower[s], 1e-8) << name;
  }
}

TEST(Evaluate, FollowsADeterministicPolicyToTheEnd) {
  const Mdp mdp = test::adventure();
  // GATE-POOL-GATE is a circle worth 0; HALL-CAVE-GOAL: 80; CAVE: 100; WELL-POOL: 0.
  std::vector<Action> policy(mdp.states(), no_action);
  policy[*mdp.find_state("GATE")] = 0;
  policy[*mdp.find_state("POOL")] = 1;
  policy[*mdp.find_state("HALL")] = 0;
  policy[*mdp.find_state("CAVE")] = 0;
  policy[*mdp.find_state("WELL")] = 1;
  const auto value = evaluate(mdp, policy, 0.8);
  ASSERT_TRUE(value);
  expect_value(*value, mdp, "GATE", 0);
  expect_value(*value, mdp, "POOL", 0);
  expect_value(*value, mdp, "WELL", 0);
  expect_value(*value, mdp, "HALL", 80);
  expect_value(*value, mdp, "CAVE", 100);
}

TEST(Evaluate, IsExactWhereArithmeticIs) {
  // A loop that earns 1, 3 at discount 1/2: V = (1 + 3/2) / (1 - 1/4) = 10/3; from the other state
  // (3 + 1/2) / (3/4) = 14/3. A self-loop that earns 1: 2, exactly.
  MdpBuilder b(0.5);
  b.move("A", "go", "B", 1).move("B", "go", "A", 3).move("C", "stay", "C", 1);
  const Mdp mdp = test::built(b);
  const auto value = evaluate(mdp, std::vector<Action>{0, 0, 0}, 0.5);
  ASSERT_TRUE(value);
  EXPECT_LT(value->lower[0], 10.0 / 3 + 1e-15);
  EXPECT_GT(value->upper[0], 10.0 / 3 - 1e-15);
  EXPECT_LT(value->upper[0] - value->lower[0], 4e-15);
  expect_value(*value, mdp, "B", 14.0 / 3);
  EXPECT_EQ(value->lower[2], 2.0);
  EXPECT_EQ(value->upper[2], 2.0);
}

TEST(Evaluate, SaysWhatNeverEndingIsWorth) {
  MdpBuilder b(1.0);
  b.move("LOSE", "stay", "LOSE", -1).move("WIN", "stay", "WIN", 1).move("REST", "stay", "REST", 0);
  b.move("SWING", "go", "BACK", 1).move("BACK", "go", "SWING", -1);
  b.move("TO-REST", "go", "REST", -2).move("TO-LOSE", "go", "LOSE", 5).move("OUT", "go", "END", 7);
  const Mdp mdp = test::built(b);
  for (const bool chain : {false, true}) {
    const auto value = chain ? evaluate(mdp, uniform_policy(mdp), 1.0)
                             : evaluate(mdp, std::vector<Action>(mdp.states(), 0), 1.0);
    ASSERT_TRUE(value);
    const auto lower = [&](const char* name) { return value->lower[*mdp.find_state(name)]; };
    const auto upper = [&](const char* name) { return value->upper[*mdp.find_state(name)]; };
    EXPECT_EQ(upper("LOSE"), -inf);
    EXPECT_EQ(lower("WIN"), inf);
    EXPECT_EQ(lower("SWING"), -inf);
    EXPECT_EQ(upper("SWING"), inf);
    EXPECT_EQ(upper("TO-LOSE"), -inf);
    expect_value(*value, mdp, "REST", 0);
    expect_value(*value, mdp, "TO-REST", -2);
    expect_value(*value, mdp, "OUT", 7);
  }
}

TEST(Evaluate, MixesActions) {
  // A fair walk on 0..4 with ends 0 and 4 that pays 1 at 4: V(k) = k/4; expected moves k (4 - k).
  for (const double cost : {0.0, 1.0}) {
    MdpBuilder b(1.0);
    for (int k = 1; k < 4; ++k) {
      b.move(std::to_string(k), "down", std::to_string(k - 1), -cost);
      b.move(std::to_string(k), "up", std::to_string(k + 1), (k == 3 ? 1.0 : 0.0) - cost);
    }
    const Mdp mdp = test::built(b);
    const auto value = evaluate(mdp, uniform_policy(mdp), 1.0);
    ASSERT_TRUE(value);
    EXPECT_TRUE(value->converged);
    for (int k = 1; k < 4; ++k) {
      expect_value(*value, mdp, std::to_string(k).c_str(), k / 4.0 - cost * k * (4 - k));
    }
  }
}

TEST(Evaluate, FollowsLongWalksToTheirEnd) {
  // A walk on 0..n that turns back at 0 and ends at n takes n^2 - k^2 moves on average from k:
  // V(k) = 1 + (V(k - 1) + V(k + 1)) / 2 with V(0) = 1 + V(1). Exact in doubles.
  constexpr int n = 2000;
  MdpBuilder b(1.0);
  b.move("0", "up", "1", -1);
  for (int k = 1; k < n; ++k) {
    b.move(std::to_string(k), "down", std::to_string(k - 1), -1);
    b.move(std::to_string(k), "up", std::to_string(k + 1), -1);
  }
  const Mdp mdp = test::built(b);
  const auto value = evaluate(mdp, uniform_policy(mdp), 1.0, 1e-11 * n * n);
  ASSERT_TRUE(value);
  EXPECT_TRUE(value->converged);
  for (int k = 0; k < n; ++k) {
    const State s = *mdp.find_state(std::to_string(k));
    EXPECT_LE(value->lower[s], -(1.0 * n * n - 1.0 * k * k));
    EXPECT_GE(value->upper[s], -(1.0 * n * n - 1.0 * k * k));
  }
}

// A walk that comes to its end after about 9^40 moves: no sweeping helps. That so much is earned,
// or lost, by the first thousand moves is proved all the same.
TEST(Evaluate, GivesUpAtOnceWhereEpisodesHardlyEnd) {
  constexpr int n = 40;
  for (const double reward : {-1.0, 1.0}) {
    MdpBuilder b(1.0);
    for (int k = 0; k < n; ++k) {
      b.move(std::to_string(k), "down", std::to_string(std::max(k - 1, 0)), reward);
      b.move(std::to_string(k), "up", std::to_string(k + 1), reward);
    }
    const Mdp mdp = test::built(b);
    std::vector<double> mostly_down(mdp.choices(), 0.9);
    for (State s = 0; s < mdp.states(); ++s) {
      if (!mdp.terminal(s)) mostly_down[mdp.choice_begin(s) + 1] = 0.1;
    }
    std::uint64_t sweeps = 0;
    const auto value = evaluate(mdp, mostly_down, 1.0, 1e-9, [&](const SolveProgress& now) {
      sweeps = std::max(sweeps, now.sweeps);
      return true;
    });
    ASSERT_TRUE(value);
    EXPECT_FALSE(value->converged);
    EXPECT_EQ(sweeps, 0u);
    const double earned = reward > 0.0 ? value->lower[0] : -value->upper[0];
    const double open = reward > 0.0 ? value->upper[0] : -value->lower[0];
    EXPECT_GE(earned, 1000.0);
    EXPECT_LE(earned, std::pow(9.0, n));
    EXPECT_EQ(open, std::numeric_limits<double>::infinity());
  }
}

TEST(Evaluate, IsNotDoneWhereNothingIsKnown) {
  // A circle that gains and loses: the total of an endless walk is not defined.
  MdpBuilder b(1.0);
  b.move("A", "go", "B", 1).move("B", "go", "A", -1).move("B", "out", "END", 0);
  const Mdp mdp = test::built(b);
  std::vector<double> circle(mdp.choices(), 0.0);
  circle[mdp.choice_begin(*mdp.find_state("A"))] = 1.0;
  circle[mdp.choice_begin(*mdp.find_state("B"))] = 1.0;
  const auto value = evaluate(mdp, circle, 1.0);
  ASSERT_TRUE(value);
  EXPECT_FALSE(value->converged);
}

TEST(Evaluate, StopsWhenAsked) {
  MdpBuilder b(1.0);
  for (int k = 0; k < 600; ++k) {
    b.move(std::to_string(k), "stay", std::to_string(k), -1);
    b.move(std::to_string(k), "up", std::to_string(k + 1), -1);
  }
  const Mdp mdp = test::built(b);
  const auto value =
      evaluate(mdp, uniform_policy(mdp), 1.0, 1e-9, [](const SolveProgress&) { return false; });
  ASSERT_TRUE(value);
  EXPECT_FALSE(value->converged);
}

TEST(Evaluate, MixesActionsDiscounted) {
  // V(A) = (2 + V(A) / 2) / 2 + 0 / 2, so V(A) = 4/3.
  MdpBuilder b(0.5);
  b.move("A", "stay", "A", 2).move("A", "leave", "END", 0);
  const Mdp mdp = test::built(b);
  const auto value = evaluate(mdp, uniform_policy(mdp), 0.5, 1e-12);
  ASSERT_TRUE(value);
  expect_value(*value, mdp, "A", 4.0 / 3);
}

TEST(Evaluate, BoundsAnUnknownActionByTheRewards) {
  const Mdp mdp = test::adventure();
  std::vector<Action> policy(mdp.states(), 0);
  policy[*mdp.find_state("POOL")] = no_action;
  const auto value = evaluate(mdp, policy, 0.8);
  ASSERT_TRUE(value);
  const State pool = *mdp.find_state("POOL");
  EXPECT_EQ(value->lower[pool], 0.0);
  EXPECT_NEAR(value->upper[pool], 500.0, 1e-9);  // 100 / (1 - 0.8)
  EXPECT_NEAR(value->upper[*mdp.find_state("GATE")], 400.0, 1e-9);
}

TEST(Evaluate, RefusesForeignPolicies) {
  const Mdp mdp = test::adventure();
  EXPECT_FALSE(evaluate(mdp, std::vector<Action>{0}, 0.8));
  EXPECT_FALSE(evaluate(mdp, std::vector<Action>(mdp.states(), 9), 0.8));
  EXPECT_FALSE(evaluate(mdp, std::vector<double>(mdp.choices(), 0.7), 0.8));
  EXPECT_FALSE(evaluate(mdp, uniform_policy(mdp), 1.5));
}

}  // namespace
}  // namespace quoll
