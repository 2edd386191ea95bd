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

TEST(Verify, RefusesInfinityThatSumsCannotContradict) {
  // A tries until it ends: V = -2. Infinite claims pass every sum, since A comes after A.
  MdpBuilder b(1.0);
  b.move("A", "try", "A", -1, 0.5)
      .move("A", "try", "END", -1, 0.5)
      .move("TRAP", "stay", "TRAP", -1);
  b.start("A");
  const Mdp mdp = test::built(b);  // A, END, TRAP
  const std::vector<Action> policy{0, no_action, 0};
  const auto accepted = [&](double lower, double upper, double trap) {
    const std::vector<double> low{lower, 0, -inf};
    return verify(mdp, low, std::vector<double>{upper, 0, trap}, policy, 1.0)->accepted;
  };
  EXPECT_TRUE(accepted(-2, -2, -inf));  // no way leads out of TRAP
  EXPECT_TRUE(accepted(-2, -2, inf));
  EXPECT_FALSE(accepted(-inf, -inf, -inf));  // A can end
  EXPECT_FALSE(accepted(inf, inf, inf));
}

TEST(Verify, CostsAreTheMirroredConditions) {
  MdpBuilder b(1.0);
  b.move("A", "try", "A", 1, 0.5).move("A", "try", "END", 1, 0.5).move("A", "pay", "END", 3);
  const Mdp mdp = test::built(b);
  const auto accepted = [&](double lower, double upper, Action action) {
    const std::vector<Action> policy{action, no_action};
    return verify(mdp, std::vector<double>{lower, 0}, std::vector<double>{upper, 0}, policy, 1.0,
                  false)
        ->accepted;
  };
  EXPECT_TRUE(accepted(2, 2, 0));
  EXPECT_TRUE(accepted(1, 3, 1));
  EXPECT_FALSE(accepted(2, 2, 1));                // pays 3
  EXPECT_FALSE(accepted(2 + 0x1p-51, 2.125, 0));  // the least cost is 2
  EXPECT_FALSE(accepted(2, 2 - 0x1p-52, 0));
}

TEST(Verify, TellsWhatWasClaimedAndFound) {
  const Mdp mdp = test::adventure(0.5);  // CAVE = 100, POOL = 50
  std::vector<double> value{25, 50, 50, 100, 100, 0};
  std::vector<Action> policy{0, 0, 0, 0, 0, no_action};
  std::vector<State> place;
  for (const char* name : {"GATE", "HALL", "POOL", "CAVE", "WELL", "GOAL"}) {
    place.push_back(*mdp.find_state(name));
  }
  std::vector<double> lower(6), upper(6);
  for (std::size_t i = 0; i < 6; ++i) lower[place[i]] = upper[place[i]] = value[i];
  ASSERT_TRUE(verify(mdp, lower, upper, policy, 0.5)->accepted);
  upper[place[2]] = 51;
  lower[place[2]] = 50.5;
  const auto verdict = verify(mdp, lower, upper, policy, 0.5);
  // GATE earns half of POOL's 51 and is the first state.
  EXPECT_EQ(verdict->reason, "state GATE: action To-POOL may earn 25.5, more than upper 25");
  EXPECT_EQ(verdict->claimed, std::optional(25.0));
  EXPECT_EQ(verdict->found, std::optional(25.5));
  upper[place[0]] = 25.5;
  upper[place[1]] = 50;
  lower[place[0]] = 25;
  EXPECT_EQ(verify(mdp, lower, upper, policy, 0.5)->reason,
            "state POOL: the policy's action To-CAVE may earn only 50, less than lower 50.5");
  const Proved proof = proved(mdp, lower, upper);
  EXPECT_EQ(proof.gap, 0.5);
  EXPECT_EQ(proof.widest, place[0]);
  EXPECT_LE(proof.start_lower, 65.1);  // (25 + 50 + 50.5 + 100 + 100) / 5, outward
  EXPECT_GT(proof.start_lower, 65.1 - 1e-13);
  EXPECT_GE(proof.start_upper, 65.3);  // (25.5 + 50 + 51 + 100 + 100) / 5
  EXPECT_LT(proof.start_upper, 65.3 + 1e-13);
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
