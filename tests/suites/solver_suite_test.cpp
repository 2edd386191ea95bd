// Properties of every solver of the registry: the true value lies inside the interval, the policy
// earns what was promised, the independent checker agrees, threads do not change a bit.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "../solve/models.hpp"
#include "quoll/model/grid.hpp"
#include "quoll/model/maze.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

using Row = std::vector<long double>;

// Value of one policy by dense Gaussian elimination of (I - g P) V = r with pivoting; empty if
// singular, which at discount 1 means that the policy does not end.
Row dense_value(const Mdp& mdp, const std::vector<Action>& policy, long double discount) {
  const std::size_t n = mdp.states();
  std::vector<Row> a(n, Row(n + 1, 0.0L));
  for (State s = 0; s < n; ++s) {
    a[s][s] = 1.0L;
    if (mdp.terminal(s)) continue;
    const std::uint64_t c = mdp.choice_begin(s) + policy[s];
    a[s][n] = mdp.reward(c);
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      a[s][mdp.next(o)] -= discount * mdp.probability(o);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i) {
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    }
    if (std::fabs(a[pivot][k]) < 1e-12L) return {};
    std::swap(a[k], a[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || a[i][k] == 0.0L) continue;
      const long double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  Row value(n);
  for (std::size_t k = 0; k < n; ++k) value[k] = a[k][n] / a[k][k];
  return value;
}

// The best value over all policies, tried one by one.
Row best_value(const Mdp& mdp, long double discount) {
  std::vector<Action> policy(mdp.states(), 0);
  Row best;
  for (;;) {
    const Row value = dense_value(mdp, policy, discount);
    if (best.empty()) best = value;
    for (std::size_t s = 0; s < value.size(); ++s) best[s] = std::max(best[s], value[s]);
    State s = 0;
    for (; s < mdp.states(); ++s) {
      if (mdp.actions(s) == 0) continue;
      if (++policy[s] < mdp.actions(s)) break;
      policy[s] = 0;
    }
    if (s == mdp.states()) return best;
  }
}

// The interval holds the truth, is as narrow as promised, and the policy earns the lower bound.
void expect_true_bounds(const Mdp& mdp, const Solution& found, const Row& truth) {
  EXPECT_TRUE(found.converged);
  const Row earned = dense_value(mdp, found.policy, found.discount);
  ASSERT_FALSE(earned.empty());
  for (State s = 0; s < mdp.states(); ++s) {
    const long double doubt = 1e-14L * (1.0L + std::fabs(truth[s])) / 1e3L;  // of the elimination
    EXPECT_LE(found.lower[s], truth[s] + doubt) << mdp.state_name(s);
    EXPECT_GE(found.upper[s], truth[s] - doubt) << mdp.state_name(s);
    EXPECT_LE(found.lower[s], earned[s] + doubt) << mdp.state_name(s);
    EXPECT_LE(found.upper[s] - found.lower[s], 1e-6) << mdp.state_name(s);
  }
  const auto verdict = verify(mdp, found.lower, found.upper, found.policy, found.discount);
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->accepted) << verdict->reason;
}

using test::can_do;

TEST(SolverSuite, RandomModelsAgainstAllPolicies) {
  for (const double discount : {0.5, 0.9, 0.99, 0.999}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const Mdp mdp = test::random_model(seed, 4 + seed % 4, discount);
      const Row truth = best_value(mdp, discount);
      for (const SolverEntry& entry : solvers()) {
        if (!can_do(entry, mdp)) continue;
        SCOPED_TRACE(std::string(entry.name) + " seed " + std::to_string(seed) + " discount " +
                     std::to_string(discount));
        const auto found = solve(mdp, {}, entry.name);
        ASSERT_TRUE(found) << message(found.error());
        expect_true_bounds(mdp, *found, truth);
      }
    }
  }
}

TEST(SolverSuite, RandomModelsWithoutDiscount) {
  unsigned solved = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Mdp mdp = test::random_model(seed, 4 + seed % 4, 1.0);
    for (const SolverEntry& entry : solvers()) {
      if (!can_do(entry, mdp)) continue;
      SCOPED_TRACE(std::string(entry.name) + " seed " + std::to_string(seed));
      const auto found = solve(mdp, {}, entry.name);
      if (!found) continue;  // no way to an end, or a gain for ever
      if (found->lower[0] == -std::numeric_limits<double>::infinity() && !found->converged) {
        ADD_FAILURE() << "not certified";
        continue;
      }
      expect_true_bounds(mdp, *found, best_value(mdp, 1.0L));
      ++solved;
    }
  }
  EXPECT_GE(solved, 100u);
}

TEST(SolverSuite, RationalAnswers) {
  for (const SolverEntry& entry : solvers()) {
    SCOPED_TRACE(entry.name);
    const auto expect = [&](const Mdp& mdp, std::vector<double> values) {
      if (!can_do(entry, mdp)) return;
      const auto found = solve(mdp, {}, entry.name);
      ASSERT_TRUE(found) << message(found.error());
      expect_true_bounds(mdp, *found, Row(values.begin(), values.end()));
    };
    const Mdp gambler = test::gambler();
    std::vector<double> by_state(gambler.states(), 0.0);
    by_state[*gambler.find_state("1")] = 1.0 / 16;
    by_state[*gambler.find_state("2")] = 1.0 / 4;
    by_state[*gambler.find_state("3")] = 7.0 / 16;
    expect(gambler, by_state);
    expect(test::two_states(), {1.0, 2.0});
    const Mdp circle = test::free_circle();
    by_state.assign(circle.states(), -5.0);
    by_state[*circle.find_state("A")] = -2.0;
    by_state[*circle.find_state("END")] = 0.0;
    expect(circle, by_state);
    expect(test::there_and_back(), {12.0, 6.0, 14.0, 13.0, 0.0});
  }
}

TEST(SolverSuite, ThreadsDoNotChangeABit) {
  MazeSettings shape;
  shape.size = 131;  // about 9,000 states: several parts of a sweep
  Grid grid = make_maze(shape);
  grid.slip = 0.2;
  grid.discount = 0.95;
  const Result<Mdp> mdp = to_mdp(grid);
  ASSERT_TRUE(mdp);
  for (const SolverEntry& entry : solvers()) {
    if (!can_do(entry, *mdp)) continue;
    SolveSettings one, three;
    one.width = three.width = 1e-3;
    three.threads = 3;
    const auto first = solve(*mdp, one, entry.name);
    const auto second = solve(*mdp, three, entry.name);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(0, std::memcmp(first->lower.data(), second->lower.data(), 8 * mdp->states()));
    EXPECT_EQ(0, std::memcmp(first->upper.data(), second->upper.data(), 8 * mdp->states()));
    EXPECT_EQ(first->policy, second->policy);
    EXPECT_EQ(first->sweeps, second->sweeps);
  }
}

// Steps to the goal, cell by cell on the drawing.
std::vector<int> steps_on_paper(const Grid& grid) {
  const int height = static_cast<int>(grid.rows.size());
  const int width = static_cast<int>(grid.rows[0].size());
  std::vector<int> steps(static_cast<std::size_t>(height) * width, -1);
  std::deque<int> queue;
  for (int i = 0; i < height * width; ++i) {
    if (grid.rows[i / width][i % width] != 'G') continue;
    steps[i] = 0;
    queue.push_back(i);
  }
  for (; !queue.empty(); queue.pop_front()) {
    const int row = queue.front() / width;
    const int column = queue.front() % width;
    for (const auto& [down, right] : {std::pair{0, 1}, {1, 0}, {0, -1}, {-1, 0}}) {
      const int r = row + down;
      const int c = column + right;
      if (r < 0 || c < 0 || r >= height || c >= width || grid.rows[r][c] == '#') continue;
      if (steps[r * width + c] >= 0) continue;
      steps[r * width + c] = steps[row * width + column] + 1;
      queue.push_back(r * width + c);
    }
  }
  return steps;
}

TEST(SolverSuite, MazesAreShortestPaths) {
  for (const double braid : {0.0, 0.5, 1.0}) {
    MazeSettings shape;
    shape.size = 61;
    shape.braid = braid;
    const Grid grid = make_maze(shape);
    const Result<Mdp> mdp = to_mdp(grid);
    ASSERT_TRUE(mdp);
    const std::vector<int> steps = steps_on_paper(grid);
    for (const SolverEntry& entry : solvers()) {
      if (!can_do(entry, *mdp)) continue;
      SCOPED_TRACE(entry.name);
      const auto found = solve(*mdp, {}, entry.name);
      ASSERT_TRUE(found) << message(found.error());
      EXPECT_TRUE(found->exact);
      for (State s = 0; s < mdp->states(); ++s) {
        ASSERT_EQ(found->lower[s], -steps[mdp->layout()->cell[s]]) << mdp->state_name(s);
        ASSERT_EQ(found->upper[s], found->lower[s]);
      }
      const auto verdict = verify(*mdp, found->lower, found->upper, found->policy, 1.0);
      EXPECT_TRUE(verdict && verdict->accepted);
    }
  }
}

TEST(SolverSuite, LeastCostIsTheMirroredProblem) {
  // As costs, the lecture's rewards are best avoided: going round in circles is free.
  for (const SolverEntry& entry : solvers()) {
    if (!can_do(entry, test::adventure())) continue;
    SolveSettings settings;
    settings.maximise = false;
    const auto found = solve(test::adventure(), settings, entry.name);
    ASSERT_TRUE(found);
    for (std::size_t s = 0; s < found->lower.size(); ++s) {
      EXPECT_LE(found->lower[s], 0.0);
      EXPECT_GE(found->upper[s], 0.0);
      EXPECT_LE(found->upper[s] - found->lower[s], 1e-6);
    }
  }
}

TEST(SolverSuite, ASolveStoppedAtOnceIsNoWiderThanTheRewardsAllow) {
  // Rewards of -1 at discount 0.99: between -100 and 0, whatever the method has done.
  Grid grid = make_maze({});
  grid.slip = 0.2;
  grid.discount = 0.99;
  const Result<Mdp> mdp = to_mdp(grid);
  ASSERT_TRUE(mdp);
  for (const SolverEntry& entry : solvers()) {
    if (!entry.needs_discount && entry.name != "value-iteration") continue;
    if (entry.name == "game-iteration") continue;  // rewards of a game count with both signs
    SCOPED_TRACE(entry.name);
    SolveSettings settings;
    settings.keep_going = [](const SolveProgress&) { return false; };
    const auto found = solve(*mdp, settings, entry.name);
    ASSERT_TRUE(found) << message(found.error());
    EXPECT_FALSE(found->converged);
    for (State s = 0; s < mdp->states(); ++s) {
      ASSERT_GE(found->lower[s], -100.0000001);
      ASSERT_LE(found->upper[s], 0.0);
    }
    const auto verdict = verify(*mdp, found->lower, found->upper, found->policy, 0.99);
    ASSERT_TRUE(verdict);
    EXPECT_TRUE(verdict->accepted) << verdict->reason;
  }
}

TEST(SolverSuite, AStoppedSolveStillHoldsTheTruth) {
  for (const SolverEntry& entry : solvers()) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Mdp mdp = test::random_model(seed, 6, 0.999);
      if (!can_do(entry, mdp)) continue;
      SolveSettings settings;
      int calls = 0;
      settings.keep_going = [&calls](const SolveProgress&) { return ++calls < 4; };
      const auto found = solve(mdp, settings, entry.name);
      ASSERT_TRUE(found);
      const Row truth = best_value(mdp, 0.999L);
      for (State s = 0; s < mdp.states(); ++s) {
        EXPECT_LE(found->lower[s], truth[s] + 1e-12L);
        EXPECT_GE(found->upper[s], truth[s] - 1e-12L);
      }
    }
  }
}

}  // namespace
}  // namespace quoll
