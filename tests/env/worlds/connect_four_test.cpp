#include "quoll/env/worlds/connect_four.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "quoll/env/policy_reader.hpp"

#include "played.hpp"

namespace quoll::world_tests {
namespace {

World game(const Parameters& parameters = {}) {
  return made("connect-four", parameters);
}

Tree board(const std::string& text) {
  return Tree(Tree::Object{{"board", Tree(text)}});
}

// One lane that is put into boards and stepped.
struct Table {
  std::unique_ptr<Environment> environment;
  std::vector<float> observation = std::vector<float>(84), after = std::vector<float>(84);
  Feedback feedback;
  State state = 0, next = 0;

  explicit Table(const World& world) : environment(world.make({1, 1, 0, nullptr})) {}
  Result<void> put(const std::string& text) {
    return environment->inspector()->set(0, board(text), state);
  }
  std::string begin() {
    const std::uint8_t restart = 1;
    Experience now{{&state, 1}, {}, {}, {}, observation, {}};
    environment->restart({&restart, 1}, now);
    return shown();
  }
  std::string step(Action action) {
    Experience now{{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, observation, after};
    environment->step(now);
    return shown();
  }
  std::string shown() const {
    return std::get<std::string>(environment->inspector()->state(0, 0).find("board")->value);
  }
};

const std::string empty_rows = "......./......./......./";

TEST(ConnectFour, StonesFallAndTheTurnPasses) {
  const World world = game();
  EXPECT_EQ(world.traits.players, 2u);
  EXPECT_EQ(world.action_names, (std::vector<std::string>{"a", "b", "c", "d", "e", "f", "g"}));
  Table table(world);
  const Spaces spaces = table.environment->spaces();
  EXPECT_EQ(spaces.observation, 84u);
  EXPECT_EQ(spaces.shape, (std::array<std::uint32_t, 3>{6, 7, 2}));
  ASSERT_TRUE(table.put(empty_rows + "......./......./....... x"));
  EXPECT_EQ(table.step(3), empty_rows + "......./......./...X... o");
  EXPECT_TRUE(table.feedback.turn_passes);
  EXPECT_EQ(table.step(3), empty_rows + "......./...O.../...X... x");
  EXPECT_EQ(table.feedback.reward, 0.0);
  // X is to move: its stone at the bottom of d in the first plane, O's above in the second.
  EXPECT_EQ(table.after[(5 * 7 + 3) * 2], 1.0f);
  EXPECT_EQ(table.after[(4 * 7 + 3) * 2 + 1], 1.0f);
  EXPECT_EQ(std::count(table.after.begin(), table.after.end(), 1.0f), 2);
  EXPECT_EQ(table.environment->inspector()->text(0, 0),
            ". . . . . . .\n. . . . . . .\n. . . . . . .\n. . . . . . .\n. . . O . . .\n"
            ". . . X . . .\nx to move\n");
}

TEST(ConnectFour, RowsInAllDirectionsWin) {
  const std::pair<std::string, Action> wins[] = {
      {empty_rows + "......./OO.O.../XX.X... x", 2},             // across
      {"......./......./......./X....../XO...../XOO.... x", 0},  // up
      {empty_rows + "..XO.../.XOO.../XOXOX.. x", 3},             // rising
      {empty_rows + "...OX../...OOX./..XOOXX x", 3},             // falling
  };
  for (const auto& [text, action] : wins) {
    Table table(game());
    const Result<void> put = table.put(text);
    ASSERT_TRUE(put) << message(put.error());
    const std::string after = table.step(action);
    EXPECT_EQ(after.substr(after.find(' ') + 1), "X won") << text;
    EXPECT_EQ(table.feedback.reward, 1.0);
    EXPECT_TRUE(table.feedback.terminated);
    EXPECT_FALSE(table.feedback.turn_passes);
    EXPECT_EQ(table.step(5), after);  // an end stays
    EXPECT_EQ(table.feedback.reward, 0.0);
  }
}

TEST(ConnectFour, NoRowGoesRoundTheEdge) {
  // Three at the top of a, one at the bottom of b; and a diagonal across the edge.
  const ConnectFour shape;
  const std::uint64_t column =
      shape.bit(0, 3) | shape.bit(0, 4) | shape.bit(0, 5) | shape.bit(1, 0);
  EXPECT_FALSE(shape.has_row(column));
  EXPECT_TRUE(shape.has_row(column | shape.bit(0, 2)));
  EXPECT_FALSE(
      shape.has_row(shape.bit(4, 5) | shape.bit(5, 5) | shape.bit(6, 5) | shape.bit(0, 5)));
}

TEST(ConnectFour, AFullColumnLoses) {
  Table table(game());
  ASSERT_TRUE(table.put("O....../X....../O....../X....../O....../X...... x"));
  EXPECT_EQ(table.step(0), "O....../X....../O....../X....../O....../X...... O won");
  EXPECT_EQ(table.feedback.reward, -1.0);
  EXPECT_TRUE(table.feedback.terminated);
  ASSERT_TRUE(table.put("O....../X....../O....../X....../O....../X...... O won"));
}

TEST(ConnectFour, ImpossibleBoardsAreRefused) {
  Table table(game());
  const std::string wrong[] = {
      "x",
      empty_rows + "......./......./...... x",
      empty_rows + "......./...X.../....... o",  // hangs
      empty_rows + "......./......./..XX... o",  // two more
      empty_rows + "......./......./...X... x",  // whose turn
      empty_rows + "......./......./...X... O won",
      "......./......./X....../XO...../XO...../XO..... o",
      empty_rows + "......./......./...Y... o",
  };
  for (const std::string& text : wrong) EXPECT_FALSE(table.put(text)) << text;
  EXPECT_TRUE(table.put("......./......./X....../XO...../XO...../XO..... X won"));
  EXPECT_EQ(refused("connect-four", {{"rows", "8"}, {"columns", "8"}}).expected,
            "at most 7 columns of 8 rows expected, not 8");
}

TEST(ConnectFour, ARandomPlayerAnswers) {
  const World world = game({{"opponent", "uniform"}});
  EXPECT_EQ(world.traits.players, 1u);
  Table table(world);
  std::vector<int> answered(7, 0);
  for (int i = 0; i < 700; ++i) {
    ASSERT_TRUE(table.put(empty_rows + "......./......./....... x"));
    const std::string after = table.step(3);
    EXPECT_FALSE(table.feedback.turn_passes);
    for (std::size_t c = 0; c < 7; ++c) {
      answered[c] += after[5 * 8 + c] == 'O' || after[4 * 8 + c] == 'O';
    }
  }
  for (const int count : answered) EXPECT_NEAR(count, 100, 50);  // 5.4 standard deviations
  // The draw says which open column: a is full here, so the fourth is e.
  const auto draws = std::make_shared<const std::vector<double>>(std::vector<double>{3.0});
  Table fed(world);
  fed.environment = world.make({1, 1, 0, draws});
  ASSERT_TRUE(fed.put("......./X....../O....../X....../O....../X.O.... x"));
  EXPECT_EQ(fed.step(0), "X....../X....../O....../X....../O....../X.O.O.. x");
  // Playing second, O never wins for X.
  const World second = game({{"opponent", "uniform"}, {"mark", "o"}});
  const auto environment = second.make({1, 1, 0, nullptr});
  std::vector<float> observation(84);
  State state = 0;
  const std::uint8_t restart = 1;
  Experience now{{&state, 1}, {}, {}, {}, observation, {}};
  environment->restart({&restart, 1}, now);
  EXPECT_EQ(std::count(observation.begin(), observation.end(), 1.0f), 1);
}

TEST(ConnectFour, APolicyFromAFileAnswers) {
  const std::string path =
      testing::TempDir() + "connect_four_policy-" + std::to_string(getpid()) + ".csv";
  std::ofstream(path) << "state,action\n" + empty_rows + "......./......./...X... o,d\n" +
                             empty_rows + "......./......./....... x,g\n";
  const World world = game({{"opponent", path}, {"unknown", "uniform"}});
  EXPECT_EQ(world.traits.players, 1u);
  const auto draws = std::make_shared<const std::vector<double>>(std::vector<double>{6.0});
  Table table(world);
  table.environment = world.make({1, 1, 0, draws});
  ASSERT_TRUE(table.put(empty_rows + "......./......./....... x"));
  EXPECT_EQ(table.step(3), empty_rows + "......./...O.../...X... x");  // takes no draw
  EXPECT_EQ(table.step(0), empty_rows + "......./...O.../X..X..O x");  // not in the file
  Table second(game({{"opponent", path}, {"unknown", "uniform"}, {"mark", "o"}}));
  EXPECT_EQ(second.begin(), empty_rows + "......./......./......X o");
  EXPECT_EQ(refused("connect-four", {{"opponent", path}}).file, "--with unknown");
  // Of another board: the file's cells do not fit.
  EXPECT_EQ(message(refused("connect-four", {{"opponent", path}, {"rows", "4"}, {"columns", "4"}})),
            path + ":2: a position of connect-four expected, not '" + empty_rows +
                "......./......./...X... o'");
  std::ofstream(path) << "state,action\n..../..../..../.X.. o,c\n";
  const Parameters small{{"opponent", path},
                         {"rows", "4"},
                         {"columns", "4"},
                         {"connect", "3"},
                         {"unknown", "uniform"}};
  const World four = game(small);
  ASSERT_TRUE(four.mdp);
  EXPECT_EQ(led(*four.mdp, "..../..../..../.... x", "b").to, "..../..../..../.XO. x");
  EXPECT_EQ(probability(*four.mdp, "..../..../..../.... x", "a", "..../..../O.../X... x"), 0.25);
  std::remove(path.c_str());
  EXPECT_EQ(refused("connect-four", {{"opponent", "perfect"}}).expected,
            "self, uniform or a file .csv, .json or .quoll expected, not 'perfect'");
}

// Always moves in the leftmost column in which a stone of the other side lies, else in the first.
Result<SavedPolicy> follower(const std::string&, std::string_view world,
                             const Parameters& parameters) {
  EXPECT_EQ(world, "connect-four");
  EXPECT_TRUE(gives(parameters, "opponent"));
  return SavedPolicy{"", SeeingPlayer([]() -> SeeingPlayer::Act {
                       return [](std::span<const float> seen) {
                         Action column = 0;
                         for (Action c = 7; c-- > 0;) {
                           if (seen[(5 * 7 + c) * 2 + 1] == 1.0f) column = c;
                         }
                         return column;
                       };
                     })};
}

TEST(ConnectFour, APolicyThatSeesAnswers) {
  set_policy_reader(follower);
  const World first = game({{"opponent", "anybody.quoll"}});
  const World second = game({{"opponent", "anybody.quoll"}, {"mark", "o"}});
  set_policy_reader(nullptr);
  Table table(first);
  table.begin();
  EXPECT_EQ(table.step(3), empty_rows + "......./...O.../...X... x");
  EXPECT_FALSE(table.feedback.turn_passes);
  Table other(second);
  EXPECT_EQ(other.begin(), empty_rows + "......./......./X...... o");
  EXPECT_EQ(other.step(4), empty_rows + "......./....X../X...O.. o");
  // Into a full column it loses like anybody.
  ASSERT_TRUE(table.put("...O.../...X.../...O.../...X.../...O.../...X... x"));
  EXPECT_EQ(table.step(4), "...O.../...X.../...O.../...X.../...O.../...XX.. X won");
  EXPECT_EQ(table.feedback.reward, 1.0);
  EXPECT_TRUE(table.feedback.terminated);
}

// 161,029 positions of 4 x 4 with four in a row: OEIS A212693.
TEST(ConnectFour, SmallBoardsAreTables) {
  const World four = game({{"rows", "4"}, {"columns", "4"}});
  ASSERT_TRUE(four.mdp);
  EXPECT_EQ(four.mdp->states(), 161'029u);
  EXPECT_TRUE(four.mdp->alternating());
  const World three = game({{"rows", "4"}, {"columns", "4"}, {"connect", "3"}});
  EXPECT_EQ(led(*three.mdp, "..../..../..../.... x", "b").to, "..../..../..../.X.. o");
  const Led won = led(*three.mdp, "..../..../XO../XO.. x", "a");
  EXPECT_EQ(won.to, "..../X.../XO../XO.. X won");
  EXPECT_EQ(won.reward, 1.0);
}

}  // namespace
}  // namespace quoll::world_tests
