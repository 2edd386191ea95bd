// Answers as fractions, where this build can count in them.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "models.hpp"
#include "quoll/solve/rational_solver.hpp"

namespace quoll {
namespace {

class Rationals : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_rationals()) GTEST_SKIP() << "built without GMP";
  }
};

std::string text(const Fraction& fraction) {
  if (fraction.numerator.empty()) return std::to_string(fraction.rounded);
  return fraction.numerator + "/" + fraction.denominator;
}

std::string value(const Mdp& mdp, const RationalSolution& exact, const std::string& state) {
  return text(exact.value[*mdp.find_state(state)]);
}

TEST_F(Rationals, TheLecturesValues) {
  const Mdp mdp = test::adventure();
  const auto exact = solve_in_rationals(mdp, *solve(mdp));
  ASSERT_TRUE(exact) << message(exact.error());
  EXPECT_EQ(value(mdp, *exact, "GATE"), "64/1");
  EXPECT_EQ(text(exact->start), "424/5");  // (64 + 80 + 80 + 100 + 100) / 5
  EXPECT_EQ(exact->switched, 0u);
  EXPECT_FALSE(exact->outside);
}

TEST_F(Rationals, AWorsePolicyIsMended) {
  const Mdp mdp = test::adventure();
  Solution worse = *solve(mdp);
  worse.policy[*mdp.find_state("POOL")] = 1;  // To-GATE, and back
  const auto exact = solve_in_rationals(mdp, worse);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->switched, 1u);
  EXPECT_EQ(value(mdp, *exact, "POOL"), "80/1");
  EXPECT_EQ(value(mdp, *exact, "GATE"), "64/1");
}

// The circle for nothing keeps the value -5 for ever and never earns it; see models.hpp.
TEST_F(Rationals, APolicyThatDoesNotEndIsReplaced) {
  const Mdp mdp = test::free_circle();
  Solution endless = *solve(mdp);
  const State also_free = *mdp.find_state("ALSO-FREE");
  endless.policy[also_free] = 0;
  const auto exact = solve_in_rationals(mdp, endless);
  ASSERT_TRUE(exact) << message(exact.error());
  EXPECT_EQ(value(mdp, *exact, "FREE"), "-5/1");
  EXPECT_EQ(exact->policy[also_free], 1u);
}

TEST_F(Rationals, ABoundThatIsWrongIsFound) {
  const Mdp mdp = test::two_states();
  Solution wrong = *solve(mdp);
  const State b = *mdp.find_state("B");
  wrong.lower[b] = wrong.upper[b] = 2.0000001;
  const auto exact = solve_in_rationals(mdp, wrong);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->outside, b);
}

// V = -1 + 4/5 V, where the doubles are 0.8 and 1 - 0.8.
TEST_F(Rationals, ComputedProbabilitiesAreUnderstood) {
  MdpBuilder builder(1.0);
  builder.move("A", "go", "A", -1, 0.8).move("A", "go", "END", -1, 1.0 - 0.8);
  const Mdp mdp = test::built(builder);
  const auto exact = solve_in_rationals(mdp, *solve(mdp));
  ASSERT_TRUE(exact);
  EXPECT_EQ(text(exact->start), "-5/1");
}

TEST_F(Rationals, StatesThatCannotEndHaveNoFraction) {
  MdpBuilder builder(1.0);
  builder.move("A", "go", "END", -1);
  builder.move("TRAP", "stay", "TRAP", -1);
  builder.start("A");
  const Mdp mdp = test::built(builder);
  const auto exact = solve_in_rationals(mdp, *solve(mdp));
  ASSERT_TRUE(exact) << message(exact.error());
  EXPECT_EQ(value(mdp, *exact, "A"), "-1/1");
  EXPECT_EQ(value(mdp, *exact, "TRAP"), "-inf");
}

TEST_F(Rationals, LimitsAndStops) {
  const Mdp mdp = test::two_states();
  const Solution from = *solve(mdp);
  RationalSettings settings;
  settings.most_outcomes = 3;
  const auto large = solve_in_rationals(mdp, from, settings);
  ASSERT_FALSE(large);
  EXPECT_EQ(message(large.error()),
            "--exact: the model has 4 transitions, and fractions serve up to 3");
  settings.most_outcomes = 4;
  settings.keep_going = [](std::uint64_t) { return false; };
  EXPECT_FALSE(solve_in_rationals(mdp, from, settings));
}

}  // namespace
}  // namespace quoll
