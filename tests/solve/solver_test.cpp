#include "quoll/solve/solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models.hpp"
#include "quoll/model/grid.hpp"
#include "quoll/solve/evaluate.hpp"

namespace quoll {
namespace {

TEST(Solver, FindsTheLecturesValues) {
  const Mdp mdp = test::adventure();
  for (const SolverEntry& entry : solvers()) {
    if (!test::can_do(entry, mdp)) continue;
    const Result<Solution> found = solve(mdp, {}, entry.name);
    ASSERT_TRUE(found) << message(found.error());
    const auto at = [&](const char* name) { return *mdp.find_state(name); };
    const std::pair<const char*, double> expected[] = {{"CAVE", 100}, {"WELL", 100}, {"POOL", 80},
                                                       {"HALL", 80},  {"GATE", 64},  {"GOAL", 0}};
    for (const auto& [name, value] : expected) {
      EXPECT_LE(found->lower[at(name)], value) << entry.name << " " << name;
      EXPECT_GE(found->upper[at(name)], value) << entry.name << " " << name;
      EXPECT_LE(found->upper[at(name)] - found->lower[at(name)], 1e-6) << entry.name;
    }
    EXPECT_EQ(found->policy[at("GOAL")], no_action);
    EXPECT_EQ(found->policy[at("POOL")], 0u);
    EXPECT_TRUE(found->converged);
    EXPECT_EQ(found->method, entry.name);
  }
}

constexpr double inf = std::numeric_limits<double>::infinity();

void expect_value(const Mdp& mdp, const Solution& found, const char* name, double value) {
  const State s = *mdp.find_state(name);
  EXPECT_LE(found.lower[s], value) << name;
  EXPECT_GE(found.upper[s], value) << name;
  if (std::isfinite(value)) {
    EXPECT_LE(found.upper[s] - found.lower[s], 1e-6) << name;
  }
}

// Moves between 12 states and an end. Each state has a height; a move earns what it goes down, less
// a cost of at least 0: no cycle gains. Without heights no move gains unless it ends.
Mdp random_moves(std::uint64_t seed, bool heights, double discount) {
  std::uint64_t x = seed * 2862933555777941757u + 3037000493u;
  const auto draw = [&x](unsigned below) {
    x = x * 6364136223846793005u + 1442695040888963407u;
    return static_cast<unsigned>((x >> 33) % below);
  };
  constexpr unsigned states = 12;
  std::vector<double> height(states + 1, 0.0);
  for (unsigned s = 0; heights && s < states; ++s) height[s] = 0.5 * draw(20);
  MdpBuilder b(discount);
  for (unsigned s = 0; s <= states; ++s) b.state(std::to_string(s));
  for (unsigned s = 0; s < states; ++s) {
    const unsigned actions = 2 + draw(3);
    for (unsigned a = 0; a < actions; ++a) {
      const unsigned to = a == 0 && draw(3) == 0 ? states : draw(states);
      const double bonus = to == states ? draw(10) : 0.0;
      const double cost = 0.25 * draw(12);
      const double reward = height[s] - height[to] - cost + bonus;
      b.move(s, b.action(std::to_string(a)), to, reward, 1.0);
    }
  }
  return test::built(b);
}

// V after k moves at most, for k so large that nothing changes: -infinity = no way to an end.
std::vector<long double> repeated_backups(const Mdp& mdp, long double discount, int times) {
  std::vector<long double> value(mdp.states(), discount < 1.0L ? 0.0L : -inf);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) value[s] = 0.0L;
  }
  for (int k = 0; k < times; ++k) {
    std::vector<long double> next = value;
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      next[s] = -inf;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        next[s] = std::max(next[s], mdp.reward(c) + discount * value[mdp.next(c)]);
      }
    }
    value = next;
  }
  return value;
}

TEST(Solver, LabelSettingWithManyRewards) {
  // Without heights labels are set with a heap, with heights they are corrected by sweeps.
  for (const bool heights : {false, true}) {
    for (const double discount : {0.9, 1.0}) {
      int solved = 0;
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Mdp mdp = random_moves(seed, heights, discount);
        const auto found = solve(mdp, {}, "label-setting");
        if (!found) {
          EXPECT_EQ(discount, 1.0);  // some state has no way to an end
          continue;
        }
        ++solved;
        // 0.9^1000 < 1e-45; without discounting a best way has at most 12 moves.
        const auto truth = repeated_backups(mdp, discount, discount < 1.0 ? 1000 : 12);
        const auto earned = evaluate(mdp, found->policy, discount);
        ASSERT_TRUE(earned);
        EXPECT_TRUE(found->converged);
        for (State s = 0; s < mdp.states(); ++s) {
          EXPECT_LE(found->lower[s], truth[s] + 1e-13L) << mdp.state_name(s);
          EXPECT_GE(found->upper[s], truth[s] - 1e-13L) << mdp.state_name(s);
          EXPECT_LE(found->upper[s] - found->lower[s], 1e-12) << mdp.state_name(s);
          EXPECT_GE(earned->upper[s], found->lower[s]) << mdp.state_name(s);
          if (discount == 1.0) {
            EXPECT_EQ(found->lower[s], static_cast<double>(truth[s]));  // quarters: exact
          }
        }
      }
      EXPECT_GE(solved, 30);
    }
  }
}

TEST(Solver, MinimisesCosts) {
  // From A 5 at once, or 1 to B and 2 from there: 3. From C a move costs 1 and ends half the time:
  // 2, less than going to A for 0 and on for 3.
  MdpBuilder b(1.0);
  b.move("A", "short", "END", 5).move("A", "long", "B", 1);
  b.move("B", "out", "END", 2).move("B", "dear", "END", 9);
  const Mdp moves = test::built(b);
  b.move("C", "swap", "A", 0);
  b.move("C", "try", "C", 1, 0.5).move("C", "try", "END", 1, 0.5);
  const Mdp chances = test::built(b);
  for (const SolverEntry& entry : solvers()) {
    SCOPED_TRACE(entry.name);
    for (const Mdp* mdp : {&moves, &chances}) {
      if (!test::can_do(entry, *mdp)) continue;
      SolveSettings settings;
      settings.maximise = false;
      const auto found = solve(*mdp, settings, entry.name);
      ASSERT_TRUE(found) << message(found.error());
      EXPECT_TRUE(found->converged);
      expect_value(*mdp, *found, "A", 3);
      expect_value(*mdp, *found, "B", 2);
      EXPECT_EQ(found->policy[*mdp->find_state("A")], 1u);
      EXPECT_EQ(found->policy[*mdp->find_state("B")], 0u);
      if (mdp == &moves) continue;
      expect_value(*mdp, *found, "C", 2);
      EXPECT_EQ(found->policy[*mdp->find_state("C")], 1u);
    }
  }
}

// Value of one policy: (I - g P) V = r by elimination with pivoting.
std::vector<long double> eliminated(const Mdp& mdp, unsigned policy, long double discount) {
  const std::size_t n = mdp.states();
  std::vector<std::vector<long double>> a(n, std::vector<long double>(n + 1, 0.0L));
  for (State s = 0; s < n; ++s) {
    const std::uint64_t c = mdp.choice_begin(s) + (policy >> s & 1);
    a[s][s] = 1.0L;
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
    std::swap(a[k], a[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const long double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  std::vector<long double> value(n);
  for (std::size_t k = 0; k < n; ++k) value[k] = a[k][n] / a[k][k];
  return value;
}

TEST(Solver, RiverSwimAgainstElimination) {
  // Strehl and Littman 2008, with the currents of Osband et al. 2013: left always succeeds and
  // earns 0.005 at the first bank; right goes on with 0.35, back with 0.05; 1 at the last bank.
  MdpBuilder b(0.99);
  constexpr int last = 5;
  for (int s = 0; s <= last; ++s) {
    const auto name = [](int k) { return std::to_string(k); };
    b.move(name(s), "left", name(std::max(s - 1, 0)), s == 0 ? 0.005 : 0.0);
    const double reward = s == last ? 1.0 : 0.0;
    if (s == 0) {
      b.move(name(s), "right", name(0), 0.0, 0.4).move(name(s), "right", name(1), 0.0, 0.6);
    } else {
      const double back = s == last ? 0.4 : 0.05;
      b.move(name(s), "right", name(s - 1), reward, back);
      b.move(name(s), "right", name(s), reward, 0.6);
      if (s < last) b.move(name(s), "right", name(s + 1), reward, 0.35);
    }
  }
  const Mdp mdp = test::built(b);
  std::vector<long double> best(mdp.states(), -inf);
  for (unsigned policy = 0; policy < 64; ++policy) {
    const auto value = eliminated(mdp, policy, 0.99L);
    for (State s = 0; s < mdp.states(); ++s) best[s] = std::max(best[s], value[s]);
  }
  for (const char* method : {"value-iteration", "policy-iteration"}) {
    const auto found = solve(mdp, {}, method);
    ASSERT_TRUE(found) << message(found.error());
    EXPECT_TRUE(found->converged);
    for (State s = 0; s < mdp.states(); ++s) {
      EXPECT_LE(found->lower[s], best[s] + 1e-12L) << method << " " << s;
      EXPECT_GE(found->upper[s], best[s] - 1e-12L) << method << " " << s;
      EXPECT_LE(found->upper[s] - found->lower[s], 1e-6) << method;
      EXPECT_EQ(found->policy[s], 1u) << method << " " << s;  // swim on
    }
  }
}

TEST(Solver, NamesAGainOfMixedSigns) {
  Grid grid;
  grid.rows = {"S..#", ".#.P", "..AG"};
  grid.slip = 0.2;
  grid.reward['A'] = 5.0;
  const auto mdp = to_mdp(grid);
  ASSERT_TRUE(mdp) << message(mdp.error());
  for (const char* method : {"value-iteration", "policy-iteration"}) {
    const auto found = solve(*mdp, {}, method);
    ASSERT_FALSE(found);
    EXPECT_NE(message(found.error()).find("no cycle may gain"), std::string::npos);
  }
}

TEST(Solver, StopsWhereValuesGrowForEver) {
  // To and fro gains 1e-13, too little to be told from rounding: nothing can be certified.
  MdpBuilder b(1.0);
  b.move("A", "go", "B", 1).move("A", "out", "END", 0);
  b.move("B", "back", "A", -1 + 1e-13);
  b.move("B", "coin", "A", -3, 0.5).move("B", "coin", "END", -3, 0.5);
  const Mdp mdp = test::built(b);
  const auto found = solve(mdp);
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_FALSE(found->converged);
  EXPECT_FALSE(found->exact);
  EXPECT_LT(found->sweeps, 5000u);
  for (const char* name : {"A", "B"}) {
    const State s = *mdp.find_state(name);
    EXPECT_EQ(found->lower[s], -inf);
    EXPECT_EQ(found->upper[s], inf);
  }
}

TEST(Solver, AGainNobodyReachesSpoilsNothing) {
  // S ends for 1, W comes to S for 3: 4. U gains for ever, V comes to U. D cannot end.
  for (const bool chances : {false, true}) {
    MdpBuilder b(1.0);
    b.move("S", "go", "END", 1).move("W", "go", "S", 3);
    b.move("U", "stay", "U", 2).move("U", "out", "S").move("V", "go", "U", -1);
    b.move("D", "stay", "D", -1).start("S");
    if (chances) b.move("S", "coin", "S", 0, 0.5).move("S", "coin", "END", 0, 0.5);
    const Mdp mdp = test::built(b);
    for (const SolverEntry& entry : solvers()) {
      if (!test::can_do(entry, mdp)) continue;
      SCOPED_TRACE(entry.name);
      const auto found = solve(mdp, {}, entry.name);
      ASSERT_TRUE(found) << message(found.error());
      EXPECT_TRUE(found->converged);
      EXPECT_FALSE(found->exact);
      expect_value(mdp, *found, "S", 1);
      expect_value(mdp, *found, "W", 4);
      for (const char* name : {"U", "V"}) {
        EXPECT_EQ(found->lower[*mdp.find_state(name)], -inf) << name;
        EXPECT_EQ(found->upper[*mdp.find_state(name)], inf) << name;
      }
      EXPECT_EQ(found->upper[*mdp.find_state("D")], -inf);
    }
  }
}

}  // namespace
}  // namespace quoll
