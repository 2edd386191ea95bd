// Models in which one can go round for nothing, though single moves earn and cost: what is earned
// on the way there is paid on the way back. All at discount 1.

#include "quoll/solve/free_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "models.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/evaluate.hpp"

namespace quoll {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(FreeParts, WhatBalancesIsCertified) {
  const Mdp mdp = test::there_and_back();
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp)) continue;
    SCOPED_TRACE(entry.name);
    const auto found = solve(mdp, {}, entry.name);
    ASSERT_TRUE(found) << message(found.error());
    EXPECT_TRUE(found->converged);
    const double values[] = {12, 6, 14, 13, 0};
    for (State s = 0; s < mdp.states(); ++s) {
      EXPECT_LE(found->lower[s], values[s]) << s;
      EXPECT_GE(found->upper[s], values[s]) << s;
    }
    const auto earned = evaluate(mdp, std::span<const Action>(found->policy), 1.0);
    ASSERT_TRUE(earned);
    EXPECT_NEAR(earned->lower[0], 12.0, 1e-6);
  }
}

TEST(FreeParts, HeightsAreExact) {
  const Mdp mdp = test::there_and_back();
  const std::vector<std::uint8_t> live = find_ending(mdp).live;
  FreeParts parts(mdp, live);
  EXPECT_EQ(parts.count(), 0u);
  parts.balance({12.0, 6.0 + 1e-12, 14.0, 13.0 - 1e-12, 0.0}, 14.0);
  EXPECT_EQ(parts.count(), 1u);
  EXPECT_EQ(parts.part(1), 0u);
  EXPECT_EQ(parts.part(2), 0u);
  EXPECT_EQ(parts.part(0), no_component);
  std::vector<double> value{1.0, 3.0, 7.0, 1.0, 0.0};
  parts.level_up(value);
  EXPECT_EQ(value, (std::vector<double>{1.0, 3.0, 11.0, 1.0, 0.0}));
  value = {1.0, 3.0, 7.0, 1.0, 0.0};
  parts.level_down(value);
  EXPECT_EQ(value, (std::vector<double>{1.0, -1.0, 7.0, 1.0, 0.0}));
}

// A pays 1 until it comes to B, 4/3 times; B earns the same on the way back, or leaves for nothing.
// No two doubles differ by 4/3, so that no upper bound can be written; what the policy earns can.
TEST(FreeParts, ABalanceInThirdsLeavesTheUpperBoundOpen) {
  MdpBuilder b(1.0);
  b.move("A", "go", "A", -1, 0.25).move("A", "go", "B", -1, 0.75).move("A", "leave", "END", -3);
  b.move("B", "back", "B", 1, 0.25).move("B", "back", "A", 1, 0.75).move("B", "leave", "END", 0);
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->converged);
  EXPECT_NEAR(found->lower[*mdp.find_state("A")], -4.0 / 3, 1e-9);
  EXPECT_LE(found->lower[*mdp.find_state("B")], 0.0);
  EXPECT_NEAR(found->lower[*mdp.find_state("B")], 0.0, 1e-9);
  EXPECT_EQ(found->upper[*mdp.find_state("B")], inf);
}

}  // namespace
}  // namespace quoll
