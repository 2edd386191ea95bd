#include "quoll/solve/backward.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../solve/models.hpp"
#include "quoll/base/random.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

/// X = 1 and Z = 2 to the player to move there; Y = max(-1, -2 g); ROOT = max(-g, 1/4 - g Y).
MdpBuilder small_game(double discount) {
  MdpBuilder b(discount);
  b.alternating(true);
  b.move("ROOT", "a", "X").move("ROOT", "b", "Y", 0.25);
  b.move("X", "c", "END", 1).move("X", "d", "END", 0);
  b.move("Y", "e", "END", -1).move("Y", "f", "Z", 0);
  b.move("Z", "g", "END", 2);
  b.start("ROOT");
  return b;
}

void expect_exactly(const Mdp& mdp, const Solution& found, const char* name, double value) {
  const State s = *mdp.find_state(name);
  EXPECT_EQ(found.lower[s], value) << name;
  EXPECT_EQ(found.upper[s], value) << name;
}

TEST(Backward, ValuesAreThePlayersToMove) {
  const Mdp mdp = test::built(small_game(1.0));
  const auto found = solve(mdp);
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_EQ(found->method, "backward-induction");
  EXPECT_TRUE(found->exact && found->converged);
  expect_exactly(mdp, *found, "X", 1);
  expect_exactly(mdp, *found, "Z", 2);
  expect_exactly(mdp, *found, "Y", -1);
  expect_exactly(mdp, *found, "ROOT", 1.25);
  EXPECT_EQ(found->policy[*mdp.find_state("ROOT")], 1u);
  EXPECT_EQ(found->policy[*mdp.find_state("END")], no_action);
  const auto half = solve(test::built(small_game(0.5)));
  ASSERT_TRUE(half);
  expect_exactly(mdp, *half, "Y", -1);
  expect_exactly(mdp, *half, "ROOT", 0.75);
}

TEST(Backward, LeastCostIsTheMirroredGame) {
  // Each player wants the least: X = 0, Z = 2, Y = min(-1, -2) = -2, ROOT = min(-0, 1/4 + 2) = 0.
  const Mdp mdp = test::built(small_game(1.0));
  SolveSettings settings;
  settings.maximise = false;
  const auto found = solve(mdp, settings);
  ASSERT_TRUE(found);
  expect_exactly(mdp, *found, "X", 0);
  expect_exactly(mdp, *found, "Y", -2);
  expect_exactly(mdp, *found, "ROOT", 0);
}

TEST(Backward, ChanceBeforeTheOtherPlayer) {
  MdpBuilder b = small_game(1.0);
  b.move("ROOT", "coin", "X", 8, 0.5).move("ROOT", "coin", "Z", 0, 0.5);  // 4 - (1 + 2) / 2
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  expect_exactly(mdp, *found, "ROOT", 2.5);
}

TEST(Backward, MethodsOfOnePlayerRefuse) {
  const Mdp mdp = test::built(small_game(0.5));
  for (const char* method : {"value-iteration", "policy-iteration", "label-setting"}) {
    const auto found = solve(mdp, {}, method);
    ASSERT_FALSE(found) << method;
    EXPECT_NE(message(found.error()).find("two players move in turn"), std::string::npos);
  }
}

TEST(Backward, AStateThatComesAgainIsRefusedByName) {
  MdpBuilder b = small_game(1.0);
  b.move("Y", "back", "ROOT");
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp);
  ASSERT_FALSE(found);
  EXPECT_NE(message(found.error()).find("ROOT can"), std::string::npos) << message(found.error());
  const auto one_player = solve(test::adventure(), {}, "backward-induction");
  EXPECT_FALSE(one_player);
}

// A random game: every move leads to states of higher number, the last state is the end.
Mdp random_game(std::uint64_t seed, double discount, bool alternating) {
  Rng rng = stream(seed, "test");
  MdpBuilder b(discount);
  b.alternating(alternating);
  constexpr std::uint32_t states = 9;
  for (std::uint32_t s = 0; s < states; ++s) b.state("s" + std::to_string(s));
  for (State s = 0; s + 1 < states; ++s) {
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t action = b.action("a" + std::to_string(a));
      const State first = s + 1 + rng.below(states - s - 1);
      const State second = s + 1 + rng.below(states - s - 1);
      const double reward = 0.1 * (static_cast<double>(rng.below(21)) - 10.0);
      b.move(s, action, first, reward, 0.25);
      b.move(s, action, second, -0.3, 0.75);
    }
  }
  return test::built(b);
}

long double truth(const Mdp& mdp, State s) {
  long double best = mdp.terminal(s) ? 0.0L : -1e9L;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    long double q = 0.0L;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      const long double sign = mdp.alternating() ? -1.0L : 1.0L;
      q +=
          mdp.probability(o) * (mdp.reward(c, o) + sign * mdp.discount() * truth(mdp, mdp.next(o)));
    }
    best = std::max(best, q);
  }
  return best;
}

TEST(Backward, RandomGamesAgainstPlainRecursion) {
  for (const bool alternating : {false, true}) {
    for (const double discount : {0.7, 1.0}) {
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const Mdp mdp = random_game(seed, discount, alternating);
        const auto found = solve(mdp, {}, "backward-induction");
        ASSERT_TRUE(found) << message(found.error());
        for (State s = 0; s < mdp.states(); ++s) {
          EXPECT_LE(found->lower[s], truth(mdp, s) + 1e-17L);
          EXPECT_GE(found->upper[s], truth(mdp, s) - 1e-17L);
          EXPECT_LE(found->upper[s] - found->lower[s], 1e-13);
        }
        const auto verdict = verify(mdp, found->lower, found->upper, found->policy, discount);
        ASSERT_TRUE(verdict);
        EXPECT_TRUE(verdict->accepted) << verdict->reason;
      }
    }
  }
}

TEST(Backward, TheVerifierSeesEachWrongBound) {
  const Mdp mdp = test::built(small_game(1.0));
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  ASSERT_TRUE(verify(mdp, found->lower, found->upper, found->policy, 1.0)->accepted);
  for (State s = 0; s < mdp.states(); ++s) {
    Solution wrong = *found;
    wrong.lower[s] += 0.5;
    wrong.upper[s] += 0.5;
    EXPECT_FALSE(verify(mdp, wrong.lower, wrong.upper, wrong.policy, 1.0)->accepted) << s;
    wrong.lower[s] -= 1.0;
    wrong.upper[s] -= 1.0;
    EXPECT_FALSE(verify(mdp, wrong.lower, wrong.upper, wrong.policy, 1.0)->accepted) << s;
  }
  MdpBuilder again(1.0);
  again.alternating(true);
  again.move("A", "on", "B").move("B", "on", "A").move("B", "out", "END");
  const std::vector<double> zero(3, 0.0);
  const auto verdict =
      verify(test::built(again), zero, zero, std::vector<Action>{0, 0, no_action}, 1.0);
  ASSERT_TRUE(verdict);
  EXPECT_FALSE(verdict->accepted);
}

TEST(Backward, APolicyIsJudgedAgainstBestReplies) {
  const Mdp mdp = test::built(small_game(1.0));
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const auto judged = [&](Action root, Action x, Action y) {
    std::vector<Action> policy(mdp.states(), no_action);
    policy[*mdp.find_state("ROOT")] = root;
    policy[*mdp.find_state("X")] = x;
    policy[*mdp.find_state("Y")] = y;
    policy[*mdp.find_state("Z")] = 0;
    return judge(mdp, *exact, policy, mdp.start(), 1.0);
  };
  const Optimality best = judged(1, 0, 0);
  EXPECT_EQ(best.optimal, true) << best.proof;
  EXPECT_EQ(best.regret, 0.0);
  // Y by f is worth -2 instead of -1; ROOT by a -1 instead of 1.25, whoever errs in X later: the
  // other player is not to be relied on.
  const Optimality at_y = judged(1, 0, 1);
  EXPECT_EQ(at_y.optimal, false);
  EXPECT_EQ(at_y.regret, 1.0);
  EXPECT_EQ(mdp.state_name(at_y.worst), "Y");
  const Optimality at_root = judged(0, 1, 0);
  EXPECT_EQ(at_root.regret, 2.25);
  EXPECT_EQ(mdp.state_name(at_root.worst), "ROOT");
  EXPECT_EQ(judged(no_action, 0, 0).optimal, false);
}

TEST(Backward, EvaluationLetsThePolicyPlayBoth) {
  const Mdp mdp = test::built(small_game(1.0));
  std::vector<Action> policy(mdp.states(), no_action);
  policy[*mdp.find_state("ROOT")] = 0;
  policy[*mdp.find_state("X")] = 1;
  policy[*mdp.find_state("Z")] = 0;
  const auto value = evaluate(mdp, policy, 1.0);
  ASSERT_TRUE(value);
  EXPECT_EQ(value->lower[*mdp.find_state("ROOT")], 0.0);  // - 0: X errs
  EXPECT_EQ(value->upper[*mdp.find_state("ROOT")], 0.0);
  EXPECT_EQ(value->lower[*mdp.find_state("Y")], -2.0);  // no action known: -1 or -2
  EXPECT_EQ(value->upper[*mdp.find_state("Y")], -1.0);
  // Uniform: X = 1/2, Y = -3/2, ROOT = (-1/2 + 7/4) / 2.
  const auto uniform = evaluate(mdp, uniform_policy(mdp), 1.0);
  ASSERT_TRUE(uniform);
  EXPECT_EQ(uniform->lower[*mdp.find_state("ROOT")], 0.625);
  EXPECT_EQ(uniform->upper[*mdp.find_state("ROOT")], 0.625);
}

TEST(Backward, AllOptimalActionsAreFound) {
  const Mdp mdp = test::built(small_game(0.5));
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  const State y = *mdp.find_state("Y");  // -1 at once, or 0 - 2 / 2
  EXPECT_EQ(optimal_actions(mdp, *found, y), (std::vector<Action>{0, 1}));
  EXPECT_EQ(q_star(mdp, found->lower, mdp.choice_begin(y) + 1, 0.5), -1.0);
}

}  // namespace
}  // namespace quoll
