#include "quoll/model/goal.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

// State 0: go to 1, 2 or the trap 3; state 1: stay for ever or go to 2; 2 is the goal and goes on
// to 0; 3 stays.
const std::string text =
    "@type: MDP\n@reward_models\ngold time\n@nr_states\n4\n@model\n"
    "state 0 init\n\taction go [1,1]\n\t\t1 : 0.5\n\t\t2 : 0.25\n\t\t3 : 0.25\n"
    "state 1 odd low\n\taction stay [2,1]\n\t\t1 : 1\n\taction go [3,1]\n\t\t2 : 1\n"
    "state 2 \"my goal\"\n\taction go [4,1]\n\t\t0 : 1\n"
    "state 3 odd\n\taction stay [5,1]\n\t\t3 : 1\n";

Mdp model() {
  auto mdp = parse_model(text, "w.drn");
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *std::move(mdp);
}

std::string states(const std::string& expression) {
  const auto found = states_of(model(), expression);
  if (!found) return message(found.error());
  std::string list;
  for (const State s : *found) list += std::to_string(s);
  return list;
}

TEST(Goal, ExpressionsOverLabels) {
  EXPECT_EQ(states("odd"), "13");
  EXPECT_EQ(states("my goal"), "2");
  EXPECT_EQ(states("\"my goal\""), "2");
  EXPECT_EQ(states("!odd"), "02");
  EXPECT_EQ(states("! ! odd"), "13");
  EXPECT_EQ(states("odd & !low"), "3");
  EXPECT_EQ(states("low | \"my goal\" & !odd"), "12");  // & binds closer
  EXPECT_EQ(states("(low | \"my goal\") & !odd"), "2");
  EXPECT_EQ(states("init|3"), "03");  // the start, and a state by its name
}

TEST(Goal, ExpressionsThatAreNone) {
  EXPECT_EQ(states("ood"),
            "--goal: no label or state 'ood'; the labels are odd, low, my goal; did you mean "
            "'odd'?");
  EXPECT_EQ(states("odd &"), "--goal: expected a label before ''");
  EXPECT_EQ(states("(odd"), "--goal: expected ')' before ''");
  EXPECT_EQ(states("odd low"), "--goal: expected & or | before 'low'");
  EXPECT_EQ(states("\"odd"), "--goal: expected a second '\"' behind 'odd'");
  EXPECT_EQ(states(std::string(300, '(')), "--goal: expected brackets at most 200 deep");
}

TEST(Goal, TheMostProbabilityEndsWhereTheGoalCannotBeReached) {
  const auto mdp = aim(model(), {"my goal", "", false});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_FALSE(mdp->terminal(0));
  EXPECT_FALSE(mdp->terminal(1));
  EXPECT_TRUE(mdp->terminal(2));
  EXPECT_TRUE(mdp->terminal(3));
  EXPECT_EQ(mdp->reward(0, 0), 0.0);
  EXPECT_EQ(mdp->reward(0, 1), 1.0);
  EXPECT_EQ(mdp->reward(0), 0.25);
  EXPECT_EQ(mdp->discount(), 1.0);
}

TEST(Goal, TheLeastProbabilityEndsWhereTheGoalCanBeAvoided) {
  // Whoever is in 1 stays there: only 0 is left, with 1/4.
  const auto mdp = aim(model(), {"my goal", "", true});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_FALSE(mdp->terminal(0));
  EXPECT_TRUE(mdp->terminal(1));
  EXPECT_TRUE(mdp->terminal(2));
  EXPECT_TRUE(mdp->terminal(3));
}

TEST(Goal, RewardsAreChosenByName) {
  const auto time = aim(model(), {"", "time", false});
  ASSERT_TRUE(time) << message(time.error());
  EXPECT_EQ(time->reward(1), 1.0);
  EXPECT_EQ(time->arrays().reward_name, "time");
  ASSERT_NE(time->find_rewards("gold"), nullptr);
  EXPECT_EQ(time->find_rewards("gold")->reward[1], 2.0);
  EXPECT_FALSE(time->terminal(2));
  const auto until = aim(model(), {"my goal", "gold", false});
  ASSERT_TRUE(until) << message(until.error());
  EXPECT_EQ(until->reward(2), 3.0);
  EXPECT_TRUE(until->terminal(2));
  EXPECT_FALSE(until->terminal(3));
  EXPECT_EQ(message(aim(model(), {"", "tim", false}).error()),
            "--reward: no rewards 'tim' in this world; there are gold, time; did you mean 'time'?");
}

TEST(Goal, RewardsWithoutANameAreCalledReward) {
  const auto mdp = parse_model("state,action,next_state,probability,reward\nA,go,B,1,5\n", "w.csv");
  ASSERT_TRUE(mdp);
  const auto own = aim(*mdp, {"B", "reward", false});
  ASSERT_TRUE(own) << message(own.error());
  EXPECT_EQ(own->reward(0), 5.0);
  // The end B is not the goal A: whoever is there stays.
  const auto never = aim(*mdp, {"A", "reward", false});
  ASSERT_TRUE(never) << message(never.error());
  EXPECT_TRUE(never->terminal(0));
  EXPECT_FALSE(never->terminal(1));
  EXPECT_EQ(never->action_name(1), "stay");
  EXPECT_EQ(never->next(1), 1u);
  EXPECT_EQ(never->reward(1), 0.0);
  EXPECT_EQ(message(aim(*mdp, {"B", "gold", false}).error()),
            "--reward: no rewards 'gold' in this world; there are reward");
  EXPECT_EQ(message(aim(*mdp, {"C1", "", false}).error()),
            "--goal: no label or state 'C1', and this world has no labels");
}

}  // namespace
}  // namespace quoll
