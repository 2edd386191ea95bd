// Models on which a public solver gave a wrong value or a policy that does not attain its value.
// Each is solved by every method that can, and the policy is valued again by itself.

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "models.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

// The chosen action's name.
std::string chosen(const Mdp& mdp, const Solution& found, const std::string& state) {
  const State s = *mdp.find_state(state);
  return mdp.action_name(mdp.choice_begin(s) + found.policy[s]);
}

// Every solver's interval holds the values, and so does that of its policy judged alone.
std::vector<Solution> expect_all(const Mdp& mdp, const Values& truth, double discount = 1.0) {
  std::vector<Solution> all;
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp, discount)) continue;
    SCOPED_TRACE(entry.name);
    SolveSettings settings;
    settings.discount = discount;
    const auto found = solve(mdp, settings, entry.name);
    if (!found) {
      ADD_FAILURE() << message(found.error());
      continue;
    }
    EXPECT_TRUE(found->converged);
    const auto earned = evaluate(mdp, std::span<const Action>(found->policy), discount);
    if (!earned) {
      ADD_FAILURE() << message(earned.error());
      continue;
    }
    for (const auto& [name, value] : truth) {
      const State s = *mdp.find_state(name);
      EXPECT_LE(found->lower[s], value) << name;
      EXPECT_GE(found->upper[s], value) << name;
      EXPECT_NEAR(earned->lower[s], value, 1e-5) << name;
      EXPECT_NEAR(earned->upper[s], value, 1e-5) << name;
    }
    all.push_back(*found);
  }
  EXPECT_FALSE(all.empty());
  return all;
}

// Storm's tracker, 1061: each move costs 10 and ends with probability 1/10, so that ten are
// expected and the value is -100. Storm's default answered 0 (values were kept from becoming
// negative), its sound mode -59.4997.
TEST(WrongAnswers, NegativeRewardsAreEarnedInFull) {
  MdpBuilder b(1.0);
  b.move("0", "go", "1", -10, 0.9).move("0", "go", "2", -10, 0.1);
  b.move("1", "go", "0", -10, 0.9).move("1", "go", "2", -10, 0.1);
  b.start("0");
  expect_all(test::built(b), {{"0", -100.0}, {"1", -100.0}, {"2", 0.0}});
}

// Storm's tracker, 940: going round in 1 keeps the best value for ever without ever winning, and
// the extracted policy did. Here 2 wins with probability 1/2; "cycle" must not be chosen.
TEST(WrongAnswers, APolicyGoesOnToTheGoal) {
  MdpBuilder b(1.0);
  b.move("0", "go", "1");
  b.move("1", "cycle", "1").move("1", "go", "2");
  b.move("2", "win", "3", 1.0, 0.5).move("2", "win", "4", 0.0, 0.5);
  b.move("2", "go", "4");
  b.start("0");
  const Mdp mdp = test::built(b);
  for (const Solution& found : expect_all(mdp, {{"0", 0.5}, {"1", 0.5}, {"2", 0.5}})) {
    EXPECT_EQ(chosen(mdp, found, "1"), "go");
    EXPECT_EQ(chosen(mdp, found, "2"), "win");
  }
}

// Storm's tracker, 683: every move earns 1, and in 2 one can stay for ever (a4), so that the
// largest total is infinite; the extracted policy left 2 (a3) and earned 4 only. Quoll names the
// state that gains; with a discount staying is found to be best, and as a cost leaving is.
Mdp endless_gain() {
  MdpBuilder b(1.0);
  b.move("0", "a1", "1", 1);
  b.move("1", "a2", "2", 1, 0.5).move("1", "a2", "3", 1, 0.5);
  b.move("2", "a3", "1", 1).move("2", "a4", "2", 1);
  b.start("0");
  return test::built(b);
}

TEST(WrongAnswers, AGainForEverIsNamed) {
  const Mdp mdp = endless_gain();
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp)) continue;
    const auto found = solve(mdp, {}, entry.name);
    ASSERT_FALSE(found) << entry.name;
    EXPECT_NE(message(found.error()).find("this one does: "), std::string::npos);
  }
  // At discount 1/2: V(2) = 1 / (1 - 1/2) = 2 by staying, V(1) = 1 + 1/2 (2/2) = 3/2, V(0) = 7/4.
  for (const Solution& found : expect_all(mdp, {{"0", 1.75}, {"1", 1.5}, {"2", 2.0}}, 0.5)) {
    EXPECT_EQ(chosen(mdp, found, "2"), "a4");
  }
}

// As costs: V(1) = 1 + V(2) / 2, V(2) = 1 + V(1), so that V(1) = 3, V(2) = 4, V(0) = 4.
TEST(WrongAnswers, TheLeastCostLeavesTheTrap) {
  const Mdp mdp = endless_gain();
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp)) continue;
    SCOPED_TRACE(entry.name);
    SolveSettings settings;
    settings.maximise = false;
    const auto found = solve(mdp, settings, entry.name);
    ASSERT_TRUE(found) << message(found.error());
    EXPECT_EQ(chosen(mdp, *found, "2"), "a3");
    for (const auto& [name, value] : Values{{"0", 4.0}, {"1", 3.0}, {"2", 4.0}}) {
      EXPECT_LE(found->lower[*mdp.find_state(name)], value) << name;
      EXPECT_GE(found->upper[*mdp.find_state(name)], value) << name;
    }
  }
}

// PRISM's test model lec15mdp, the largest probability of reaching 3 or 4: trying "second" until it
// leaves 0 is worth 0.3 / (0.3 + 0.1) = 3/4. Value iteration in fractions stopped at 0.7499992.
TEST(WrongAnswers, ThreeQuartersAreNotNearlyThreeQuarters) {
  MdpBuilder b(1.0);
  b.move("0", "first", "2");
  b.move("0", "second", "0", 0, 0.6).move("0", "second", "1", 0, 0.3);
  b.move("0", "second", "2", 0, 0.1);
  b.move("1", "go", "3", 1, 0.3).move("1", "go", "4", 1, 0.7);
  b.start("0");
  const Mdp mdp = test::built(b);
  for (const Solution& found : expect_all(mdp, {{"0", 0.75}, {"1", 1.0}})) {
    EXPECT_EQ(chosen(mdp, found, "0"), "second");
  }
}

}  // namespace
}  // namespace quoll
