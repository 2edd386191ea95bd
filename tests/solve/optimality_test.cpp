#include "quoll/solve/optimality.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "models.hpp"
#include "quoll/base/random.hpp"
#include "quoll/model/grid.hpp"
#include "quoll/model/maze.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

Mdp maze(std::uint64_t size, double braid, double move_reward, double goal_reward) {
  MazeSettings settings;
  settings.size = size;
  settings.braid = braid;
  Grid grid = make_maze(settings);
  grid.move_reward = move_reward;
  if (goal_reward != 0.0) grid.reward['G'] = goal_reward;
  Result<Mdp> mdp = to_mdp(grid);
  return std::move(*mdp);
}

std::vector<Action> first_actions(const Mdp& mdp) {
  std::vector<Action> policy(mdp.states(), 0);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) policy[s] = no_action;
  }
  return policy;
}

TEST(Optimality, AZeroTableInALargeMazeIsNotOptimal) {
  for (const double goal : {0.0, 1.0}) {
    const Mdp mdp = maze(500, 0.5, goal > 0.0 ? 0.0 : -1.0, goal);
    SolveSettings settings;
    settings.discount = 0.99;
    const auto exact = solve(mdp, settings);
    ASSERT_TRUE(exact) << message(exact.error());
    if (goal > 0.0) {
      EXPECT_LT(exact->upper[mdp.start()[0]], 1e-3);
      EXPECT_GT(exact->lower[mdp.start()[0]], 0.0);
    }
    const Optimality bad = judge(mdp, *exact, first_actions(mdp), mdp.start(), 0.99);
    EXPECT_EQ(bad.optimal, std::optional(false)) << bad.proof;
    EXPECT_GT(bad.regret, 0.5);
    const Optimality good = judge(mdp, *exact, exact->policy, mdp.start(), 0.99);
    EXPECT_EQ(good.optimal, std::optional(true)) << good.proof;
    EXPECT_EQ(good.regret_estimate, 0.0);
    EXPECT_LT(good.regret, 1e-10);
  }
}

TEST(Optimality, OneWrongMoveFarFromTheGoalIsFound) {
  const Mdp mdp = maze(101, 0.0, 0.0, 1.0);
  SolveSettings settings;
  settings.discount = 0.99;
  const auto exact = solve(mdp, settings);
  ASSERT_TRUE(exact);
  const State start = mdp.start()[0];
  std::vector<Action> policy = exact->policy;
  policy[start] = policy[start] == 0 ? 1 : 0;
  const Optimality judged = judge(mdp, *exact, policy, mdp.start(), 0.99);
  EXPECT_EQ(judged.optimal, std::optional(false)) << judged.proof;
  EXPECT_EQ(judged.worst, start);
}

TEST(Optimality, TiesAreOptimalAndLossesAreMeasured) {
  const Mdp mdp = test::adventure();
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  std::vector<Action> policy = exact->policy;
  policy[*mdp.find_state("POOL")] = no_action;
  const Optimality judged = judge(mdp, *exact, policy, mdp.start(), 0.8);
  EXPECT_EQ(judged.optimal, std::optional(false)) << judged.proof;
  policy = exact->policy;
  policy[*mdp.find_state("POOL")] = 3;  // To-WELL: as good
  EXPECT_EQ(judge(mdp, *exact, policy, mdp.start(), 0.8).optimal, std::optional(true));
  policy[*mdp.find_state("POOL")] = 2;  // To-HALL, then To-CAVE: 64 instead of 80
  const Optimality worse = judge(mdp, *exact, policy, mdp.start(), 0.8);
  EXPECT_EQ(worse.optimal, std::optional(false));
  EXPECT_NEAR(worse.regret, 16.0, 1e-9);  // at POOL; at GATE 64 - 51.2
  EXPECT_EQ(worse.worst, *mdp.find_state("POOL"));
  EXPECT_EQ(worse.unreachable, 0u);
}

TEST(Optimality, AsksOnlyWhereOneCanComeTo) {
  // From A one comes to B and the end; what is done in C does not matter.
  MdpBuilder b(1.0);
  b.move("A", "go", "B", -1).move("B", "go", "END", -1).move("B", "back", "A", -1);
  b.move("C", "stay", "C", -1).move("C", "go", "A", -1).start("A");
  const Mdp mdp = test::built(b);
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const std::vector<Action> policy{0, 0, no_action, 0};
  ASSERT_EQ(*mdp.find_state("C"), 3u);
  const Optimality judged = judge(mdp, *exact, policy, mdp.start(), 1.0);
  EXPECT_EQ(judged.optimal, std::optional(true)) << judged.proof;
  EXPECT_EQ(judged.unreachable, 1u);
  const std::vector<State> all{0, 1, 3};
  EXPECT_EQ(judge(mdp, *exact, policy, all, 1.0).optimal, std::optional(false));
}

TEST(Optimality, StochasticModelsAreDecidedByTightBounds) {
  for (const double discount : {0.9, 0.99}) {
    const Mdp mdp = test::random_model(5, 7, discount);
    const auto exact = solve(mdp);  // width 1e-6, far above 1e-9
    ASSERT_TRUE(exact);
    const Optimality judged = judge(mdp, *exact, exact->policy, mdp.start(), discount);
    EXPECT_EQ(judged.optimal, std::optional(true)) << judged.proof;
  }
  const Mdp mdp = test::two_states();
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const Optimality judged = judge(mdp, *exact, std::vector<Action>{0, 0}, mdp.start(), 0.5);
  EXPECT_EQ(judged.optimal, std::optional(false));
  EXPECT_NEAR(judged.regret, 1.0 / 3, 1e-5);  // 1 - 2/3
  EXPECT_EQ(judged.worst, 0u);
}

TEST(Optimality, NeverEndingAtDiscountOneIsNotOptimal) {
  const Mdp mdp = maze(21, 0.5, -1.0, 0.0);
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  EXPECT_EQ(judge(mdp, *exact, first_actions(mdp), mdp.start(), 1.0).optimal, std::optional(false));
  const Optimality good = judge(mdp, *exact, exact->policy, mdp.start(), 1.0);
  EXPECT_EQ(good.optimal, std::optional(true));
  EXPECT_EQ(good.regret, 0.0);
}

// It ends, but after about 9^40 moves: no double holds a bound on what it loses.
TEST(Optimality, HardlyEverEndingIsNotOptimal) {
  MdpBuilder b(1.0);
  for (int k = 0; k < 40; ++k) {
    const std::string here = std::to_string(k), on = std::to_string(k + 1);
    b.move(here, "down", std::to_string(std::max(k - 1, 0)), -1, 0.9);
    b.move(here, "down", on, -1, 0.1).move(here, "up", on, -1);
  }
  b.start("0");
  const Mdp mdp = test::built(b);
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const Optimality judged = judge(mdp, *exact, first_actions(mdp), mdp.start(), 1.0);
  EXPECT_EQ(judged.optimal, std::optional(false)) << judged.proof;
  EXPECT_EQ(judge(mdp, *exact, exact->policy, mdp.start(), 1.0).optimal, std::optional(true));
}

TEST(Optimality, DecidesDeterministicModelsWhoeverSolvedThem) {
  // A by B: 1 + 0.8 * 100 = 81, by C: 2 + 0.8 * 90 = 74. Bounds 30 wide cannot tell 7 from none.
  MdpBuilder b(0.8);
  b.move("A", "by-B", "B", 1).move("A", "by-C", "C", 2);
  b.move("B", "go", "END", 100).move("C", "go", "END", 90);
  const Mdp mdp = test::built(b);
  Result<Solution> exact = solve(mdp, {}, "value-iteration");
  ASSERT_TRUE(exact);
  std::vector<Action> policy = exact->policy;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    exact->lower[s] -= 15.0;
    exact->upper[s] += 15.0;
  }
  const Optimality good = judge(mdp, *exact, policy, mdp.start(), 0.8);
  EXPECT_EQ(good.optimal, std::optional(true)) << good.proof;
  EXPECT_LT(good.regret, 1e-10);
  policy[*mdp.find_state("A")] = 1;
  const Optimality bad = judge(mdp, *exact, policy, mdp.start(), 0.8);
  EXPECT_EQ(bad.optimal, std::optional(false)) << bad.proof;
  EXPECT_NEAR(bad.regret, 7.0, 1e-9);
}

TEST(Optimality, QStarOfTheLecture) {
  // Q*(s, a) = r + 0.8 V*(next), with V* = 64, 80, 80, 100, 100, 0.
  const Mdp mdp = test::adventure();
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const auto q = [&](const char* s, Action a) {
    return q_star(mdp, exact->lower, mdp.choice_begin(*mdp.find_state(s)) + a, 0.8);
  };
  EXPECT_NEAR(q("GATE", 0), 64, 1e-12);
  EXPECT_NEAR(q("HALL", 0), 80, 1e-12);
  EXPECT_NEAR(q("HALL", 1), 64, 1e-12);
  EXPECT_NEAR(q("POOL", 0), 80, 1e-12);
  EXPECT_NEAR(q("POOL", 1), 51.2, 1e-12);
  EXPECT_NEAR(q("POOL", 2), 64, 1e-12);
  EXPECT_NEAR(q("POOL", 3), 80, 1e-12);
  EXPECT_NEAR(q("CAVE", 0), 100, 1e-12);
  EXPECT_NEAR(q("CAVE", 1), 64, 1e-12);
  EXPECT_NEAR(q("CAVE", 2), 64, 1e-12);
  EXPECT_NEAR(q("WELL", 0), 100, 1e-12);
  EXPECT_NEAR(q("WELL", 1), 64, 1e-12);
  EXPECT_EQ(optimal_actions(mdp, *exact, *mdp.find_state("POOL")), (std::vector<Action>{0, 3}));
  EXPECT_EQ(optimal_actions(mdp, *exact, *mdp.find_state("HALL")), (std::vector<Action>{0}));
  EXPECT_TRUE(optimal_actions(mdp, *exact, *mdp.find_state("GOAL")).empty());
}

TEST(Optimality, BetterThanAllOthersIsOptimalWhereTheValueIsZero) {
  // V*(A) = 0.1 V*(B) / 2 - 0.1 V*(B) / 2 = 0: no loss is below 1e-9 of it, but "stop" earns -1.
  MdpBuilder b(0.9);
  b.move("A", "bet", "WON", 0.1, 0.5).move("A", "bet", "LOST", -0.1, 0.5);
  b.move("A", "stop", "END", -1);
  b.move("WON", "back", "A", 0.3, 0.5).move("WON", "back", "A2", -0.3, 0.5);
  b.move("LOST", "out", "END", 0).move("A2", "out", "END", 0);
  const Mdp mdp = test::built(b);
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const std::vector<State> from{*mdp.find_state("A")};
  const Optimality good = judge(mdp, *exact, std::vector<Action>(mdp.states(), 0), from, 0.9);
  EXPECT_EQ(good.optimal, std::optional<bool>(true)) << good.proof;
  std::vector<Action> stop(mdp.states(), 0);
  stop[from[0]] = 1;
  EXPECT_EQ(judge(mdp, *exact, stop, from, 0.9).optimal, std::optional<bool>(false));
}

TEST(Optimality, CirclesForNothingAreNotOptimalMoves) {
  // From A: a loop, a way over B and back, and the way out; B leads on to the end as well as back.
  MdpBuilder b(1.0);
  b.move("A", "loop", "A", 0).move("A", "over", "B", 0).move("A", "go", "END", 5);
  b.move("B", "back", "A", 0).move("B", "go", "END", 5);
  b.move("C", "back", "D", 0).move("D", "back", "C", 0).move("D", "go", "END", 5);
  const Mdp mdp = test::built(b);
  const auto exact = solve(mdp);
  ASSERT_TRUE(exact);
  const auto best = [&](const char* s) { return optimal_actions(mdp, *exact, *mdp.find_state(s)); };
  EXPECT_EQ(best("A"), (std::vector<Action>{1, 2}));
  EXPECT_EQ(best("B"), (std::vector<Action>{0, 1}));
  EXPECT_EQ(best("C"), (std::vector<Action>{0}));
  EXPECT_EQ(best("D"), (std::vector<Action>{1}));
}

// Whether the end can be reached from `at` without passing `avoided`.
bool gets_out(const std::vector<std::vector<std::uint32_t>>& moves, std::uint32_t at,
              std::uint32_t avoided, std::vector<bool>& seen) {
  if (at == moves.size()) return true;
  if (at == avoided || seen[at]) return false;
  seen[at] = true;
  return std::any_of(moves[at].begin(), moves[at].end(),
                     [&](std::uint32_t next) { return gets_out(moves, next, avoided, seen); });
}

TEST(Optimality, AMoveIsOptimalWhenTheEndCanBeReachedWithoutComingBack) {
  // All states are worth 5: every move ties, and those that have to come back only circle.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    constexpr std::uint32_t states = 14;
    Rng dice = stream(seed, "test");
    std::vector<std::vector<std::uint32_t>> moves(states);
    MdpBuilder b(1.0);
    for (std::uint32_t s = 0; s < states; ++s) b.state("s" + std::to_string(s));
    for (std::uint32_t s = 0; s < states; ++s) {
      moves[s] = {dice.below(states), dice.below(std::min(states, s + 3)), s == 0 ? states : s - 1};
      for (std::uint32_t a = 0; a < moves[s].size(); ++a) {
        const std::uint32_t next = moves[s][a];
        b.move("s" + std::to_string(s), "a" + std::to_string(a),
               next == states ? "END" : "s" + std::to_string(next), next == states ? 5.0 : 0.0);
      }
    }
    const Mdp mdp = test::built(b);
    const auto exact = solve(mdp);
    ASSERT_TRUE(exact);
    const TiedActions tied(mdp, *exact);
    for (std::uint32_t s = 0; s < states; ++s) {
      std::vector<Action> expected;
      for (Action a = 0; a < moves[s].size(); ++a) {
        std::vector<bool> seen(states, false);
        if (gets_out(moves, moves[s][a], s, seen)) expected.push_back(a);
      }
      EXPECT_EQ(tied.of(s), expected) << "seed " << seed << " state " << s;
    }
  }
}

}  // namespace
}  // namespace quoll
