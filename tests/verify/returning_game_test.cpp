// Games of two below discount 1 in which a state may come again.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../solve/models.hpp"
#include "quoll/base/random.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

// Whoever is in A takes 1/4 or goes on to B; whoever is in B wins 1 or goes back to A. At discount
// 1/2: V(B) = 1, V(A) = max(1/4, -1/2).
Mdp to_and_fro() {
  MdpBuilder b(0.5);
  b.alternating(true);
  b.move("A", "on", "B").move("A", "take", "END", 0.25);
  b.move("B", "back", "A").move("B", "win", "END", 1.0);
  b.start("A").start("B");
  return test::built(b);
}

TEST(ReturningGame, IsSolvedAndVerified) {
  const Mdp mdp = to_and_fro();
  const auto found = solve(mdp);
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_EQ(found->method, "game-iteration");
  const State a = *mdp.find_state("A"), b = *mdp.find_state("B");
  EXPECT_LE(found->lower[a], 0.25);
  EXPECT_GE(found->upper[a], 0.25);
  EXPECT_LE(found->lower[b], 1.0);
  EXPECT_GE(found->upper[b], 1.0);
  EXPECT_TRUE(found->converged);
  EXPECT_EQ(found->policy[a], 1u);
  EXPECT_EQ(found->policy[b], 1u);
  EXPECT_TRUE(verify(mdp, found->lower, found->upper, found->policy, 0.5)->accepted);
}

TEST(ReturningGame, ADrawIsExactlyNothing) {
  // As above, but the one in B may only take a draw or lose by going back.
  MdpBuilder b(0.9);
  b.alternating(true);
  b.move("A", "on", "B").move("A", "win", "END", 1.0);
  b.move("B", "back", "A").move("B", "draw", "END", 0.0);
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  const State at = *mdp.find_state("B");
  EXPECT_EQ(found->lower[at], 0.0);
  EXPECT_EQ(found->upper[at], 0.0);
  EXPECT_TRUE(verify(mdp, found->lower, found->upper, found->policy, 0.9)->accepted);
  const Optimality judged = judge(mdp, *found, found->policy, mdp.start(), 0.9);
  EXPECT_EQ(judged.optimal, true) << judged.proof;
}

TEST(ReturningGame, OnePlayerIsNoExceptionForTheMethod) {
  const auto found = solve(test::adventure(), {}, "game-iteration");
  ASSERT_TRUE(found);
  const State gate = *test::adventure().find_state("GATE");
  EXPECT_NEAR(found->lower[gate], 64.0, 1e-6);
  EXPECT_GE(found->upper[gate], 64.0);
}

TEST(ReturningGame, WithoutDiscountingIsRefused) {
  SolveSettings settings;
  settings.discount = 1.0;
  for (const char* method : {"auto", "game-iteration"}) {
    const auto found = solve(to_and_fro(), settings, method);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().file, "--method");
  }
}

TEST(ReturningGame, APolicyIsJudgedAgainstBestReplies) {
  const Mdp mdp = to_and_fro();
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const State a = *mdp.find_state("A"), b = *mdp.find_state("B");
  const auto judged = [&](Action at_a, Action at_b) {
    std::vector<Action> policy(mdp.states(), no_action);
    policy[a] = at_a;
    policy[b] = at_b;
    return judge(mdp, *exact, policy, mdp.start(), 0.5);
  };
  EXPECT_EQ(judged(1, 1).optimal, true) << judged(1, 1).proof;
  EXPECT_LE(judged(1, 1).regret, 1e-5);
  // Going on from A gives the other one 1: -1/2 instead of 1/4.
  EXPECT_EQ(judged(0, 1).optimal, false);
  EXPECT_NEAR(judged(0, 1).regret, 0.75, 1e-6);
  EXPECT_EQ(judged(0, 1).worst, a);
  // Going back from B lets the other one take 1/4: -1/8 instead of 1.
  EXPECT_NEAR(judged(1, 0).regret, 1.125, 1e-6);
  EXPECT_EQ(judged(1, 0).worst, b);
  EXPECT_EQ(judged(no_action, 1).optimal, false);
}

TEST(ReturningGame, EvaluationLetsThePolicyPlayBoth) {
  const Mdp mdp = to_and_fro();
  const State a = *mdp.find_state("A"), b = *mdp.find_state("B");
  std::vector<Action> for_ever(mdp.states(), no_action);
  for_ever[a] = for_ever[b] = 0;
  const auto endless = evaluate(mdp, std::span<const Action>(for_ever), 0.5, 1e-12);
  ASSERT_TRUE(endless) << message(endless.error());
  EXPECT_NEAR(endless->lower[a], 0.0, 1e-12);
  EXPECT_NEAR(endless->upper[b], 0.0, 1e-12);
  // By tossing a coin: V(A) = 1/8 - V(B) / 4, V(B) = 1/2 - V(A) / 4.
  const auto coin = evaluate(mdp, uniform_policy(mdp), 0.5, 1e-12);
  ASSERT_TRUE(coin);
  EXPECT_EQ(coin->lower.size(), mdp.states());
  EXPECT_NEAR(coin->lower[a], 0.0, 1e-11);
  EXPECT_NEAR(coin->upper[b], 0.5, 1e-11);
  EXPECT_TRUE(coin->converged);
}

// Ten states, two actions, each of two outcomes and rewards in [-1, 1].
Mdp random_game(std::uint64_t seed, double discount) {
  Rng rng = stream(seed, "game");
  MdpBuilder b(discount);
  b.alternating(true);
  constexpr std::uint32_t states = 10;
  for (std::uint32_t s = 0; s < states; ++s) {
    for (const char* action : {"a", "b"}) {
      const std::uint32_t first = rng.below(states + 1);
      const std::uint32_t second = (first + 1 + rng.below(states)) % (states + 1);
      const double p = 0.25 + 0.5 * rng.uniform(), reward = 2.0 * rng.uniform() - 1.0;
      b.move("s" + std::to_string(s), action, "s" + std::to_string(first), reward, p);
      b.move("s" + std::to_string(s), action, "s" + std::to_string(second), -reward, 1.0 - p);
    }
  }
  return test::built(b);
}

// The fixed point by plain iteration, of the best or of the mean action.
std::vector<double> iterated(const Mdp& mdp, bool best) {
  std::vector<double> value(mdp.states(), 0.0), next = value;
  for (int sweep = 0; sweep < 600; ++sweep) {
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      double sum = 0.0, most = -1e9;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        double q = 0.0;
        for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          q += mdp.probability(o) * (mdp.reward(c, o) - mdp.discount() * value[mdp.next(o)]);
        }
        sum += q;
        most = std::max(most, q);
      }
      next[s] = best ? most : sum / mdp.actions(s);
    }
    value = next;
  }
  return value;
}

TEST(ReturningGame, RandomGames) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Mdp mdp = random_game(seed, seed % 2 ? 0.9 : 0.5);
    SolveSettings settings;
    settings.width = 1e-9;
    const auto found = solve(mdp, settings, "game-iteration");
    ASSERT_TRUE(found) << message(found.error());
    EXPECT_TRUE(found->converged);
    const std::vector<double> best = iterated(mdp, true), mean = iterated(mdp, false);
    const auto coin = evaluate(mdp, uniform_policy(mdp), mdp.discount(), 1e-9);
    ASSERT_TRUE(coin);
    for (State s = 0; s < mdp.states(); ++s) {
      ASSERT_LE(found->lower[s], best[s] + 1e-14);
      ASSERT_GE(found->upper[s], best[s] - 1e-14);
      ASSERT_LE(coin->lower[s], mean[s] + 1e-14);
      ASSERT_GE(coin->upper[s], mean[s] - 1e-14);
      ASSERT_LE(coin->upper[s] - coin->lower[s], 1e-9);
    }
    const auto verdict = verify(mdp, found->lower, found->upper, found->policy, mdp.discount());
    EXPECT_TRUE(verdict->accepted) << verdict->reason;
    const Optimality judged = judge(mdp, *found, found->policy, mdp.start(), mdp.discount());
    EXPECT_NE(judged.optimal, false) << judged.proof;
    EXPECT_LE(judged.regret, 1e-8);
  }
}

}  // namespace
}  // namespace quoll
