#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

const std::string head =
    "// Exported\n@type: MDP\n@value_type: double\n@parameters\n\n@reward_models\ngold time \n"
    "@nr_states\n3\n@nr_choices\n3\n@model\n";
// State 0 goes to 1 for a third and to 2, or stays; 1 goes to 2; 2 has no choice.
const std::string body =
    "state 0 [1, 0] init\n\taction go [2,1/2]\n\t\t1 : 1/3\n\t\t2 : 2/3\n\taction __NOLABEL__ "
    "[0,1]\n"
    "\t\t0 : 1\nstate 1 odd \"my goal\"\n\taction go\n\t\t2 : 1\nstate 2 \"my goal\"\n";

Mdp model(const std::string& text) {
  auto mdp = parse_model(text, "w.drn");
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *std::move(mdp);
}

std::string refusal(const std::string& text) {
  const auto mdp = parse_model(text, "w.drn");
  return mdp ? "accepted" : message(mdp.error());
}

TEST(Drn, ReadsStatesActionsRewardsAndLabels) {
  const Mdp m = model(head + body);
  EXPECT_EQ(m.states(), 3u);
  EXPECT_EQ(m.choices(), 3u);
  EXPECT_EQ(m.action_name(0), "go");
  EXPECT_EQ(m.action_name(1), "1");
  EXPECT_EQ(m.probability(0), 1.0 / 3);
  EXPECT_EQ(m.arrays().reward_name, "gold");
  EXPECT_EQ(m.arrays().reward, (std::vector<double>{3, 1, 0}));  // 1 of state 0, and 2 of its go
  ASSERT_NE(m.find_rewards("time"), nullptr);
  EXPECT_EQ(m.find_rewards("time")->reward, (std::vector<double>{0.5, 1, 0}));
  ASSERT_EQ(m.arrays().labels.size(), 2u);
  EXPECT_EQ(m.find_label("my goal")->states, (std::vector<State>{1, 2}));
  EXPECT_EQ(m.start().size(), 1u);
  EXPECT_TRUE(m.terminal(2));
  EXPECT_EQ(m.discount(), 1.0);
}

TEST(Drn, ReadsChainsWithoutActions) {
  const Mdp m =
      model("@type: dtmc\n@nr_states\n2\n@model\nstate 0\n\t0 : 0.5\n\t1 : 0.5\nstate 1\n1 : 1\n");
  EXPECT_EQ(m.choices(), 2u);
  EXPECT_EQ(m.next(1), 1u);
  EXPECT_EQ(m.probability(1), 0.5);
}

TEST(Drn, NamesOfStatesStandInCommentsBelowThem) {
  const std::string start = "@type: MDP\n@nr_states\n2\n@model\nstate 0\n";
  const std::string move = "\taction a\n\t\t1 : 1\nstate 1\n";
  const Mdp values = model(start + "//[x=1\t& y=2]\n" + move + "//[x=2\t& y=0]\n");
  EXPECT_EQ(values.state_name(0), "(x=1,y=2)");
  EXPECT_EQ(values.state_name(1), "(x=2,y=0)");
  EXPECT_EQ(model(start + "// HALL 1\n" + move + "// CAVE\n").state_name(0), "HALL 1");
  EXPECT_EQ(model(start + "// only some have one\n" + move).state_name(0), "0");
}

TEST(Drn, WritesWhatItReads) {
  const std::string named =
      "@type: MDP\n@nr_states\n2\n@model\nstate 0\n// HALL\n\taction a\n\t\t1 : 1\n"
      "state 1 init\n//[x=1]\n\taction b\n\t\t1 : 1\n";
  for (const std::string& text : {head + body, named}) {
    const Mdp m = model(text);
    const auto written = write_drn(m);
    ASSERT_TRUE(written) << message(written.error());
    const Mdp again = model(*written);
    EXPECT_EQ(digest(again), digest(m)) << *written;
    ASSERT_EQ(again.arrays().labels.size(), m.arrays().labels.size());
    for (const Label& label : m.arrays().labels) {
      EXPECT_EQ(again.find_label(label.name)->states, label.states);
    }
    EXPECT_EQ(again.arrays().reward_name, m.arrays().reward_name);
    for (const RewardStructure& other : m.arrays().other_rewards) {
      EXPECT_EQ(again.find_rewards(other.name)->reward, other.reward);
    }
  }
}

TEST(Drn, RefusesWithThePlace) {
  const std::string start = "@type: MDP\n@nr_states\n2\n@model\n";
  EXPECT_EQ(refusal(""), "w.drn: expected @model and the states below it");
  EXPECT_EQ(refusal("@type: POMDP\n"), "w.drn:1: expected @type: MDP or DTMC, found 'POMDP'");
  EXPECT_EQ(refusal("@typ: MDP\n"),
            "w.drn:1: expected one of @type:, @value_type:, @parameters, @reward_models, "
            "@nr_states, @nr_choices and @model, found '@typ:'; did you mean '@type:'?");
  EXPECT_EQ(refusal("@value_type: double-interval\n"),
            "w.drn:1: expected @value_type: double or rational, found 'double-interval'");
  EXPECT_EQ(refusal("@parameters\np q\n"),
            "w.drn:2: expected no parameters: parametric models cannot be read");
  EXPECT_EQ(refusal("@nr_states\n1099511627776\n@model\n"),
            "w.drn:2: expected a number that the 3 lines of this file can hold, found "
            "'1099511627776'");
  EXPECT_EQ(refusal("@model\n"), "w.drn:1: expected @nr_states above @model");
  EXPECT_EQ(refusal(start + "state 1\n"), "w.drn:5:7: expected state 0 of 2, found '1'");
  EXPECT_EQ(refusal(start + "state 0\n"), "w.drn:5: expected 2 states as @nr_states says, found 1");
  EXPECT_EQ(refusal(start + "action a\n"), "w.drn:5: expected a state above the first action");
  EXPECT_EQ(refusal(start + "state 0\n\t\t2 : 1\n"),
            "w.drn:6:3: expected the number of a successor below 2, found '2'");
  EXPECT_EQ(refusal(start + "state 0\n\t\t1 : [0.4, 0.6]\n"),
            "w.drn:6:7: expected a probability, found an interval: models of intervals cannot be "
            "read");
  EXPECT_EQ(refusal(start + "state 0\n\t\t1 : p\n"),
            "w.drn:6:7: expected a probability, found 'p'");
  EXPECT_EQ(refusal(start + "state 0 [nan]\n"),
            "w.drn:5:10: expected a finite reward, found 'nan'");
  EXPECT_EQ(refusal(start + "state 0 [1\n"), "w.drn:5:9: expected ']' behind the rewards");
  EXPECT_EQ(refusal(start + "stat 0\n"),
            "w.drn:5:1: expected 'state NUMBER', 'action NAME' or 'SUCCESSOR : PROBABILITY', found "
            "'stat 0'");
  EXPECT_EQ(
      refusal(
          "@type: MDP\n@nr_states\n2\n@nr_choices\n1\n@model\nstate 0\n1 : 1\nstate 1\n1 : 1\n"),
      "w.drn:10: expected 1 choice as @nr_choices says, found 2");
}

TEST(Drn, RefusesRowsThatAreNoProbabilities) {
  const std::string start = "@type: MDP\n@nr_states\n1\n@model\nstate 0\n\taction a\n";
  EXPECT_EQ(refusal(start + "\t\t0 : 0.9999992\n"),
            "w.drn:6: state 0, action a: probabilities sum to 0.9999992, expected 1");
  EXPECT_EQ(refusal(start + "\t\t0 : -1\n"),
            "w.drn:6: state 0, action a: probability -1 is outside [0, 1]");
  EXPECT_EQ(refusal(start + "\t\t0 : nan\n"),
            "w.drn:6: state 0, action a: probability nan is outside [0, 1]");
}

}  // namespace
}  // namespace quoll
