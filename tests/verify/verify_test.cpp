#include "quoll/verify/verify.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../solve/models.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Mdp two_steps() {
  MdpBuilder b(1.0);
  b.move("A", "go", "B", -1).move("A", "stay", "A", 0).move("B", "go", "END", -1);
  return test::built(b);
}

TEST(Verify, AcceptsTheExactValues) {
  const Mdp mdp = two_steps();  // A, B, END
  const std::vector<double> value{-2, -1, 0};
  const auto verdict = verify(mdp, value, value, std::vector<Action>{0, 0, no_action}, 1.0);
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->accepted) << verdict->reason;
}

TEST(Verify, NamesTheStateThatIsWrong) {
  const Mdp mdp = two_steps();
  const std::vector<double> value{-2, -1, 0};
  const std::vector<Action> policy{0, 0, no_action};
  const auto refused = [&](std::vector<double> lower, std::vector<double> upper,
                           std::vector<Action> p, State at) {
    const auto verdict = verify(mdp, lower, upper, p, 1.0);
    ASSERT_TRUE(verdict);
    EXPECT_FALSE(verdict->accepted);
    EXPECT_EQ(verdict->state, std::optional(at)) << verdict->reason;
    EXPECT_NE(verdict->reason.find(mdp.state_name(at)), std::string::npos);
  };
  const double more = -1 + 0x1p-52;
  refused({-2, more, 0}, {0, more, 0}, policy, 1);             // lower too high by one bit
  refused({-2, -1 - 1e-9, 0}, {-2, -1 - 1e-9, 0}, policy, 0);  // lower of A not reached
  refused({-5, -3, 0}, {-2, -1 - 1e-9, 0}, policy, 1);         // upper too low
  refused({-1, -2, 0}, {-2, -1, 0}, policy, 0);                // crossed
  refused({-11, -9, 1}, {9, 9, 2}, policy, 2);                 // an end is worth 0
  refused({-2, -1, 0}, {-2, -1, 0}, {1, 0, no_action}, 0);     // stays for ever
  refused({-2, -1, 0}, {-2, -1, 0}, {no_action, 0, no_action}, 0);
}

TEST(Verify, RefusesInfinityWhereValuesAreFinite) {
  const Mdp mdp = test::two_states();
  const std::vector<Action> policy{1, 0};
  EXPECT_FALSE(
      verify(mdp, std::vector<double>{-inf, -inf}, std::vector<double>{-inf, -inf}, policy, 0.5)
          ->accepted);
  EXPECT_FALSE(
      verify(mdp, std::vector<double>{inf, inf}, std::vector<double>{inf, inf}, policy, 0.5)
          ->accepted);
  EXPECT_TRUE(
      verify(mdp, std::vector<double>{-inf, -inf}, std::vector<double>{inf, inf}, policy, 0.5)
          ->accepted);
  EXPECT_TRUE(
      verify(mdp, std::vector<double>{1, 2}, std::vector<double>{1, 2}, policy, 0.5)->accepted);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      verify(mdp, std::vector<double>{nan, 2}, std::vector<double>{nan, 2}, policy, 0.5)->accepted);
}

TEST(Verify, AcceptsWhatTheSolversReturn) {
  for (const double discount : {0.3, 0.8, 0.99, 1.0}) {
    for (const SolverEntry& entry : solvers()) {
      SolveSettings settings;
      settings.discount = discount;
      const Mdp mdp = test::adventure();
      if (!test::can_do(entry, mdp, discount)) continue;
      const auto found = solve(mdp, settings, entry.name);
      ASSERT_TRUE(found);
      const auto verdict = verify(mdp, found->lower, found->upper, found->policy, discount);
      ASSERT_TRUE(verdict);
      EXPECT_TRUE(verdict->accepted) << entry.name << ": " << verdict->reason;
    }
  }
}

TEST(Verify, RefusesArraysOfTheWrongLength) {
  const Mdp mdp = two_steps();
  const std::vector<double> value{-2, -1, 0};
  EXPECT_FALSE(verify(mdp, value, value, std::vector<Action>{0}, 1.0));
  EXPECT_FALSE(verify(mdp, value, value, std::vector<Action>{0, 5, 0}, 1.0));
  EXPECT_FALSE(verify(mdp, value, value, std::vector<Action>{0, 0, 0}, 0.0));
}

}  // namespace
}  // namespace quoll
