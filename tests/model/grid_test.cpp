#include "quoll/model/grid.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "quoll/model/check.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/maze.hpp"

namespace quoll {
namespace {

Mdp model(const std::string& text) {
  auto mdp = parse_model(text, "world.txt");
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *std::move(mdp);
}

std::string refusal(const std::string& text) {
  const auto mdp = parse_model(text, "g.txt");
  return mdp ? "accepted" : message(mdp.error());
}

// The state an action leads to in a deterministic world, and the reward.
std::pair<std::string, double> go(const Mdp& m, const std::string& from,
                                  const std::string& action) {
  const State s = *m.find_state(from);
  for (std::uint64_t c = m.choice_begin(s); c < m.choice_end(s); ++c) {
    if (m.action_name(c) == action) return {m.state_name(m.next(m.outcome_begin(c))), m.reward(c)};
  }
  return {"no such action", 0};
}

using Step = std::pair<std::string, double>;

TEST(Grid, APictureAloneIsAWorld) {
  // S.#
  // .PG
  const Mdp m = model("S.#\n.PG\n");
  ASSERT_EQ(m.states(), 5u);  // r0c0 r0c1 r1c0 r1c1 r1c2
  EXPECT_EQ(m.discount(), 1.0);
  EXPECT_TRUE(m.deterministic());
  EXPECT_EQ(m.choices(), 12u);  // three cells that are no ends
  EXPECT_TRUE(m.terminal(3));
  EXPECT_TRUE(m.terminal(4));
  EXPECT_EQ(go(m, "r0c0", "N"), Step("r0c0", -1));
  EXPECT_EQ(go(m, "r0c0", "E"), Step("r0c1", -1));
  EXPECT_EQ(go(m, "r0c0", "S"), Step("r1c0", -1));
  EXPECT_EQ(go(m, "r0c0", "W"), Step("r0c0", -1));
  EXPECT_EQ(go(m, "r0c1", "E"), Step("r0c1", -1));    // a wall
  EXPECT_EQ(go(m, "r0c1", "S"), Step("r1c1", -101));  // a pit
  EXPECT_EQ(go(m, "r1c0", "E"), Step("r1c1", -101));
  ASSERT_EQ(m.start().size(), 1u);
  EXPECT_EQ(m.start()[0], 0u);
  ASSERT_NE(m.layout(), nullptr);
  EXPECT_EQ(m.layout()->rows, 2u);
  EXPECT_EQ(m.layout()->columns, 3u);
  EXPECT_EQ(m.layout()->cell, (std::vector<std::uint32_t>{0, 1, 3, 4, 5}));
  EXPECT_EQ(m.layout()->direction[0], std::pair(0, -1));
  EXPECT_EQ(m.layout()->direction[1], std::pair(1, 0));
}

TEST(Grid, SettingsAndRewardsOfLetters) {
  const Mdp m = model(
      "% a comment\nmove_reward = -0.5\ndiscount = 0.9\nreward.A = 10\nreward.G = 2\n"
      "reward.= = 3\nterminal = G, X\n\nmap\nA.X\n =G\n");
  EXPECT_EQ(m.discount(), 0.9);
  EXPECT_EQ(go(m, "r0c1", "W"), Step("r0c0", 9.5));
  EXPECT_EQ(go(m, "r0c0", "W"), Step("r0c0", -0.5));  // who stays does not enter
  EXPECT_EQ(go(m, "r0c1", "E"), Step("r0c2", -0.5));
  EXPECT_EQ(go(m, "r1c0", "E"), Step("r1c1", 2.5));
  EXPECT_TRUE(m.terminal(*m.find_state("r0c2")));
  EXPECT_EQ(m.start().size(), 4u);  // no S: every cell that is no end
  EXPECT_EQ(m.states(), 6u);        // a blank is free
}

TEST(Grid, ALineWithEqualsMayBelongToThePicture) {
  const Mdp m = model("reward.= = 1\n#=..\n#==G\n");
  EXPECT_EQ(m.states(), 6u);
}

TEST(Grid, SlippingSharesItsProbabilityBetweenTheSides) {
  // ...   From the middle (r1c1) N: up 0.8, left (W) 0.1, right (E) 0.1.
  // ..A   From r1c1 E enters A with -1 + 5 by 0.8, and as a slip of N by 0.1.
  // ..G   From the corner r0c0 N: blocked 0.8 and W blocked 0.1 -> stays 0.9; E 0.1.
  const Mdp m = model("slip = 0.2\nreward.A = 5\n...\n..A\n..G\n");
  const State middle = *m.find_state("r1c1");
  const std::uint64_t north = m.choice_begin(middle);
  ASSERT_EQ(m.outcome_end(north) - m.outcome_begin(north), 3u);
  std::uint64_t o = m.outcome_begin(north);
  EXPECT_EQ(m.state_name(m.next(o)), "r0c1");
  EXPECT_DOUBLE_EQ(m.probability(o), 0.8);
  EXPECT_EQ(m.state_name(m.next(o + 1)), "r1c0");
  EXPECT_DOUBLE_EQ(m.probability(o + 1), 0.1);
  EXPECT_EQ(m.state_name(m.next(o + 2)), "r1c2");
  EXPECT_DOUBLE_EQ(m.probability(o + 2), 0.1);
  EXPECT_EQ(m.reward(north, o + 2), 4.0);
  EXPECT_DOUBLE_EQ(m.reward(north), -0.5);  // 0.9 * -1 + 0.1 * 4
  o = m.outcome_begin(0);
  ASSERT_EQ(m.outcome_end(0) - o, 2u);
  EXPECT_EQ(m.next(o), 0u);
  EXPECT_DOUBLE_EQ(m.probability(o), 0.9);
  EXPECT_EQ(m.state_name(m.next(o + 1)), "r0c1");
}

TEST(Grid, EightMovesDoNotCutCorners) {
  // .#.   NE from r1c0 would pass the corner of the wall: it stays. SE from r1c0 is free.
  // ..G
  // ...
  const Mdp m = model("moves = 8\n.#.\n..G\n...\n");
  EXPECT_EQ(m.actions(0), 8u);
  EXPECT_EQ(go(m, "r0c0", "SE"), Step("r0c0", -1));
  EXPECT_EQ(go(m, "r1c0", "NE"), Step("r1c0", -1));
  EXPECT_EQ(go(m, "r1c0", "SE"), Step("r2c1", -1));
  EXPECT_EQ(go(m, "r1c1", "NE"), Step("r1c1", -1));
  EXPECT_EQ(go(m, "r2c1", "NE"), Step("r1c2", -1));
  EXPECT_EQ(go(m, "r2c1", "NW"), Step("r1c0", -1));
  EXPECT_EQ(go(m, "r1c1", "SW"), Step("r2c0", -1));
}

TEST(Grid, TheSidesOfEightMovesAreTheNextDirections) {
  const Mdp m = model("moves = 8\nslip = 0.5\n...\n...\n..G\n");
  const State middle = *m.find_state("r1c1");
  const std::vector<std::vector<std::string>> expected = {{"r0c1", "r0c0", "r0c2"},   // N: NW, NE
                                                          {"r1c2", "r0c2", "r2c2"},   // E: NE, SE
                                                          {"r2c1", "r2c2", "r2c0"},   // S: SE, SW
                                                          {"r1c0", "r2c0", "r0c0"},   // W: SW, NW
                                                          {"r0c2", "r0c1", "r1c2"},   // NE: N, E
                                                          {"r2c2", "r1c2", "r2c1"},   // SE: E, S
                                                          {"r2c0", "r2c1", "r1c0"},   // SW: S, W
                                                          {"r0c0", "r1c0", "r0c1"}};  // NW: W, N
  for (std::uint64_t a = 0; a < 8; ++a) {
    const std::uint64_t c = m.choice_begin(middle) + a;
    std::vector<std::string> found;
    for (std::uint64_t o = m.outcome_begin(c); o < m.outcome_end(c); ++o) {
      found.push_back(m.state_name(m.next(o)));
    }
    EXPECT_EQ(found, expected[a]) << m.action_name(c);
  }
}

TEST(Grid, SaysWhereAndWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "g.txt: expected a picture of the grid, with # . S G P"},
      {"slip = 0.1\nmap\n", "g.txt: expected a picture of the grid, with # . S G P"},
      {"S..\n..\n..G\n", "g.txt:2:3: expected 3 letters as in the first row, found 2"},
      {"S..\n....\n..G\n", "g.txt:2:4: expected 3 letters as in the first row, found 4"},
      {"slip = 0\n\nmap\nS..\n.x.\n..G\n",
       "g.txt:5:2: letter 'x' is not known; use # . S G P or add 'reward.x = ...'"},
      {"S.\t\n..G\n", "g.txt:1:3: letter 'byte 9' is not known; use # . S G P"},
      {"###\n#G#\n", "g.txt: expected at least one cell that is no wall or end"},
      {"S.\xc3\xa9\n..G\n", "g.txt:1:3: letter '\xc3\xa9' is not known; use # . S G P"},
      {"slp = 0.1\nSG\n",
       "g.txt:1:1: expected moves, slip, move_reward, discount, terminal or reward.LETTER, found "
       "'slp'; did you mean 'slip'?"},
      {"slip = 1.5\nSG\n", "g.txt:1:7: expected a slip from 0 to 1"},
      {"moves = 6\nSG\n", "g.txt:1:8: expected moves = 4 or 8"},
      {"move_reward = free\nSG\n", "g.txt:1:14: expected a number for move_reward"},
      {"reward.# = 2\nSG\n", "g.txt:1:1: expected no reward for walls"},
      {"slip = 0\nslip = 0.5\nSG\n", "g.txt:2:1: expected one 'slip', found a second"},
      {"terminal = GS\nSG\n", "g.txt: expected no 'S' among the letters of ends"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(refusal(text), expected) << text;
  EXPECT_NE(refusal("discount = 0\nSG\n"), "accepted");
  EXPECT_NE(refusal("reward.A = nan\nSAG\n"), "accepted");
}

// Whether total reward is defined without an end depends on the discount asked for, which a reader
// does not know.
TEST(Grid, ReadsAPictureWithoutAnEnd) {
  const Mdp m = model("S..\n...\n");
  EXPECT_EQ(m.states(), 6u);
  EXPECT_EQ(m.discount(), 1.0);
  const std::vector<Finding> findings = check(m);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().kind, "no-end");
}

TEST(Grid, WritesWhatItReads) {
  for (const std::string text :
       {"S.#\n.PG\n", "slip = 0.2\nreward.A = 5\n...\n..A\n..G\n",
        "slip = 0.1\nmove_reward = -0.04\nreward.G = 1\nreward.P = -1\nS..G\n.#.P\n....\n",
        "moves = 8\nslip = 1\n#.#\n...\n..G\n", "moves = 8\nslip = 0.3\n.........G\n",
        "discount = 0.99\nmove_reward = 0\nreward.S = 0.3\nreward.B = 0.1\nterminal = B\n"
        "S..B\n##.#\nS.#G\n",
        "slip = 0.3\n#.#\n#.#\n#G#\n", "discount = 0.5\nterminal =\nreward.A = 1\n.A\n..\n",
        "move_reward = 0.1\nreward.A = 0.2\nreward.B = 1e-9\nA.B\n..G\n"}) {
    const Mdp m = model(text);
    const auto written = write_grid(m);
    ASSERT_TRUE(written) << text << message(written.error());
    EXPECT_EQ(digest(model(*written)), digest(m)) << text << *written;
    EXPECT_NE(written->find("map\n"), std::string::npos);
  }
}

TEST(Grid, RefusesToWriteWhatIsNoGrid) {
  const auto reason = [](const Mdp& m) {
    const auto written = write_grid(m);
    return written ? "written" : message(written.error());
  };
  const std::string start = "this model cannot be written as a grid: ";
  EXPECT_EQ(
      reason(*parse_model("state,action,next_state,probability,reward\nA,go,B,1,0\n", "a.csv")),
      start + "its states are no cells");
  const Mdp m = model("S..\n..G\n");
  const auto changed = [&](auto change) {
    MdpArrays arrays = m.arrays();
    change(arrays);
    return reason(*Mdp::make(std::move(arrays)));
  };
  EXPECT_EQ(changed([](MdpArrays&) {}), "written");
  EXPECT_EQ(changed([](MdpArrays& a) { a.reward[1] = 7; }),
            start + "moves into state r0c1 have different rewards");
  EXPECT_EQ(changed([](MdpArrays& a) { a.reward[0] = 7; }),
            start + "its rewards are not those of cells");
  EXPECT_EQ(changed([](MdpArrays& a) { a.next[1] = 3; }), start + "its moves lead elsewhere");
  EXPECT_EQ(changed([](MdpArrays& a) { a.layout->cell = {0, 1, 1, 3, 4, 5}; }),
            start + "its cells are not in reading order");
  EXPECT_EQ(changed([](MdpArrays& a) { a.state_names = Names::numbered("s", 6); }),
            start + "its states have names of their own");
  EXPECT_EQ(changed([](MdpArrays& a) {
              a.start = {0, 1};
              a.start_probability = {0.25, 0.75};
            }),
            start + "its starts are not equally likely");
}

TEST(Grid, AMazeIsReadBackFromItsText) {
  const Grid maze = make_maze({.size = 40, .seed = 3, .braid = 0.5});
  const auto direct = to_mdp(maze);
  ASSERT_TRUE(direct);
  EXPECT_EQ(digest(model(to_text(maze))), digest(*direct));
  EXPECT_EQ(digest(model(*write_grid(*direct))), digest(*direct));
}

TEST(Grid, ErrorsOfAGridMadeInCodeNameTheRow) {
  Grid grid;
  grid.rows = {"S.", "?G"};
  EXPECT_EQ(message(to_mdp(grid).error()),
            "grid:2:1: letter '?' is not known; use # . S G P or add 'reward.? = ...'");
  grid.rows = {"SG"};
  grid.moves = 5;
  EXPECT_EQ(message(to_mdp(grid).error()), "grid: expected 4 or 8 moves");
}

}  // namespace
}  // namespace quoll
