#include "quoll/model/mdp.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quoll {
namespace {

Names names_of(std::initializer_list<const char*> list) {
  Names names;
  for (const char* name : list) names.push_back(name);
  return names;
}

// HALL --To-CAVE--> CAVE with 0.9, HALL with 0.1; HALL --wait--> HALL; CAVE is an end.
MdpArrays two_states() {
  MdpArrays a;
  a.choice_begin = {0, 2, 2};
  a.outcome_begin = {0, 2, 3};
  a.next = {1, 0, 0};
  a.probability = {0.9, 0.1, 1.0};
  a.reward = {5.0, -1.0};
  a.action = {0, 1};
  a.state_names = names_of({"HALL", "CAVE"});
  a.action_names = names_of({"To-CAVE", "wait"});
  a.discount = 0.5;
  return a;
}

std::string refusal(MdpArrays a) {
  const auto mdp = Mdp::make(std::move(a));
  return mdp ? "accepted" : message(mdp.error());
}

TEST(Mdp, KeepsWhatItWasGiven) {
  const auto mdp = Mdp::make(two_states());
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->states(), 2u);
  EXPECT_EQ(mdp->choices(), 2u);
  EXPECT_EQ(mdp->outcomes(), 3u);
  EXPECT_FALSE(mdp->deterministic());
  EXPECT_EQ(mdp->actions(0), 2u);
  EXPECT_EQ(mdp->actions(1), 0u);
  EXPECT_FALSE(mdp->terminal(0));
  EXPECT_TRUE(mdp->terminal(1));
  EXPECT_EQ(mdp->probability(1), 0.1);
  EXPECT_EQ(mdp->reward(0), 5.0);
  EXPECT_EQ(mdp->reward(1, 2), -1.0);
  EXPECT_EQ(mdp->reward_bounds(), std::pair(-1.0, 5.0));
  EXPECT_EQ(mdp->action_name(1), "wait");
  EXPECT_EQ(mdp->find_state("CAVE"), 1u);
  EXPECT_FALSE(mdp->find_state("CAV"));
}

TEST(Mdp, WithoutStartBeginsWhereverThereIsAMove) {
  const auto mdp = Mdp::make(two_states());
  ASSERT_EQ(mdp->start().size(), 1u);
  EXPECT_EQ(mdp->start()[0], 0u);
  EXPECT_EQ(mdp->start_probability(0), 1.0);
}

TEST(Mdp, DropsOutcomesThatNeverHappen) {
  MdpArrays a = two_states();
  a.probability = {1.0, 0.0, 1.0};
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp);
  EXPECT_TRUE(mdp->deterministic());
  EXPECT_EQ(mdp->outcomes(), 2u);
  EXPECT_EQ(mdp->next(0), 1u);
  EXPECT_EQ(mdp->next(1), 0u);
  EXPECT_TRUE(mdp->arrays().probability.empty());
  EXPECT_TRUE(mdp->arrays().outcome_begin.empty());
}

TEST(Mdp, ComputesExpectedRewardsFromThoseOfOutcomes) {
  MdpArrays a = two_states();
  a.reward.clear();
  a.outcome_reward = {10.0, -20.0, 3.0};
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp);
  EXPECT_DOUBLE_EQ(mdp->reward(0), 7.0);  // 0.9 * 10 - 0.1 * 20
  EXPECT_EQ(mdp->reward(0, 1), -20.0);
  EXPECT_EQ(mdp->reward(1), 3.0);
  EXPECT_EQ(mdp->reward_bounds(), std::pair(-20.0, 10.0));
}

TEST(Mdp, DropsOutcomeRewardsThatDoNotVary) {
  MdpArrays a = two_states();
  a.probability = {0.7, 0.3, 1.0};
  a.reward.clear();
  a.outcome_reward = {0.1, 0.1, 3.0};
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp);
  EXPECT_TRUE(mdp->arrays().outcome_reward.empty());
  EXPECT_EQ(mdp->reward(0), 0.1);  // exactly, not 0.7 * 0.1 + 0.3 * 0.1
}

TEST(Mdp, LeavesProbabilitiesAloneWithinTheTolerance) {
  MdpArrays a = two_states();
  a.probability = {0.9, 0.1 + 5e-10, 1.0};
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp);
  EXPECT_EQ(mdp->probability(1), 0.1 + 5e-10);
}

TEST(Mdp, NormalisesTheStart) {
  MdpArrays a = two_states();
  a.start = {0, 1};
  a.start_probability = {1.0, 0.0};
  const auto one = Mdp::make(a);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->start().size(), 1u);
  EXPECT_TRUE(one->arrays().start_probability.empty());
  a.start_probability = {0.25, 0.75};
  const auto two = Mdp::make(a);
  ASSERT_TRUE(two);
  EXPECT_EQ(two->start_probability(1), 0.75);
}

TEST(Mdp, DeclaredTerminalStatesMayHaveMoves) {
  MdpArrays a = two_states();
  a.terminal = {0};
  a.start = {1};
  const auto mdp = Mdp::make(std::move(a));
  ASSERT_TRUE(mdp);
  EXPECT_TRUE(mdp->terminal(0));
  EXPECT_EQ(mdp->actions(0), 2u);
  EXPECT_EQ(mdp->reward_bounds(), std::pair(0.0, 0.0));
}

TEST(Mdp, RefusesWithTheNamesOfStateAndAction) {
  MdpArrays a = two_states();
  a.probability.set(1, 0.0);
  EXPECT_EQ(refusal(a), "state HALL, action To-CAVE: probabilities sum to 0.9, expected 1");
  a.choice_line = {7, 8};
  a.probability.set(1, 0.1 + 2e-9);
  const auto made = Mdp::make(a);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().line, 7u);
  EXPECT_EQ(made.error().expected,
            "state HALL, action To-CAVE: probabilities sum to 1.000000002, expected 1");

  a = two_states();
  a.probability = {1.5, -0.5, 1.0};
  EXPECT_EQ(refusal(a), "state HALL, action To-CAVE: probability 1.5 is outside [0, 1]");
  a = two_states();
  a.probability.set(2, std::nan(""));
  EXPECT_EQ(refusal(a), "state HALL, action wait: probability nan is outside [0, 1]");
  a = two_states();
  a.reward[1] = -HUGE_VAL;
  EXPECT_EQ(refusal(a), "state HALL, action wait: reward -inf, expected a finite number");
  a = two_states();
  a.next[2] = 2;
  EXPECT_EQ(refusal(a), "state HALL, action wait: successor number 2 of 2 states");
  a = two_states();
  a.action[1] = 0;
  EXPECT_EQ(refusal(a), "state HALL, action To-CAVE: the action stands twice");
  a = two_states();
  a.outcome_begin = {0, 3, 3};
  a.probability = {0.5, 0.25, 0.25};
  EXPECT_EQ(refusal(a), "state HALL, action wait: no outcome");
}

TEST(Mdp, RefusesDiscountsAndStarts) {
  for (const double discount : {0.0, -0.5, 1.5}) {
    MdpArrays a = two_states();
    a.discount = discount;
    EXPECT_NE(refusal(a).find("is outside (0, 1]"), std::string::npos) << discount;
  }
  MdpArrays a = two_states();
  a.discount = std::nan("");
  EXPECT_EQ(refusal(a), "discount nan is outside (0, 1]");
  a = two_states();
  a.start = {0, 1};
  a.start_probability = {0.5, 0.25};
  EXPECT_EQ(refusal(a), "start probabilities sum to 0.75, expected 1");
  a.start_probability = {0.5, -0.5};
  EXPECT_EQ(refusal(a), "state CAVE: start probability -0.5 is outside [0, 1]");
  a = two_states();
  a.terminal = {0, 1};
  EXPECT_EQ(refusal(a), "no start: every state is an end");
}

TEST(Mdp, RefusesArraysThatDoNotFit) {
  EXPECT_EQ(refusal({}), "a model has at least one state");
  MdpArrays a = two_states();
  a.next.pop_back();
  EXPECT_EQ(refusal(a), "array next: 2 entries, expected 3");
  a = two_states();
  a.choice_begin = {0, 3, 2};
  EXPECT_EQ(refusal(a), "array choice_begin must ascend from 0");
  a = two_states();
  a.outcome_begin = {1, 2, 3};
  EXPECT_EQ(refusal(a), "array outcome_begin must ascend from 0");
  a = two_states();
  a.start = {1, 0};
  EXPECT_EQ(refusal(a), "array start: states must ascend");
  a = two_states();
  a.terminal = {2};
  EXPECT_EQ(refusal(a), "array terminal: state number 2 of 2");
  a = two_states();
  a.action[0] = 2;
  EXPECT_EQ(refusal(a), "action number 2 of 2");
  a = two_states();
  a.state_names = Names::numbered("s", 3);
  EXPECT_EQ(refusal(a), "array state_names: 3 entries, expected 2");
  a = two_states();
  a.layout = Layout{1, 2, {0, 2}, {}};
  EXPECT_EQ(refusal(a), "layout: cell 2 of 2");
}

TEST(Mdp, KeepsLabelsAndFurtherRewards) {
  MdpArrays a = two_states();
  a.labels = {{"goal", {1}}, {"none", {}}};
  a.reward_name = "gold";
  a.other_rewards = {{"time", {1.0, 1.0}, {}}, {"noise", {}, {2.0, 0.0, 3.0}}};
  const auto mdp = Mdp::make(a);
  ASSERT_TRUE(mdp) << message(mdp.error());
  ASSERT_NE(mdp->find_label("goal"), nullptr);
  EXPECT_EQ(mdp->find_label("goal")->states, std::vector<State>{1});
  EXPECT_EQ(mdp->find_label("gaol"), nullptr);
  ASSERT_NE(mdp->find_rewards("noise"), nullptr);
  EXPECT_EQ(mdp->find_rewards("noise")->reward, (std::vector<double>{1.8, 3.0}));  // 0.9 * 2
}

TEST(Mdp, RefusesLabelsAndFurtherRewardsThatDoNotFit) {
  const auto with = [](std::vector<Label> labels, std::vector<RewardStructure> rewards) {
    MdpArrays a = two_states();
    a.labels = std::move(labels);
    a.reward_name = "gold";
    a.other_rewards = std::move(rewards);
    return refusal(std::move(a));
  };
  EXPECT_EQ(with({{"goal", {2}}}, {}), "label goal: state number 2 of 2");
  EXPECT_EQ(with({{"goal", {1, 0}}}, {}), "label goal: states must ascend");
  EXPECT_EQ(with({{"goal", {0, 0}}}, {}), "label goal: states must ascend");
  EXPECT_EQ(with({{"goal", {}}, {"goal", {}}}, {}), "the label goal stands twice");
  EXPECT_EQ(with({{"", {}}}, {}), "a label without a name");
  EXPECT_EQ(with({}, {{"time", {1.0}, {}}}),
            "array rewards time per choice: 1 entries, expected 2");
  EXPECT_EQ(with({}, {{"time", {}, {1.0, 2.0}}}),
            "array rewards time per outcome: 2 entries, expected 3");
  EXPECT_EQ(with({}, {{"gold", {1.0, 2.0}, {}}}), "the reward structure gold stands twice");
  EXPECT_EQ(with({}, {{"time", {1.0, INFINITY}, {}}}),
            "state HALL, action wait: reward inf, expected a finite number");
  EXPECT_EQ(with({}, {{"time", {}, {0.0, NAN, 0.0}}}),
            "state HALL, action To-CAVE: reward nan, expected a finite number");
}

TEST(Mdp, KnowsOneZeroOnly) {
  MdpArrays a = two_states();
  a.reward = {-0.0, -1.0};
  const auto mdp = Mdp::make(std::move(a));
  EXPECT_FALSE(std::signbit(mdp->reward(0)));
}

TEST(Mdp, CountsItsBytes) {
  const auto mdp = Mdp::make(two_states());
  // 3 + 3 offsets, 3 successors, 3 probabilities, 2 rewards, 2 actions: 48 + 12 + 24 + 16 + 8.
  EXPECT_GE(mdp->bytes(), 108u);
  EXPECT_LE(mdp->bytes(), 400u);
}

}  // namespace
}  // namespace quoll
