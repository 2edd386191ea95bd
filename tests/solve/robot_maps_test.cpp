// Maps of robots, solved: a small one by hand, and the problems of a benchmark when they are there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "quoll/base/file.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/moving_ai.hpp"
#include "quoll/model/maze.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

Solution solved(const Mdp& mdp) {
  const Result<Solution> solution = solve(mdp);
  EXPECT_TRUE(solution) << message(solution.error());
  return *solution;
}

std::string place(std::uint32_t x, std::uint32_t y) {
  return std::to_string(x) + "," + std::to_string(y);
}

double length_of(const Mdp& mdp, const Solution& solution, std::string_view state) {
  const std::optional<State> found = mdp.find_state(state);
  if (!found) {
    ADD_FAILURE() << "no state " << state;
    return std::nan("");
  }
  const State s = *found;
  EXPECT_LE(solution.upper[s] - solution.lower[s], 1e-9);
  return -solution.lower[s];
}

constexpr std::string_view small =
    "type octile\nheight 4\nwidth 5\nmap\n"
    "..@..\n"
    "..@..\n"
    "....T\n"
    "OO...\n";
const double diagonal = std::sqrt(2.0);

TEST(RobotMaps, ASmallMapByHand) {
  const auto mdp = parse_model(small, "small.map", {{"goal", "4,0"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  const Solution solution = solved(*mdp);
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(length_of(*mdp, solution, "r0c4"), 0.0);
  EXPECT_EQ(length_of(*mdp, solution, "r0c3"), 1.0);
  EXPECT_NEAR(length_of(*mdp, solution, "r1c3"), diagonal, 1e-12);
  // Down the left side and through the gap, whose corners cannot be cut: r0c0, r1c0, r2c1, r2c2,
  // r2c3, r1c3, r0c4.
  EXPECT_NEAR(length_of(*mdp, solution, "r0c0"), 4 + 2 * diagonal, 1e-12);
  // r3c4, r3c3, r2c3, r1c3, r0c4: r2c4 is blocked.
  EXPECT_NEAR(length_of(*mdp, solution, "r3c4"), 3 + diagonal, 1e-12);
}

TEST(RobotMaps, TurnsArePaidFor) {
  const auto mdp = parse_model(small, "small.map", {{"goal", "0,2"}, {"heading", "true"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  const Solution solution = solved(*mdp);
  EXPECT_EQ(length_of(*mdp, solution, "r0c0-S"), 2.0);
  EXPECT_EQ(length_of(*mdp, solution, "r0c0-E"), 3.0);  // two turns
  EXPECT_EQ(length_of(*mdp, solution, "r0c0-N"), 4.0);  // four
  // South, then south-west: one turn; or the other way round from SW: two more.
  EXPECT_NEAR(length_of(*mdp, solution, "r0c1-S"), 1 + 0.5 + diagonal, 1e-12);
}

TEST(RobotMaps, DriftOnACorridorIsWaiting) {
  // Both sides of every move are blocked: a move of length 1 succeeds with 1/2, and what drifts
  // pays the diagonal. v = (1 + r2) / 2 + v / 2 per cell, so 1 + r2 each.
  const auto mdp = parse_model("height 1\nwidth 4\nmap\n....\n", "corridor.map",
                               {{"goal", "3,0"}, {"slip", "0.5"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  const Solution solution = solved(*mdp);
  EXPECT_NEAR(-solution.lower[0], 3 * (1 + diagonal), 1e-6);
}

TEST(RobotMaps, AMazeIsAsLongAsWithFourMoves) {
  // Corridors of mazes are one cell wide, so every diagonal is cut off by a corner.
  MazeSettings settings;
  settings.size = 63;
  const Grid grid = make_maze(settings);
  std::string text = "type octile\nheight 63\nwidth 63\nmap\n";
  for (const std::string& row : grid.rows) {
    for (const char letter : row) text += letter == '#' ? '@' : '.';
    text += '\n';
  }
  const auto mdp = parse_model(text, "maze.map", {{"goal", "62,62"}, {"start", "0,0"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  const auto plain = to_mdp(grid);
  ASSERT_TRUE(plain) << message(plain.error());
  EXPECT_EQ(solved(*mdp).lower[mdp->start()[0]], solved(*plain).lower[plain->start()[0]]);
}

TEST(RobotMaps, AnOpenFieldIsCertified) {
  // Very many equally long ways whose sums round differently: 400 diagonals or straight moves.
  std::string text = "height 400\nwidth 400\nmap\n";
  for (int row = 0; row < 400; ++row) text += std::string(400, '.') + "\n";
  const auto mdp = parse_model(text, "field.map", {{"goal", "399,399"}});
  ASSERT_TRUE(mdp) << message(mdp.error());
  const Solution solution = solved(*mdp);
  EXPECT_TRUE(solution.converged);
  EXPECT_NEAR(-solution.lower[0], 399 * diagonal, 1e-9);
  EXPECT_LE(-solution.upper[0], 399 * diagonal);
  EXPECT_NEAR(-solution.upper[0], 399 * diagonal, 1e-8);
  // From x = 200 in the first row: 199 columns and 399 rows, 199 moves of both.
  EXPECT_NEAR(-solution.lower[200], 200 + 199 * diagonal, 1e-9);
}

// QUOLL_SCENARIO=FOLDER/name.map.scen, with FOLDER/name.map beside it: every problem's length.
TEST(RobotMaps, LengthsOfABenchmark) {
  const char* scenario = std::getenv("QUOLL_SCENARIO");
  if (scenario == nullptr) GTEST_SKIP() << "QUOLL_SCENARIO=FILE.map.scen is not given";
  const std::string file = scenario;
  const std::string map_file = file.substr(0, file.rfind(".scen"));
  const Result<std::string> text = read_file(file);
  ASSERT_TRUE(text) << message(text.error());
  const auto problems = parse_problems(*text, file);
  ASSERT_TRUE(problems) << message(problems.error());
  std::map<std::string, std::vector<Problem>> by_goal;
  for (const Problem& problem : *problems) {
    by_goal[place(problem.goal_x, problem.goal_y)].push_back(problem);
  }
  double worst = 0.0;
  for (const auto& [goal, tasks] : by_goal) {
    const auto mdp = read_model(map_file, {{"goal", goal}});
    ASSERT_TRUE(mdp) << message(mdp.error());
    const Solution solution = solved(*mdp);
    for (const Problem& task : tasks) {
      const std::string state =
          "r" + std::to_string(task.start_y) + "c" + std::to_string(task.start_x);
      const double length = length_of(*mdp, solution, state);
      EXPECT_NEAR(length, task.length, 1e-4) << file << ":" << task.line;
      worst = std::max(worst, std::fabs(length - task.length));
    }
  }
  std::printf("%zu problems, %zu goals, largest error %.3g\n", problems->size(), by_goal.size(),
              worst);
}

}  // namespace
}  // namespace quoll
