#include <gtest/gtest.h>

#include "../../refusal.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

Mdp model(std::string_view text) {
  auto mdp = parse_model(text, "P.json");
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

std::string refusal(std::string_view text) {
  return tests::refusal_of(parse_model(text, "P.json"));
}

// 0 goes left to itself or right, slipping: 1 for sure but written twice. 1 is
// a hole.
constexpr std::string_view small = R"({
"0": {"0": [[1.0, 0, -1, false]],
      "1": [[0.3333333333333333, 1, 1.0, true], [0.3333333333333333, 1, 1.0, true],
            [0.3333333333333333, 0, 0.0, false]]},
"1": {"0": [[1.0, 1, 0, true]], "1": [[1.0, 1.0, 0, 1.0]]}})";

TEST(Gymnasium, OutcomesAreKeptAndHolesAreEnds) {
  const Mdp mdp = model(small);
  EXPECT_EQ(mdp.states(), 2u);
  EXPECT_EQ(mdp.actions(0), 2u);
  EXPECT_EQ(mdp.outcomes(), 6u);
  EXPECT_EQ(mdp.reward(0), -1.0);
  EXPECT_EQ(mdp.reward(1, 1), 1.0);
  EXPECT_EQ(mdp.reward(1, 3), 0.0);
  EXPECT_TRUE(mdp.terminal(1));
  EXPECT_EQ(mdp.discount(), 0.99);
  EXPECT_EQ(mdp.start().size(), 1u);
  EXPECT_EQ(digest(model(R"([[[[1,0,-1,false]],[[0.3333333333333333,1,1,true],)"
                         R"([0.3333333333333333,1,1,true],[0.3333333333333333,0,0,false]]],)"
                         R"([[[1,1,0,true]],[[1,1,0,true]]]])")),
            digest(mdp));
}

// "b" goes on when it is entered undone: done outcomes in it lead to an end of
// their own.
TEST(Gymnasium, ADoneOutcomeIsNotContinued) {
  const Mdp mdp = model(R"({"a": {"go": [[0.5, "b", 1, true], [0.5, "b", 2, false]]},
                            "b": {"go": [[1, "a", 0, false]], "stop": [[1, "b", 5, true]]}})");
  ASSERT_EQ(mdp.states(), 3u);
  EXPECT_EQ(mdp.state_name(2), "b done");
  EXPECT_EQ(mdp.next(0), 2u);
  EXPECT_EQ(mdp.next(1), 1u);
  EXPECT_EQ(mdp.next(3), 2u);
  EXPECT_FALSE(mdp.terminal(1));
  EXPECT_TRUE(mdp.terminal(2));
}

TEST(Gymnasium, AnAbsorbingStateWithRewardIsNoEnd) {
  const Mdp mdp = model(R"({"a": {"go": [[1, "a", 5, true]]}})");
  EXPECT_EQ(mdp.states(), 2u);
  EXPECT_FALSE(mdp.terminal(0));
}

TEST(Gymnasium, FaultsArePlaced) {
  EXPECT_EQ(refusal(""), "P.json:1:1: an object in { } expected");
  EXPECT_EQ(refusal("{}"), "P.json:1:1: a state expected");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[[1,0,NaN,false]]}}"), "P.json:1:17: a number expected");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[[1,0,1e999,false]]}}"),
            "P.json:1:17: a number that a double can hold expected");
  EXPECT_EQ(refusal("{\"0\":{\n\"0\":[[1,0,0]]}}"),
            "P.json:2:11: [probability, next, reward, done] expected");
  EXPECT_EQ(refusal("{\"0\":{\n\"0\":[[1,2,0,true]]}}"), "P.json:2: state '2' is no state of P");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[[1,-1,0,true]]}}"),
            "P.json:1:15: a state's name or number expected");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[[1,0,0,true]],\n\"1\":[[0.5,0,0,false]]}}"),
            "P.json:2: state 0, action 1: probabilities sum to 0.5, expected 1");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[[1,0,0,2]]}}"), "P.json:1:19: true or false expected");
  EXPECT_EQ(refusal("{\"0\":{\"0\":[]}}"), "P.json:1: state 0, action 0: no outcome");
  EXPECT_EQ(refusal("{\"0\":{},\"0\":{}}"), "P.json:1:9: state 0 once expected");
  EXPECT_NE(refusal("{\"discount\":0.5,\"PP\":{}}").find("found 'PP'"), std::string::npos);
  EXPECT_EQ(refusal("{\"discount\":0.5}"), "P.json:1:13: the member \"P\" expected");
}

TEST(Gymnasium, ReadsBackWhatItWrites) {
  MdpArrays arrays;
  arrays.choice_begin = {0, 2, 3, 4, 4};
  arrays.outcome_begin = {0, 2, 3, 4, 6};
  arrays.next = {1, 1, 2, 1, 0, 3};
  arrays.probability = {1.0 / 3, 2.0 / 3, 1, 1, 0.1, 0.9};
  arrays.outcome_reward = {1, -2.5, 1e-300, 0, 7, 8};
  arrays.action = {1, 0, 1, 0};
  arrays.start = {0, 1};
  arrays.start_probability = {0.25, 0.75};
  arrays.terminal = {2};
  for (const char* name : {"HALL", "CAVE, \"deep\"", "Höhle", "x"}) {
    arrays.state_names.push_back(name);
  }
  for (const char* name : {"up", "down"}) arrays.action_names.push_back(name);
  arrays.labels = {{"goal", {2}}, {"other", {0, 1, 3}}};
  arrays.reward_name = "money";
  arrays.discount = 0.93;
  arrays.alternating = true;
  const auto mdp = Mdp::make(arrays);
  ASSERT_TRUE(mdp) << message(mdp.error());
  const auto written = write_gymnasium(*mdp);
  ASSERT_TRUE(written);
  const Mdp read = model(*written);
  EXPECT_EQ(digest(read), digest(*mdp));
  EXPECT_EQ(read.arrays().reward_name, "money");
  ASSERT_EQ(read.arrays().labels.size(), 2u);
  EXPECT_EQ(read.find_label("other")->states, (std::vector<State>{0, 1, 3}));
  const auto small_again = write_gymnasium(model(small));
  ASSERT_TRUE(small_again);
  EXPECT_EQ(digest(model(*small_again)), digest(model(small)));
}

}  // namespace
}  // namespace quoll
