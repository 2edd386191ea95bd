// Board games solved from their ends on, against a search that knows nothing of models.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {
namespace {

World world_of(const char* name, const Parameters& parameters = {}) {
  Result<World> world = find_world(name, parameters);
  EXPECT_TRUE(world) << (world ? "" : message(world.error()));
  return std::move(*world);
}

TEST(BoardGames, TicTacToeIsADraw) {
  const World world = world_of("tic-tac-toe");
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 5478u);
  const auto found = solve(mdp);
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_EQ(found->method, "backward-induction");
  EXPECT_TRUE(found->exact);
  EXPECT_EQ(found->lower[mdp.start()[0]], 0.0);
  const auto verdict = verify(mdp, found->lower, found->upper, found->policy, 1.0);
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->accepted) << verdict->reason;
  const Optimality judged = judge(mdp, *found, found->policy, mdp.start(), 1.0);
  EXPECT_EQ(judged.optimal, true) << judged.proof;
  EXPECT_EQ(judged.regret, 0.0);
  // Every opening draws; after a corner only the centre does.
  EXPECT_EQ(optimal_actions(mdp, *found, mdp.start()[0]).size(), 9u);
  const State corner = *mdp.find_state("X../.../... o");
  const std::vector<Action> replies = optimal_actions(mdp, *found, corner);
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(mdp.action_name(mdp.choice_begin(corner) + replies[0]), "b2");
}

// Connect Four on letters: column by column, bottom first; the window is searched by alpha-beta
// with fail-hard bounds. Knuth, Moore 1975.
struct Search {
  int rows, columns, connect;
  std::vector<std::string> stones;

  bool connected(std::size_t column, char who) const {
    const int c = static_cast<int>(column), h = static_cast<int>(stones[column].size()) - 1;
    for (const auto& [right, up] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
      int length = 1;
      for (const int way : {1, -1}) {
        for (int k = 1;; ++k) {
          const int x = c + way * k * right, y = h + way * k * up;
          if (x < 0 || y < 0 || x >= columns) break;
          const std::string& there = stones[static_cast<std::size_t>(x)];
          if (y >= static_cast<int>(there.size()) || there[static_cast<std::size_t>(y)] != who)
            break;
          ++length;
        }
      }
      if (length >= connect) return true;
    }
    return false;
  }

  int value(char who, int alpha, int beta) {
    bool moved = false;
    for (std::size_t c = 0; c < stones.size(); ++c) {
      if (static_cast<int>(stones[c].size()) == rows) continue;
      moved = true;
      stones[c] += who;
      const int after = connected(c, who) ? 1 : -value(who == 'X' ? 'O' : 'X', -beta, -alpha);
      stones[c].pop_back();
      alpha = std::max(alpha, after);
      if (alpha >= beta) break;
    }
    return moved ? alpha : 0;
  }
};

// The position of a state's name.
Search search_of(const std::string& name, int rows, int columns, int connect) {
  Search search{rows, columns, connect,
                std::vector<std::string>(static_cast<std::size_t>(columns))};
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t row = static_cast<std::size_t>(rows); row-- > 0;) {
    for (std::size_t c = 0; c < width; ++c) {
      const char cell = name[row * (width + 1) + c];
      if (cell != '.') search.stones[c] += cell;
    }
  }
  return search;
}

void expect_as_searched(int rows, int columns, int connect, std::uint64_t stride) {
  const World world = world_of("connect-four", {{"rows", std::to_string(rows)},
                                                {"columns", std::to_string(columns)},
                                                {"connect", std::to_string(connect)}});
  const Mdp& mdp = *world.mdp;
  const auto found = solve(mdp);
  ASSERT_TRUE(found) << message(found.error());
  EXPECT_TRUE(found->exact);
  for (std::uint64_t i = 0; i < mdp.states(); i += stride) {
    const auto s = static_cast<State>(i);
    if (mdp.terminal(s)) continue;
    const std::string name = mdp.state_name(s);
    const char who = name.back() == 'x' ? 'X' : 'O';
    ASSERT_EQ(found->lower[s], search_of(name, rows, columns, connect).value(who, -1, 1)) << name;
  }
}

TEST(BoardGames, SmallConnectFourAgainstAlphaBeta) {
  expect_as_searched(4, 4, 3, 1);
  expect_as_searched(3, 4, 3, 1);
  expect_as_searched(3, 5, 4, 1);
  expect_as_searched(4, 4, 4, 401);
}

TEST(BoardGames, AgainstARandomPlayerBothMethodsAgree) {
  for (const char* mark : {"x", "o"}) {
    const World world = world_of("tic-tac-toe", {{"opponent", "uniform"}, {"mark", mark}});
    const Mdp& mdp = *world.mdp;
    const auto backward = solve(mdp, {}, "backward-induction");
    const auto forward = solve(mdp);
    ASSERT_TRUE(backward && forward);
    for (State s = 0; s < mdp.states(); ++s) {
      EXPECT_LE(backward->upper[s] - backward->lower[s], 1e-14);
      EXPECT_LE(forward->lower[s], backward->upper[s]);
      EXPECT_GE(forward->upper[s], backward->lower[s]);
    }
  }
}

// A policy that errs once is told what it loses against best replies.
TEST(BoardGames, OneErrorIsFound) {
  const World world = world_of("tic-tac-toe");
  const Mdp& mdp = *world.mdp;
  const auto found = solve(mdp);
  ASSERT_TRUE(found);
  std::vector<Action> policy = found->policy;
  const State corner = *mdp.find_state("X../.../... o");
  policy[corner] = 0;  // not the centre: loses
  const Optimality judged = judge(mdp, *found, policy, mdp.start(), 1.0);
  EXPECT_EQ(judged.optimal, false);
  EXPECT_EQ(judged.regret, 1.0);
  EXPECT_EQ(judged.worst, corner);
}

}  // namespace
}  // namespace quoll
