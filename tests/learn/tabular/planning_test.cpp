#include "quoll/learn/tabular/planning.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace quoll {
namespace {

constexpr double never = -std::numeric_limits<double>::infinity();

// 100 states with two actions each, and a last one without any. Known: 10 -> 11 with 1, 11 ends
// with 2 or goes back to 10 with 0, 20 -> 50 with 0. Nothing is known of 50, nor of others.
struct MostlyUnknown {
  MostlyUnknown() : begin(102), model(200) {
    for (std::uint64_t s = 0; s <= 101; ++s) begin[s] = s < 100 ? 2 * s : 200;
    model.observe(20, 11, 1.0);
    model.observe(22, the_end, 2.0);
    model.observe(23, 10, 0.0);
    model.observe(41, 50, 0.0);
  }
  std::vector<std::uint64_t> begin;
  CountedModel model;
};

void expect_values(const MostlyUnknown& known, const Plan& found, const Planning& planning,
                   const std::vector<std::pair<State, double>>& values) {
  ASSERT_TRUE(found.solved);
  ASSERT_EQ(found.state_value.size(), 101u);
  std::vector<double> expected(101, planning.stuck);
  expected[100] = 0.0;  // no actions, nothing to be stuck in
  for (const auto& [s, value] : values) expected[s] = value;
  EXPECT_EQ(found.state_value, expected);
  EXPECT_EQ(found.lower, expected);
  EXPECT_EQ(found.upper, expected);
  ASSERT_EQ(found.policy.size(), 101u);
  ASSERT_EQ(found.pair_value.size(), 200u);
  for (std::uint64_t pair = 0; pair < 200; ++pair) {
    EXPECT_EQ(found.pair_value[pair] == never, known.model.tried(pair) == 0) << pair;
  }
}

TEST(Planning, ValuesOfTheFewStatesThatAreKnownAmongMany) {
  MostlyUnknown known;
  Planning planning;
  planning.discount = 0.5;
  planning.stuck = -4.0;
  const Plan found = plan(known.model, known.begin, planning);
  expect_values(known, found, planning, {{10, 2.0}, {11, 2.0}, {20, -2.0}});
  EXPECT_EQ(found.pair_value[20], 2.0);
  EXPECT_EQ(found.pair_value[23], 1.0);
  EXPECT_EQ(found.pair_value[41], -2.0);
  std::vector<Action> policy(101, no_action);
  policy[10] = policy[11] = 0;
  policy[20] = 1;
  EXPECT_EQ(found.policy, policy);
}

TEST(Planning, TheSameWithoutDiscounting) {
  MostlyUnknown known;
  Planning planning;
  planning.stuck = -4.0;
  const Plan found = plan(known.model, known.begin, planning);
  // 10 -> 11 -> end earns 3; going round for 1 a turn is no way to an end, but it gains: no plan.
  EXPECT_FALSE(found.solved);
  MostlyUnknown costly;
  for (int i = 0; i < 3; ++i) costly.model.observe(23, 10, -2.0);  // on average -1.5
  const Plan other = plan(costly.model, costly.begin, planning);
  expect_values(costly, other, planning, {{10, 3.0}, {11, 2.0}});
}

// A pair with two outcomes, so that the solver sees all states; what is known elsewhere is worth
// the same.
TEST(Planning, ASecondOutcomeElsewhereChangesNoValue) {
  MostlyUnknown known;
  Planning planning;
  planning.discount = 0.5;
  planning.stuck = -4.0;
  const Plan few = plan(known.model, known.begin, planning);
  known.model.observe(198, 98, 0.0);
  known.model.observe(198, 97, 0.0);
  const Plan all = plan(known.model, known.begin, planning);
  for (const State s : {10, 11, 20, 50, 60, 100}) {
    EXPECT_NEAR(few.state_value[s], all.state_value[s], 1e-9) << s;
    EXPECT_EQ(few.policy[s], all.policy[s]) << s;
  }
}

}  // namespace
}  // namespace quoll
