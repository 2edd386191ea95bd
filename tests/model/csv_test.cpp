#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

const std::string header = "state,action,next_state,probability,reward\n";

Mdp model(const std::string& text) {
  auto mdp = parse_model(text, "world.csv");
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *std::move(mdp);
}

std::string refusal(const std::string& text) {
  const auto mdp = parse_model(text, "w.csv");
  return mdp ? "accepted" : message(mdp.error());
}

TEST(Csv, ReadsRowsIntoArrays) {
  // A: go -> B (0.25, reward 4), C (0.75, reward 8); stay -> A. B: go -> C. C is only a successor.
  const Mdp m = model(header + "A,go,B,0.25,4\nA,go,C,0.75,8\nA,stay,A,1,-1\nB,go,C,1,2.5\n");
  ASSERT_EQ(m.states(), 3u);
  EXPECT_EQ(m.state_name(0), "A");
  EXPECT_EQ(m.state_name(1), "B");
  EXPECT_EQ(m.state_name(2), "C");
  EXPECT_EQ(m.choices(), 3u);
  EXPECT_EQ(m.action_name(0), "go");
  EXPECT_EQ(m.action_name(1), "stay");
  EXPECT_DOUBLE_EQ(m.reward(0), 7.0);  // 0.25 * 4 + 0.75 * 8
  EXPECT_EQ(m.reward(0, 1), 8.0);
  EXPECT_EQ(m.next(1), 2u);
  EXPECT_EQ(m.probability(1), 0.75);
  EXPECT_EQ(m.reward(2), 2.5);
  EXPECT_TRUE(m.terminal(2));
  EXPECT_FALSE(m.deterministic());
  EXPECT_EQ(m.discount(), 0.95);
  EXPECT_EQ(std::vector<State>(m.start().begin(), m.start().end()), (std::vector<State>{0, 1}));
}

TEST(Csv, OneOutcomePerChoiceIsDeterministicAndCompact) {
  const Mdp m = model(header + "A,go,B,1,0\nB,go,A,1,1\nB,on,END,1.0,1\n");
  EXPECT_TRUE(m.deterministic());
  EXPECT_TRUE(m.arrays().probability.empty());
  EXPECT_TRUE(m.arrays().outcome_begin.empty());
  EXPECT_TRUE(m.arrays().outcome_reward.empty());
}

TEST(Csv, StatesStandInOrderOfTheirRowsAndEndsLast) {
  // END and Z are met first as successors; Z has rows, END and LAST have none.
  const Mdp m = model(header + "A,go,END,1,0\nM,go,Z,1,0\nZ,go,LAST,1,0\nB,go,A,1,0\n");
  std::string order;
  for (State s = 0; s < m.states(); ++s) order += m.state_name(s) + " ";
  EXPECT_EQ(order, "A M Z B END LAST ");
  EXPECT_EQ(m.next(0), 4u);
  EXPECT_EQ(m.next(1), 2u);
}

TEST(Csv, ARowWithoutActionDeclaresAState) {
  const Mdp m = model(header + "END,,,,\nA,go,END,1,5\n");
  EXPECT_EQ(m.state_name(0), "END");
  EXPECT_TRUE(m.terminal(0));
  EXPECT_EQ(m.next(0), 0u);
}

TEST(Csv, TakesColumnsInAnyOrderQuotesBlanksCrlfAndByteOrderMark) {
  const Mdp plain = model("# discount = 0.5\n" + header +
                          "\"A, the first\",\"say \"\"hi\"\"\",B,1,2\nB,go,B,1,-0.5\n");
  EXPECT_EQ(plain.state_name(0), "A, the first");
  const Mdp other = model(
      "\xEF\xBB\xBF# discount = 0.5\r\n\r\n reward, probability ,next_state,\"action\",state\r\n"
      "2, 1 ,B,\"say \"\"hi\"\"\" ,\"A, the first\"\r\n\r\n,,,,\r\n -5e-1 ,2/2,B,go, B \r\n");
  EXPECT_EQ(digest(other), digest(plain));
  EXPECT_EQ(other.action_name(0), "say \"hi\"");
  EXPECT_EQ(other.state_name(1), "B");
  EXPECT_EQ(other.reward(1), -0.5);
}

TEST(Csv, TakesProperties) {
  const Mdp m = model(
      "# A world for a test: start = nowhere is no property here\n"
      "#discount=0.75\n# start = B:3, \"A\":1\n# start = \"C D\":4\n# terminal = B\n"
      "# actions = on go\n" +
      header + "A,go,B,1,0\nB,on,A,1,0\nC D,go,A,1,0\n");
  EXPECT_EQ(m.discount(), 0.75);
  ASSERT_EQ(m.start().size(), 3u);
  EXPECT_EQ(m.start_probability(0), 0.125);  // A: 1 of 8
  EXPECT_EQ(m.start_probability(1), 0.375);
  EXPECT_EQ(m.start_probability(2), 0.5);
  EXPECT_TRUE(m.terminal(1));
  EXPECT_EQ(m.actions(1), 1u);
  EXPECT_EQ(m.arrays().action_names[0], "on");
}

TEST(Csv, AColonOutsideQuotesMayBelongToTheName) {
  const Mdp m = model("# start = A:2\n" + header + "A:2,go,B,1,0\nA,go,B,1,0\n");
  ASSERT_EQ(m.start().size(), 1u);
  EXPECT_EQ(m.state_name(m.start()[0]), "A:2");
}

TEST(Csv, InterleavedRowsGiveTheSameModel) {
  const Mdp grouped = model(header +
                            "A,x,A,0.5,1\nA,x,B,0.5,2\nA,y,C,1,3\n"
                            "B,y,A,0.25,1\nB,y,C,0.75,1\nC,x,END,1,7\n");
  const Mdp mixed = model(header +
                          "A,x,A,0.5,1\nB,y,A,0.25,1\nA,y,C,1,3\nA,x,B,0.5,2\nC,x,END,1,7\n"
                          "B,y,C,0.75,1\n");
  EXPECT_EQ(digest(mixed), digest(grouped));
}

TEST(Csv, StatesMayBeDeclaredAgain) {
  EXPECT_NE(refusal(header + "A,,,,\nB,,,,\nA,,,,\n"), "accepted");  // nowhere to start
  const Mdp m = model(header + "A,,,,\nB,,,,\nA,,,,\nB,go,A,1,0\n");
  EXPECT_EQ(m.actions(0), 0u);
  EXPECT_EQ(m.actions(1), 1u);
}

TEST(Csv, AnActionOpenedAgainKeepsItsFirstPlace) {
  const Mdp m = model(header + "A,x,A,0.5,1\nA,y,B,1,3\nA,x,B,0.5,1\n");
  ASSERT_EQ(m.choices(), 2u);
  EXPECT_EQ(m.action_name(0), "x");
  EXPECT_EQ(m.outcome_end(0), 2u);
  EXPECT_EQ(m.next(1), 1u);
  EXPECT_EQ(m.reward(0), 1.0);
  EXPECT_TRUE(m.arrays().outcome_reward.empty());
}

// Random rows in random order against a model built with maps.
TEST(Csv, AnyOrderOfRowsAgreesWithASimpleReader) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng dice = stream(seed, "csv-test");
    const std::uint32_t states = 1 + dice.below(12);
    std::vector<std::array<std::uint32_t, 3>> rows;  // state, action, reward
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sizes;
    const std::uint32_t count = 1 + dice.below(60);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t s = dice.below(states);
      const std::uint32_t a = dice.below(3);
      rows.push_back({s, a, dice.below(2)});
      ++sizes[{s, a}];
    }
    if (seed % 2 == 0) std::sort(rows.begin(), rows.end());
    std::string text = header;
    std::map<std::string, std::vector<std::pair<std::string, double>>> expected;
    std::map<std::uint32_t, std::vector<std::uint32_t>> action_order;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto [s, a, r] = rows[i];
      const std::string state = "a long name of state " + std::to_string(s);
      const std::string next = "n" + std::to_string(i);
      text += state + ",a" + std::to_string(a) + "," + next + ",1/" +
              std::to_string(sizes[{s, a}]) + "," + std::to_string(r) + "\n";
      expected[state + " a" + std::to_string(a)].emplace_back(next, r);
      auto& order = action_order[s];
      if (std::find(order.begin(), order.end(), a) == order.end()) order.push_back(a);
    }
    const Mdp m = model(text);
    EXPECT_EQ(m.choices(), expected.size());
    EXPECT_EQ(m.outcomes(), rows.size());
    for (State s = 0; s < m.states(); ++s) {
      for (std::uint64_t c = m.choice_begin(s); c < m.choice_end(s); ++c) {
        const auto& outcomes = expected[m.state_name(s) + " " + m.action_name(c)];
        ASSERT_EQ(m.outcome_end(c) - m.outcome_begin(c), outcomes.size());
        for (std::uint64_t o = m.outcome_begin(c); o < m.outcome_end(c); ++o) {
          const auto& [next, reward] = outcomes[o - m.outcome_begin(c)];
          EXPECT_EQ(m.state_name(m.next(o)), next);
          EXPECT_EQ(m.reward(c, o), reward);
          EXPECT_EQ(m.probability(o), 1.0 / static_cast<double>(outcomes.size()));
        }
        const auto number = static_cast<std::uint32_t>(std::stoul(m.state_name(s).substr(21)));
        EXPECT_EQ(m.action_name(c),
                  "a" + std::to_string(action_order[number][c - m.choice_begin(s)]));
      }
    }
  }
}

TEST(Csv, NumbersHaveTheBitsOfTheGeneralReader) {
  for (const char* text :
       {"0.1", "-0.3", "123456789012345", "0.000000000000001", "99999.9999999999", "5", ".5", "5.",
        "-0", "1e-3", "0.1234567890123456789", "2/3"}) {
    const Mdp m = model(header + "A,go,B,1," + text + "\n");
    double expected = std::strtod(text, nullptr);
    if (std::string(text) == "2/3") expected = 2.0 / 3.0;
    EXPECT_EQ(m.reward(0), expected) << text;
  }
}

TEST(Csv, WritesWhatItReads) {
  const std::string text =
      "# discount = 0.1\n# start = \"A B\":0.3 C:0.7\n# terminal = C\n# actions = later first\n" +
      header +
      "END,,,,\n\"A \"\"q\"\"\",first,END,0.1,0.1\n\"A \"\"q\"\"\",first,C,0.9,1e+30\n"
      "A B,later,C,1,-0.25\nC,first,C,1,3\n";
  const Mdp m = model(text);
  const auto written = write_csv(m);
  ASSERT_TRUE(written) << message(written.error());
  const Mdp again = model(*written);
  EXPECT_EQ(digest(again), digest(m));
  EXPECT_EQ(*write_csv(again), *written);
  EXPECT_NE(written->find("# start = \"A B\":0.3 C:0.7\n"), std::string::npos) << *written;
  EXPECT_NE(written->find("# actions = later first\n"), std::string::npos);
  EXPECT_NE(written->find("\"A \"\"q\"\"\",first,C,0.9,1e+30\n"), std::string::npos);
}

TEST(Csv, ManyStartsGoOverSeveralLines) {
  std::string text = "# start =";
  std::string rows = header;
  for (int i = 0; i < 50; ++i) {
    text += " s" + std::to_string(2 * i);
    rows += "s" + std::to_string(2 * i) + ",go,END,1,0\ns" + std::to_string(2 * i + 1) +
            ",go,END,1,0\n";
  }
  const Mdp m = model(text + "\n" + rows);
  EXPECT_EQ(m.start().size(), 50u);
  EXPECT_EQ(digest(model(*write_csv(m))), digest(m));
}

TEST(Csv, SaysWhereAndWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "w.csv: expected the header line state,action,next_state,probability,reward"},
      {"A,go,B,1,0\n",
       "w.csv:1:1: expected the header line state,action,next_state,probability,reward, found "
       "'A,go,B,1,0'"},
      {"state,action,next_state,probabilty,reward\n",
       "w.csv:1:25: expected only the columns state,action,next_state,probability,reward, found "
       "'probabilty'; did you mean 'probability'?"},
      {"state,action,next_state,probability,reward,colour\n",
       "w.csv:1:44: expected only the columns state,action,next_state,probability,reward, found "
       "'colour'"},
      {"state,action,next_state,reward\n", "w.csv:1: expected a column 'probability'"},
      {"state,action,state\n", "w.csv:1:14: expected one column 'state'"},
      {header, "w.csv:1: expected at least one row below the header"},
      {header + "A,go,B,1\n", "w.csv:2: expected 5 fields as in the header, found 4"},
      {header + "A,go,B,1,0,9\n", "w.csv:2: expected 5 fields as in the header, found 6"},
      {header + "A,go,B,1,0\n,go,B,1,0\n", "w.csv:3:1: expected a state"},
      {header + "A,,B,1,0\n", "w.csv:2:3: expected an action"},
      {header + "A,go,,1,0\n", "w.csv:2:6: expected a next state"},
      {header + "A,,,1,\n", "w.csv:2:5: expected nothing more in a row that only names a state"},
      {header + "A,go,B,half,0\n",
       "w.csv:2:8: expected a number for the probability, found 'half'"},
      {header + "A,go,B,1, 1.2.3\n", "w.csv:2:11: expected a number for the reward, found '1.2.3'"},
      {header + "A,go,B,1,\n", "w.csv:2:10: expected a number for the reward, found ''"},
      {header + "\"A,go,B,1,0\n", "w.csv:2:1: expected a field in quotes that ends on its line"},
      {header + "\"A\"x,go,B,1,0\n", "w.csv:2:4: expected a field in quotes that ends on its line"},
      {header + "A,go,B\x01,1,0\n", "w.csv:2:6: expected a name without control characters"},
      {header + "A,go,caf\xe9,1,0\n", "w.csv:2:6: expected a name in UTF-8"},
      {"# actions = \"\"\n" + header + "A,go,B,1,0\n",
       "w.csv:1:13: expected a name that is not empty"},
      {"# discuont = 0.9\n" + header,
       "w.csv:1:3: expected discount, alternating, start, terminal or actions, found 'discuont'; "
       "did you mean 'discount'?"},
      {"# discount = high\n" + header, "w.csv:1:13: expected a number after 'discount ='"},
      {"# discount = 0.9\n# discount = 0.8\n" + header,
       "w.csv:2:3: expected one discount, found a second"},
      {"# start = HAL\n" + header + "HALL,go,B,1,0\n",
       "w.csv:1:11: expected a state that the rows name, found 'HAL'; did you mean 'HALL'?"},
      {"# start = A:0\n" + header + "A,go,B,1,0\n", "w.csv:1:11: expected a weight above 0"},
      {"# start = A:1 B\n" + header + "A,go,B,1,0\n",
       "w.csv:1:15: expected a weight for each start state or for none"},
      {"# terminal = \"A\n" + header, "w.csv:1:14: expected a closing quote"},
      {"# terminal = \"A\"B\n" + header,
       "w.csv:1:17: expected a blank or :WEIGHT behind the quote"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(refusal(text), expected) << text;
}

TEST(Csv, WhatOnlyTheModelKnowsHasItsLine) {
  EXPECT_NE(refusal(header + "A,go,B,1,0\nB,go,A,0.9,0\n").find("w.csv:3"), std::string::npos);
  EXPECT_NE(refusal("# discount = 2\n" + header + "A,go,B,1,0\n"), "accepted");
  EXPECT_NE(refusal(header + "A,go,B,1,nan\n"), "accepted");
}

class CsvFile : public ::testing::Test {
 protected:
  std::string path_ =
      ::testing::TempDir() + "quoll_csv_file_test-" + std::to_string(getpid()) + ".csv";
  void write(const std::string& text) { std::ofstream(path_, std::ios::binary) << text; }
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(CsvFile, AFileInBlocksGivesTheModelOfItsText) {
  // About 5 MB: several blocks of 2 MiB, whose borders cut rows and names.
  std::string text = "# discount = 0.9\n" + header;
  Rng dice = stream(3, "csv-test");
  for (int i = 0; i < 120000; ++i) {
    text += "state" + std::to_string(i) + ",a,state" + std::to_string(dice.below(120000)) +
            ",0.5," + std::to_string(dice.below(1000)) + ".5\n";
    text += "state" + std::to_string(i) + ",a,\"long, long name of a state " +
            std::to_string(dice.below(1000)) + "\",0.5,1\r\n";
  }
  ASSERT_GT(text.size(), 5'000'000u);
  text.pop_back();
  text.pop_back();  // the last line has no end
  write(text);
  const auto from_file = read_model(path_);
  ASSERT_TRUE(from_file) << message(from_file.error());
  EXPECT_EQ(digest(*from_file), digest(model(text)));
  EXPECT_EQ(from_file->outcomes(), 240000u);
}

TEST_F(CsvFile, RefusesEndlessLinesAndWhatIsNoFile) {
  write(header + std::string(3 << 20, 'x'));
  EXPECT_EQ(message(read_csv_path(path_, {}).error()),
            path_ + ":2: expected a line of at most 1 MiB, found a longer one");
  const std::string folder = ::testing::TempDir();
  EXPECT_NE(message(read_csv_path(folder, {}).error()).find("this is a folder"), std::string::npos);
  EXPECT_NE(message(read_csv_path(path_ + ".none", {}).error()).find("No such file"),
            std::string::npos);
}

TEST(Csv, RefusesToWriteNamesItCannotHold) {
  MdpArrays arrays;
  arrays.choice_begin = {0, 1, 1};
  arrays.next = {1};
  arrays.reward = {0};
  arrays.action = {0};
  arrays.action_names.push_back("go");
  arrays.state_names.push_back("line\nbreak");
  arrays.state_names.push_back("end");
  const auto mdp = Mdp::make(std::move(arrays));
  ASSERT_TRUE(mdp);
  const auto text = write_csv(*mdp);
  ASSERT_FALSE(text);
  EXPECT_EQ(message(text.error()), "name of state 0: expected a name without control characters");
}

}  // namespace
}  // namespace quoll
