#include "quoll/model/formats/prism.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "quoll/model/digest.hpp"

namespace quoll {
namespace {

using Kind = PrismPart::Kind;

std::string refusal(const std::string& text) {
  const auto mdp = parse_model(text, "w.tra");
  return mdp ? "accepted" : message(mdp.error());
}

Mdp made(Result<MdpArrays> arrays) {
  if (!arrays) {
    ADD_FAILURE() << message(arrays.error());
    std::abort();
  }
  auto mdp = Mdp::make(*std::move(arrays));
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *std::move(mdp);
}

struct Text {
  Kind kind;
  std::string name, content;
};

Result<MdpArrays> parse(const std::string& transitions, const std::vector<Text>& texts) {
  std::vector<PrismPart> parts;
  for (const Text& text : texts) {
    parts.push_back({text.kind, "part", text.name, Lines(text.content)});
  }
  Lines lines(transitions);
  return read_prism_parts(lines, "w.tra", parts);
}

std::string part_refusal(const std::string& transitions, Kind kind, const std::string& content) {
  const auto arrays = parse(transitions, {{kind, "", content}});
  return arrays ? "accepted" : message(arrays.error());
}

// State 0 goes to 1 or 2 for half, or stays; 1 goes to 2; 2 has no choice.
const std::string three = "3 3 4\n0 0 1 0.5 go\n0 0 2 0.5 go\n0 1 0 1\n1 0 2 1/1 go\n";

TEST(Prism, ReadsTransitions) {
  const Mdp m = made(parse(three, {}));
  EXPECT_EQ(m.states(), 3u);
  EXPECT_EQ(m.choices(), 3u);
  EXPECT_EQ(m.action_name(0), "go");
  EXPECT_EQ(m.action_name(1), "1");  // no name: its number
  EXPECT_EQ(m.next(1), 2u);
  EXPECT_EQ(m.probability(1), 0.5);
  EXPECT_TRUE(m.terminal(2));
  EXPECT_EQ(m.discount(), 1.0);
  EXPECT_EQ(m.state_name(2), "2");
  EXPECT_EQ(std::vector<State>(m.start().begin(), m.start().end()), std::vector<State>{0});
}

TEST(Prism, TakesBothHeadersChainsAndAnyOrder) {
  const std::uint64_t wanted = digest(made(parse(three, {})));
  const std::string rows = three.substr(three.find('\n') + 1);
  EXPECT_EQ(digest(made(parse("mdp\n" + rows, {}))), wanted);
  EXPECT_EQ(digest(made(parse("# a comment\n\n3\t3 4\r\n" + rows, {}))), wanted);
  EXPECT_EQ(digest(made(parse("3 3 4\n1 0 2 1 go\n0 1 0 1\n0 0 1 0.5 go\n0 0 2 0.5 go\n", {}))),
            wanted);
  const Mdp chain = made(parse("3 3\n0 1 0.5\n0 2 0.5\n1 2 1\n", {}));
  EXPECT_EQ(chain.choices(), 2u);
  EXPECT_EQ(digest(chain), digest(made(parse("dtmc\n0 1 0.5\n0 2 0.5\n1 2 1\n", {}))));
}

TEST(Prism, ChoicesOfOneNameAreToldApart) {
  const auto arrays = parse("1 3 3\n0 0 0 1 go\n0 1 0 1 go\n0 2 0 1 go\n", {});
  ASSERT_TRUE(arrays);
  ASSERT_EQ(arrays->remarks.size(), 1u);
  EXPECT_EQ(arrays->remarks[0],
            "state 0 has two choices called go: the second is go.1, and so wherever names are not "
            "different");
  const Mdp m = made(*arrays);
  EXPECT_EQ(m.action_name(0), "go");
  EXPECT_EQ(m.action_name(1), "go.1");
  EXPECT_EQ(m.action_name(2), "go.2");
}

TEST(Prism, RefusesWithThePlace) {
  EXPECT_EQ(refusal(""), "w.tra: expected a first line 'states choices transitions', or 'mdp'");
  EXPECT_EQ(refusal("mpd\n"),
            "w.tra:1:1: expected 'mdp', 'dtmc' or 'states choices transitions', found 'mpd'; did "
            "you mean 'mdp'?");
  EXPECT_EQ(refusal("ctmc\n0 1 3.5\n"),
            "w.tra:1:1: expected 'mdp', 'dtmc' or 'states choices transitions', found 'ctmc'; did "
            "you mean 'dtmc'?");
  EXPECT_EQ(refusal("1 2 3 4\n"),
            "w.tra:1:1: expected 'states choices transitions' of an MDP or 'states transitions' of "
            "a DTMC, found 4 words");
  EXPECT_EQ(refusal("1099511627776 1 1\n0 0 0 1\n"),
            "w.tra:1:1: expected a number of states that the 2 lines of this file can hold, found "
            "1099511627776");
  EXPECT_EQ(refusal("mdp\n0 0 999999999 1\n"),
            "w.tra:2:5: expected the number of a successor below 65544, found '999999999'");
  EXPECT_EQ(refusal("2 1 1\n0 0 2 1\n"),
            "w.tra:2:5: expected the number of a successor below 2, found '2'");
  EXPECT_EQ(refusal("2 1 1\n0 0 1\n"),
            "w.tra:2:1: expected 'state choice successor probability' and perhaps an action, found "
            "3 words");
  EXPECT_EQ(refusal("2 1 1\n0 0 1 x\n"), "w.tra:2:7: expected a probability, found 'x'");
  EXPECT_EQ(refusal("2 1 1\n0 0 1 [0.1,0.9]\n"),
            "w.tra:2:7: expected a probability, found an interval: models of intervals cannot be "
            "read");
  EXPECT_EQ(refusal("2 1 1\n0 1 1 1\n"), "w.tra:2: expected choice 0 of state 0, found choice 1");
  EXPECT_EQ(refusal("2 1 2\n0 0 0 0.5 a\n0 0 1 0.5 b\n"),
            "w.tra:3: expected action 'a' as above for choice 0 of state 0, found 'b'");
  EXPECT_EQ(refusal("2 1 2\n0 0 1 1\n"),
            "w.tra:1: expected 2 transitions as this line says, found 1");
  EXPECT_EQ(refusal("2 2 1\n0 0 1 1\n"), "w.tra:1: expected 2 choices as this line says, found 1");
  EXPECT_EQ(refusal("2 0 0\n"), "w.tra:1: expected at least one transition");
}

TEST(Prism, RefusesRowsThatAreNoProbabilities) {
  EXPECT_EQ(refusal("2 1 2\n0 0 0 0.4999996\n0 0 1 0.4999996\n"),
            "w.tra:2: state 0, action 0: probabilities sum to 0.9999992, expected 1");
  EXPECT_EQ(refusal("2 1 2\n0 0 0 -0.5\n0 0 1 1.5\n"),
            "w.tra:2: state 0, action 0: probability -0.5 is outside [0, 1]");
  EXPECT_EQ(refusal("2 1 1\n0 0 1 nan\n"),
            "w.tra:2: state 0, action 0: probability nan is outside [0, 1]");
}

TEST(Prism, NamesComeFromTheValuesOfVariables) {
  const Mdp m = made(parse(three, {{Kind::states, "", "(x,y)\n0:(1,2)\n1:(1,true)\n2:(-3,0)\n"}}));
  EXPECT_EQ(m.state_name(1), "(x=1,y=true)");
  EXPECT_EQ(m.state_name(2), "(x=-3,y=0)");
  const Mdp plain =
      made(parse(three, {{Kind::states, "", "(name)\n0:(A (1), b)\n1:(B)\n2:(C)\n"}}));
  EXPECT_EQ(plain.state_name(0), "A (1), b");
  EXPECT_EQ(part_refusal(three, Kind::states, "(x)\n0:(1)\n2:(2)\n"),
            "part:3:1: expected state 1, found 2");
  EXPECT_EQ(part_refusal(three, Kind::states, "(x)\n0:(1)\n1:(2)\n"),
            "part:3: expected the values of 3 states, found 2");
  EXPECT_EQ(part_refusal(three, Kind::states, "(x)\n0:(1,2)\n"),
            "part:2:1: expected 1 value, found 2");
}

TEST(Prism, LabelsInBothDialects) {
  for (const std::string text :
       {"0=\"init\" 1=\"deadlock\" 2=\"my goal\" 3=\"odd\"\n1: 0 3\n2: 2\n",
        "#DECLARATION\ninit deadlock\nmy_goal odd\n#END\n1 init odd\n2 my_goal\n"}) {
    const Mdp m = made(parse(three, {{Kind::labels, "", text}}));
    ASSERT_EQ(m.arrays().labels.size(), 2u) << text;  // init is the start, deadlock is empty
    EXPECT_EQ(m.start()[0], 1u);
    EXPECT_EQ(m.arrays().labels[0].states, std::vector<State>{2});
    EXPECT_EQ(m.find_label("odd")->states, std::vector<State>{1});
  }
  EXPECT_EQ(part_refusal(three, Kind::labels, "0=\"init\"\n0: 1\n"),
            "part:2: expected a label declared above, found '1'");
  EXPECT_EQ(part_refusal(three, Kind::labels, "#DECLARATION\ninit goal\n#END\n2 gaol\n"),
            "part:4: expected a label declared above, found 'gaol'; did you mean 'goal'?");
  EXPECT_EQ(part_refusal(three, Kind::labels, "0=\"init\"\n3: 0\n"),
            "part:2:1: expected the number of a state below 3, found '3'");
  EXPECT_EQ(part_refusal(three, Kind::labels, "init\n"),
            "part:1: expected labels, as in 0=\"init\" 1=\"goal\"");
}

TEST(Prism, RewardsOfStatesAndTransitionsAreAdded) {
  // With 2 in state 0 and 10 on 0 -> 2: choice 0 of state 0 gives 2 or 12, mean 7; choice 1
  // gives 2.
  const std::string states = "# Reward structure: \"gold\"\n# State rewards\n3 2\n0 2\n2 5\n";
  const std::string moves = "# Reward structure: \"gold\"\n# Transition rewards\n3 3 1\n0 0 2 10\n";
  const auto arrays = parse(
      three,
      {{Kind::rewards, "a", states}, {Kind::rewards, "b", moves}, {Kind::rewards, "t", "1 4\n"}});
  ASSERT_TRUE(arrays) << message(arrays.error());
  EXPECT_EQ(arrays->remarks,
            (std::vector<std::string>{
                "the rewards gold of states are part of every choice of their state",
                "the rewards gold of states without a choice, as of 2, count for nothing",
                "the rewards t of states are part of every choice of their state"}));
  const Mdp m = made(*arrays);
  EXPECT_EQ(m.arrays().reward_name, "gold");
  EXPECT_EQ(m.reward(0), 7.0);
  EXPECT_EQ(m.reward(0, 1), 12.0);
  EXPECT_EQ(m.reward(1), 2.0);
  EXPECT_EQ(m.reward(2), 0.0);
  ASSERT_NE(m.find_rewards("t"), nullptr);
  EXPECT_EQ(m.find_rewards("t")->reward, (std::vector<double>{0, 0, 4}));
}

TEST(Prism, RefusesRewardsWithThePlace) {
  EXPECT_EQ(part_refusal(three, Kind::rewards, "3 1\n0 nan\n"),
            "part:2:3: expected a finite reward, found 'nan'");
  EXPECT_EQ(part_refusal(three, Kind::rewards, "3 2\n0 1\n"),
            "part:1: expected 2 rewards as this line says, found 1");
  EXPECT_EQ(part_refusal(three, Kind::rewards, "4 1\n"),
            "part:1:1: expected the number of a state below 3, found '4'");
  EXPECT_EQ(part_refusal(three, Kind::rewards, "3 3 1\n0 2 1 1\n"),
            "part:2:3: expected a choice of state 0, which has 2, found '2'");
  EXPECT_EQ(part_refusal(three, Kind::rewards, "3 3 1\n0 1 1 1\n"),
            "part:2:5: expected a successor of state 0, choice 1, found '1'");
}

// What is written is read again from the folder, with every companion.
class PrismFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("prism_") + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string put(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(PrismFolder, WritesWhatItReads) {
  const Mdp m = made(
      parse(three, {{Kind::states, "", "(x,y)\n0:(1,2)\n1:(1,3)\n2:(2,0)\n"},
                    {Kind::labels, "", "0=\"init\" 1=\"my goal\" 2=\"none\"\n0: 0\n1: 0 1\n2: 1\n"},
                    {Kind::rewards, "gold", "0 0 2 10\n1 0 2 0.1\n"},
                    {Kind::rewards, "time", "0 1\n1 1\n"}}));
  const auto files = write_model(m, (folder_ / "m.tra").string());
  ASSERT_TRUE(files) << message(files.error());
  std::string names;
  for (const WrittenFile& file : *files) {
    const std::string name = file.path.substr(folder_.string().size() + 1);
    put(name, file.content);
    names += name + " ";
  }
  EXPECT_EQ(names, "m.tra m.sta m.lab m1.trew m2.srew ");
  const auto again = read_model((folder_ / "m.tra").string());
  ASSERT_TRUE(again) << message(again.error());
  EXPECT_EQ(digest(*again), digest(m));
  ASSERT_EQ(again->arrays().labels.size(), 2u);
  EXPECT_EQ(again->find_label("my goal")->states, (std::vector<State>{1, 2}));
  EXPECT_TRUE(again->find_label("none")->states.empty());
  EXPECT_EQ(again->arrays().reward_name, "gold");
  EXPECT_EQ(again->find_rewards("time")->reward, (std::vector<double>{1, 1, 1}));
}

TEST_F(PrismFolder, FindsItsPartsByName) {
  const std::string path = put("m.tra", three);
  put("m.time.srew", "0 1\n");
  put("m_gold.trew", "1 0 2 5\n");
  put("m.tool.trans.rew", "1 0 2 7\n");
  put("m.tool.state.rew", "0 1\n");
  put("m_other.tra", three);
  put("m_other.srew", "0 100\n");  // of the model above
  put("mm.srew", "0 100\n");
  const auto mdp = read_model(path);
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->arrays().reward_name, "time");
  EXPECT_EQ(mdp->arrays().reward, (std::vector<double>{1, 1, 0}));
  ASSERT_EQ(mdp->arrays().other_rewards.size(), 2u);
  EXPECT_EQ(mdp->find_rewards("gold")->reward, (std::vector<double>{0, 0, 5}));
  EXPECT_EQ(mdp->find_rewards("tool")->reward, (std::vector<double>{1, 1, 7}));
  const auto given = read_model(path, {{"rewards", put("mm.srew", "0 100\n")}});
  ASSERT_TRUE(given) << message(given.error());
  EXPECT_EQ(given->arrays().reward_name, "mm");
  EXPECT_EQ(given->arrays().other_rewards.size(), 0u);
  EXPECT_EQ(given->reward(0), 100.0);
  const auto misspelt = read_model(path, {{"label", "x"}});
  EXPECT_NE(message(misspelt.error()).find("did you mean 'labels'?"), std::string::npos);
}

TEST_F(PrismFolder, RefusesNamesThatFilesCannotHold) {
  MdpArrays a = made(parse(three, {})).arrays();
  a.labels = {{"say \"go\"", {0}}};
  const auto files = write_model(made(a), "m.tra");
  ASSERT_FALSE(files);
  EXPECT_EQ(message(files.error()),
            "expected names of labels and rewards without quotation marks, found say \"go\"");
}

}  // namespace
}  // namespace quoll
