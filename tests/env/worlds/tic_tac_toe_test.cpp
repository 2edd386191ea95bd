#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "played.hpp"

namespace quoll::world_tests {
namespace {

World game(const Parameters& parameters = {}) {
  Result<World> world = find_world("tic-tac-toe", parameters);
  EXPECT_TRUE(world) << (world ? "" : message(world.error()));
  return std::move(*world);
}

// 5,478 positions; 958 of them are final: 626 won by X, 316 by O, 16 draws.
TEST(TicTacToe, HasAllPositions) {
  const World world = game();
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 5478u);
  EXPECT_TRUE(mdp.alternating() && mdp.deterministic());
  EXPECT_EQ(world.traits.players, 2u);
  std::map<std::string, int> ends;
  for (State s = 0; s < mdp.states(); ++s) {
    const std::string name = mdp.state_name(s);
    if (mdp.terminal(s)) ++ends[name.substr(12)];
  }
  EXPECT_EQ(ends, (std::map<std::string, int>{{"X won", 626}, {"O won", 316}, {"drawn", 16}}));
}

TEST(TicTacToe, MovesAndRewards) {
  const World world = game();
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), ".../.../... x");
  EXPECT_EQ(mdp.actions(mdp.start()[0]), 9u);
  EXPECT_EQ(led(mdp, ".../.../... x", "b2").to, ".../.X./... o");
  EXPECT_EQ(led(mdp, ".../.../... x", "c1").to, ".../.../..X o");
  const Led won = led(mdp, "OX./.XO/... x", "b1");
  EXPECT_EQ(won.to, "OX./.XO/.X. X won");
  EXPECT_EQ(won.reward, 1.0);
  const Led by_o = led(mdp, "XXO/.OX/... o", "a1");
  EXPECT_EQ(by_o.to, "XXO/.OX/O.. O won");
  EXPECT_EQ(by_o.reward, 1.0);
  EXPECT_EQ(led(mdp, "XXO/OOX/XO. x", "c1").to, "XXO/OOX/XOX drawn");
  EXPECT_EQ(led(mdp, "XXO/OOX/XO. x", "c1").reward, 0.0);
}

TEST(TicTacToe, LooksLikeABoard) {
  const World world = game();
  const auto environment = world.make({1, 1, 0, nullptr});
  const State s = *world.mdp->find_state("X.O/.X./..O x");
  EXPECT_EQ(environment->inspector()->text(0, s), "X . O\n. X .\n. . O\nx to move\n");
  const State won = *world.mdp->find_state("OX./.XO/.X. X won");
  EXPECT_EQ(environment->inspector()->text(0, won), "O X .\n. X O\n. X .\nX won\n");
  EXPECT_EQ(environment->inspector()->drawing(0, s).shapes.size(), 9u + 2 * 2 + 2 * 2 + 1);
}

// The value to X of the position on nine letters, X to play best and O at random or best.
double value(std::string cells, bool x_to_move, bool random) {
  const int rows[8][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {0, 3, 6},
                          {1, 4, 7}, {2, 5, 8}, {0, 4, 8}, {2, 4, 6}};
  for (const auto& row : rows) {
    const char first = cells[row[0]];
    if (first != '.' && first == cells[row[1]] && first == cells[row[2]]) {
      return first == 'X' ? 1.0 : -1.0;
    }
  }
  double best = x_to_move ? -2.0 : 2.0, sum = 0.0;
  int moves = 0;
  for (char& cell : cells) {
    if (cell != '.') continue;
    cell = x_to_move ? 'X' : 'O';
    const double after = value(cells, !x_to_move, random);
    cell = '.';
    best = x_to_move ? std::max(best, after) : std::min(best, after);
    sum += after;
    ++moves;
  }
  if (moves == 0) return 0.0;
  return !x_to_move && random ? sum / moves : best;
}

TEST(TicTacToe, AgainstARandomPlayer) {
  const World world = game({{"opponent", "uniform"}});
  EXPECT_EQ(world.traits.players, 1u);
  EXPECT_FALSE(world.mdp->alternating());
  EXPECT_NEAR(optimum(world, 1.0), value(".........", true, true), 1e-12);
  EXPECT_EQ(probability(*world.mdp, ".../.../... x", "b2", "O../.X./... x"), 0.125);
  EXPECT_EQ(led(*world.mdp, "XX./OO./... x", "c3").reward, 1.0);
  // Of four answers one, c2, wins for O.
  const State s = *world.mdp->find_state("XX./OO./... x");
  for (std::uint64_t c = world.mdp->choice_begin(s); c < world.mdp->choice_end(s); ++c) {
    if (world.mdp->action_name(c) != "a1") continue;
    EXPECT_NEAR(world.mdp->reward(c), -0.25, 1e-15);
  }
}

TEST(TicTacToe, AsTheSecondPlayer) {
  const World world = game({{"opponent", "uniform"}, {"mark", "o"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.start().size(), 9u);
  EXPECT_EQ(mdp.state_name(mdp.start()[4]), ".../.X./... o");
  EXPECT_NEAR(mdp.start_probability(4), 1.0 / 9.0, 1e-15);
  EXPECT_EQ(led(mdp, "XXO/.OX/... o", "a1").reward, 1.0);
  double lost = 0.0;  // O leaves the row of X's open
  const State s = *mdp.find_state("XX./.O./... o");
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (mdp.action_name(c) == "a1") lost = mdp.reward(c);
  }
  EXPECT_NEAR(lost, -0.2, 1e-15);
}

TEST(TicTacToe, NobodyBeatsThePerfectPlayer) {
  for (const char* mark : {"x", "o"}) {
    const World world = game({{"opponent", "perfect"}, {"mark", mark}});
    EXPECT_TRUE(world.mdp->deterministic());
    EXPECT_EQ(optimum(world, 1.0), 0.0) << mark;
    EXPECT_EQ(world.mdp->reward_bounds().second, 0.0) << mark;  // no way to win at all
  }
}

TEST(TicTacToe, AgainstAPolicyFromAFile) {
  const std::string path =
      testing::TempDir() + "tic_tac_toe_policy-" + std::to_string(getpid()) + ".csv";
  const auto with = [&](const std::string& text, const char* mark) {
    std::ofstream(path) << text;
    return find_world("tic-tac-toe", {{"opponent", path}, {"mark", mark}});
  };
  // O always takes the first free cell in reading order, so X wins in three moves.
  const World all = game();
  std::string first = "# by hand\nstate,action\n";
  for (State s = 0; s < all.mdp->states(); ++s) {
    if (!all.mdp->terminal(s)) first += all.mdp->state_name(s) + ",0\n";
  }
  const Result<World> easy = with(first, "x");
  ASSERT_TRUE(easy) << message(easy.error());
  EXPECT_EQ(optimum(*easy, 1.0), 1.0);
  EXPECT_EQ(led(*easy->mdp, ".../.../... x", "b2").to, "O../.X./... x");
  const Result<World> second = with(first, "o");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->mdp->state_name(second->mdp->start()[0]), "X../.../... o");
  const auto refusal = [&](const std::string& text) { return message(with(text, "x").error()); };
  EXPECT_EQ(refusal("state,action\n.../.X./... o,a3\n"),
            path +
                ": no action for state X../.../... o; "
                "--with unknown=uniform takes any there");
  // O knows one board only, and takes any free cell on the others.
  std::ofstream(path) << "state,action\n.../.X./... o,a3\n";
  const World half = game({{"opponent", path}, {"unknown", "uniform"}});
  EXPECT_EQ(led(*half.mdp, ".../.../... x", "b2").to, "O../.X./... x");
  EXPECT_EQ(probability(*half.mdp, ".../.../... x", "a3", "X.O/.../... x"), 0.125);
  EXPECT_EQ(refusal("state,action\n.../.X./... o,b2\n"),
            path + ":2: a legal move of .../.X./... o expected, not 'b2'");
  EXPECT_EQ(refusal("state,action\nHALL,b2\n"),
            path + ":2: a position of tic-tac-toe expected, not 'HALL'");
  EXPECT_EQ(refusal("state,action\nXX./XX./XX. x,b2\n"),
            path + ":2: a position of tic-tac-toe expected, not 'XX./XX./XX. x'");
  EXPECT_EQ(message(find_world("tic-tac-toe", {{"opponent", "any.quoll"}}).error()),
            "any.quoll: a file .csv expected: this program reads no other policies");
  EXPECT_EQ(refusal("a,b\n"), path + ":1: the header state,action expected");
  std::remove(path.c_str());
  EXPECT_EQ(refused("tic-tac-toe", {{"opponent", "perfct"}}).nearest, "perfect");
}

}  // namespace
}  // namespace quoll::world_tests
