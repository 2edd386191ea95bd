#include "quoll/model/formats/moving_ai.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../../refusal.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

// 5 x 4: a wall with a gap, and water below right.
constexpr std::string_view small =
    "type octile\nheight 4\nwidth 5\nmap\n"
    "..@..\n"
    "..@S.\n"
    "G...T\n"
    "OO.WW\n";

Mdp model(std::string_view text, const Parameters& given) {
  auto mdp = parse_model(text, "small.map", given);
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

std::string refusal(std::string_view text, const Parameters& given = {{"goal", "0,0"}}) {
  return tests::refusal_of(parse_model(text, "m.map", given));
}

// The outcome of an action by name: "next reward".
std::string outcome(const Mdp& mdp, std::string_view state, std::string_view action) {
  const auto s = mdp.find_state(state);
  if (!s) return "no state";
  for (std::uint64_t c = mdp.choice_begin(*s); c < mdp.choice_end(*s); ++c) {
    if (mdp.action_name(c) != action) continue;
    std::string text;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      const double diagonal = std::sqrt(2.0);
      const double reward = mdp.reward(c, o);
      text += (text.empty() ? "" : ", ") + mdp.state_name(mdp.next(o)) + " " +
              (reward == -diagonal ? "-r2" : std::to_string(reward).substr(0, 4));
      if (mdp.probability(o) < 1) text += " p" + std::to_string(mdp.probability(o)).substr(0, 4);
    }
    return text;
  }
  return "no action";
}

TEST(MovingAi, CellsMovesAndLengths) {
  const Mdp mdp = model(small, {{"goal", "4,0"}, {"start", "0,0"}});
  // All cells of the ground: 4 + 4 (above), 4, 1; the water has no way to it.
  EXPECT_EQ(mdp.states(), 13u);
  EXPECT_FALSE(mdp.find_state("r3c3"));
  EXPECT_EQ(mdp.discount(), 1.0);
  EXPECT_TRUE(mdp.deterministic());
  ASSERT_EQ(mdp.start().size(), 1u);
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "r0c0");
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r0c4")));
  EXPECT_EQ(outcome(mdp, "r0c0", "E"), "r0c1 -1.0");
  EXPECT_EQ(outcome(mdp, "r0c0", "SE"), "r1c1 -r2");
  EXPECT_EQ(outcome(mdp, "r0c0", "N"), "no action");
  EXPECT_EQ(outcome(mdp, "r0c1", "E"), "no action");
  // Past the corner of the wall at r1c2, and into the gap below it.
  EXPECT_EQ(outcome(mdp, "r2c2", "NE"), "no action");
  EXPECT_EQ(outcome(mdp, "r2c2", "E"), "r2c3 -1.0");
  // Past the water's corner.
  EXPECT_EQ(outcome(mdp, "r2c3", "SW"), "no action");
  EXPECT_EQ(outcome(mdp, "r2c2", "S"), "r3c2 -1.0");
}

TEST(MovingAi, WaterIsAWorldOfItsOwn) {
  const Mdp mdp = model(small, {{"goal", "3,3"}});
  EXPECT_EQ(mdp.states(), 2u);
  EXPECT_EQ(mdp.start().size(), 1u);
  EXPECT_EQ(outcome(mdp, "r3c4", "W"), "r3c3 -1.0");
}

TEST(MovingAi, SlipDriftsToBothSidesOfTheMove) {
  const Mdp mdp = model(small, {{"goal", "r0c4"}, {"slip", "0.5"}});
  // East along the top left room: north-east is off the map, south-east is free.
  EXPECT_EQ(outcome(mdp, "r0c0", "E"), "r0c1 -1.0 p0.50, r0c0 -r2 p0.25, r1c1 -r2 p0.25");
  // South through the gap: both sides are blocked.
  EXPECT_EQ(outcome(mdp, "r2c2", "S"), "r3c2 -1.0 p0.50, r2c2 -r2 p0.50");
}

TEST(MovingAi, WithHeadingTheRobotTurns) {
  const Mdp mdp = model(small, {{"goal", "4,0"}, {"start", "1,1"}, {"heading", "true"}});
  EXPECT_EQ(mdp.states(), 13u * 8u);
  EXPECT_EQ(mdp.start().size(), 8u);
  EXPECT_EQ(outcome(mdp, "r1c1-SE", "forward"), "no action");  // a corner
  EXPECT_EQ(outcome(mdp, "r1c1-S", "forward"), "r2c1-S -1.0");
  EXPECT_EQ(outcome(mdp, "r1c1-S", "left"), "r1c1-SE -0.5");
  EXPECT_EQ(outcome(mdp, "r1c1-N", "left"), "r1c1-NW -0.5");
  EXPECT_EQ(outcome(mdp, "r1c1-N", "right"), "r1c1-NE -0.5");
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r0c4-W")));
  const Mdp cheap = model(small, {{"goal", "4,0"}, {"heading", "true"}, {"turn_cost", "0.25"}});
  EXPECT_EQ(outcome(cheap, "r1c1-N", "right"), "r1c1-NE -0.2");
}

TEST(MovingAi, LineEndsOfOtherSystemsAreRead) {
  std::string windows;
  for (const char letter : small)
    windows += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  EXPECT_EQ(model(windows, {{"goal", "4,0"}}).states(), 13u);
  EXPECT_EQ(model(std::string(small.substr(0, small.size() - 1)), {{"goal", "4,0"}}).states(), 13u);
}

TEST(MovingAi, FaultsOfAMapNameTheirPlace) {
  EXPECT_EQ(refusal(""), "m.map: expected type, height, width and map, and then the rows");
  EXPECT_EQ(refusal("type tile\n"), "m.map:1:1: expected type octile, found 'tile'");
  EXPECT_EQ(refusal("type octile\nhight 3\n"),
            "m.map:2:1: expected type, height, width or map, found 'hight'; did you mean "
            "'height'?");
  EXPECT_EQ(refusal("height -3\n"), "m.map:1:1: expected a number of cells for height");
  EXPECT_EQ(refusal("type octile\nheight 2\nmap\n"), "m.map:3: expected width above the rows");
  EXPECT_EQ(refusal("height 2\nwidth 2\nmap\n..\n"),
            "m.map:4: expected 2 rows as height says, found 1");
  EXPECT_EQ(refusal("height 2\nwidth 2\nmap\n..\n..\n..\n"),
            "m.map:6:1: expected 2 rows as height says, found more");
  EXPECT_EQ(refusal("height 2\nwidth 2\nmap\n..\n.\n"),
            "m.map:5:2: expected 2 letters as width says, found 1");
  EXPECT_EQ(refusal("height 2\nwidth 2\nmap\n..\n.x\n"),
            "m.map:5:2: expected one of . G S (ground) W (water) @ O T (blocked)");
  // A size the file has no room for is refused before anything is allocated.
  EXPECT_EQ(refusal("height 4294967295\nwidth 4294967295\nmap\n"),
            "m.map:3: expected a map of 4294967295 x 4294967295 cells, found a file of 39 bytes");
}

TEST(MovingAi, FaultsOfATaskNameTheOption) {
  EXPECT_EQ(refusal(small, {}), "--with goal: the place to go expected: --with goal=x,y");
  EXPECT_EQ(refusal(small, {{"gaol", "1,1"}}).substr(0, 26), "--with: the world m.map ta");
  EXPECT_EQ(refusal(small, {{"goal", "1;1"}}),
            "--with goal: x,y or a cell like r3c14 expected, not '1;1'");
  EXPECT_EQ(refusal(small, {{"goal", "1.5,1"}}),
            "--with goal: whole numbers of cells expected, not '1.5,1'");
  EXPECT_EQ(refusal(small, {{"goal", "5,0"}}),
            "--with goal: a place on the map of 5 x 4 cells expected, not '5,0'");
  EXPECT_EQ(refusal(small, {{"goal", "2,0"}}),
            "--with goal: a cell that is not blocked expected, not '2,0'");
  EXPECT_EQ(refusal(small, {{"goal", "0,0"}, {"start", "4,3"}}),
            "--with start: a cell with a way to the goal expected, not '4,3'");
  EXPECT_EQ(refusal("height 1\nwidth 3\nmap\n.@.\n", {{"goal", "0,0"}}),
            "--with goal: a cell that another leads to expected, not '0,0'");
}

class Scenario : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "moving_ai_test-" + std::to_string(getpid()) + ".scen";
    write(
        "version 1\n"
        "0\tmaps/small.map\t5\t4\t0\t0\t1\t0\t1\n"
        "1 small.map 5 4 0 0 4 0 6.82842712\r\n"
        "\n0\tsmall.map\t9\t9\t0\t0\t1\t0\t1\n");
  }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(std::string_view text) { std::ofstream(path_) << text; }

  std::string path_;
};

TEST_F(Scenario, AProblemGivesStartAndGoal) {
  const Mdp mdp = model(small, {{"scen", path_}, {"problem", "2"}});
  EXPECT_EQ(mdp.state_name(mdp.start()[0]), "r0c0");
  EXPECT_TRUE(mdp.terminal(*mdp.find_state("r0c4")));
  const Mdp other = model(small, {{"scen", path_}, {"problem", "2"}, {"start", "3,1"}});
  EXPECT_EQ(other.state_name(other.start()[0]), "r1c3");
  EXPECT_TRUE(other.terminal(*other.find_state("r0c4")));
}

TEST_F(Scenario, FaultsOfAScenario) {
  EXPECT_EQ(refusal(small, {{"scen", path_}, {"problem", "4"}}),
            "--with problem: 1 to 3 expected, as " + path_ + " has, not 4");
  EXPECT_EQ(refusal(small, {{"scen", path_}, {"problem", "3"}}),
            path_ + ":5: expected a problem for a map of 5 x 4 cells, found one for 9 x 9");
  EXPECT_FALSE(refusal(small, {{"scen", path_ + ".none"}}).empty());
}

TEST(Problems, AreReadLineByLine) {
  const auto problems = parse_problems("0\tmaps/a b.map\t5\t4\t0\t1\t2\t3\t1.5\n", "a.scen");
  ASSERT_TRUE(problems) << message(problems.error());
  const Problem& problem = problems->front();
  EXPECT_EQ(problem.width, 5u);
  EXPECT_EQ(problem.height, 4u);
  EXPECT_EQ(problem.start_x, 0u);
  EXPECT_EQ(problem.start_y, 1u);
  EXPECT_EQ(problem.goal_x, 2u);
  EXPECT_EQ(problem.goal_y, 3u);
  EXPECT_EQ(problem.length, 1.5);
  const auto why = [](std::string_view text) {
    return tests::refusal_of(parse_problems(text, "a.scen"));
  };
  EXPECT_EQ(why(""), "a.scen: expected at least one problem");
  EXPECT_EQ(why("version 2\n"), "a.scen:1: expected version 1");
  EXPECT_EQ(why("version 1\n0\tm\t5\t4\t0\t0\t1\t0\n"),
            "a.scen:2: expected bucket, map, width, height, start x, start y, goal x, goal y and "
            "length (9 fields), found 8");
  EXPECT_EQ(why("0 m 5 4 0 0 x 0 1\n"), "a.scen:1:13: expected a number of cells for goal x");
  EXPECT_EQ(why("0 m 5 4 0 0 1 0 nan\n"), "a.scen:1:17: expected a number from 0 for length");
}

}  // namespace
}  // namespace quoll
