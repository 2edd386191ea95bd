#include "quoll/report/explain_text.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quoll {
namespace {

// A -go-> B (0), A -end-> E (-1), B -go-> A (2), B -end-> E (10).
Mdp small() {
  MdpArrays arrays;
  arrays.choice_begin = {0, 2, 4, 4};
  arrays.next = {1, 2, 0, 2};
  arrays.reward = {0, -1, 2, 10};
  arrays.action = {0, 1, 0, 1};
  for (const char* name : {"A", "B", "E"}) arrays.state_names.push_back(name);
  for (const char* name : {"go", "end"}) arrays.action_names.push_back(name);
  arrays.discount = 0.5;
  return *Mdp::make(std::move(arrays));
}

Update move(std::uint64_t step, State state, Action action, double reward, State next) {
  Update update;
  update.step = step;
  update.state = state;
  update.action = action;
  update.reward = reward;
  update.next = next;
  update.terminated = next == 2;
  return update;
}

TEST(ExplainText, TellsAnUpdateWithItsNumbersAndRemembersIt) {
  const Mdp mdp = small();
  UpdateTeller teller(mdp, std::vector<double>(4), 0.5, UpdateWords::of("standard"));
  Update first = move(1, 1, 1, 10, 2);
  first.target = first.new_value = 10;
  EXPECT_EQ(teller.tell(first),
            "step 1   at B, take end -> E, reward 10\n"
            "         Q(B,end) := 10 + 0.5 * 0 = 10   was 0   [E is an end: nothing follows]\n");
  Update second = move(2, 0, 0, 0, 1);
  second.best_next = 10;
  second.target = second.new_value = 5;
  EXPECT_EQ(teller.tell(second),
            "step 2   at A, take go -> B, reward 0\n"
            "         Q(A,go) := 0 + 0.5 * max{go 0, end 10} = 5   was 0\n");
  EXPECT_EQ(teller.q()[3], 10);
  EXPECT_EQ(teller.q()[0], 5);
  EXPECT_EQ(teller.visits()[3], 1U);
}

TEST(ExplainText, ShowsTheStepSizeAndNegativeNumbersInParentheses) {
  const Mdp mdp = small();
  UpdateTeller teller(mdp, {-2, 0, 0, 0}, 0.5, UpdateWords::of("standard"));
  Update update = move(7, 0, 0, 0, 1);  // -2 + 0.25 (0 - (-2)) = -1.5
  update.old_value = -2;
  update.step_size = 0.25;
  update.new_value = -1.5;
  EXPECT_EQ(teller.tell(update),
            "step 7   at A, take go -> B, reward 0\n"
            "         target = 0 + 0.5 * max{go 0, end 0} = 0\n"
            "         Q(A,go) := -2 + 0.25 * (0 - (-2)) = -1.5   was -2\n");
}

TEST(ExplainText, SaysWhatIsUnchangedAndWhatIsCutOff) {
  const Mdp mdp = small();
  UpdateWords words = UpdateWords::of("reward-estimate");
  words.chance = true;
  UpdateTeller teller(mdp, std::vector<double>(4), 0.5, words, {2, 0, 0, 0});
  Update update = move(3, 0, 0, 0, 1);
  update.truncated = true;
  update.explored = true;
  EXPECT_EQ(teller.tell(update),
            "step 3   at A, take go -> B   (by chance)\n"
            "         QE(A,go) := rE 0 + 0.5 * max{go 0, end 0} = 0   unchanged   [rE: mean of 3 "
            "observed rewards]   [the episode is cut off here; the value of B still counts]\n");
}

TEST(ExplainText, MarksTheFirstDifferenceWithBothSums) {
  const Mdp mdp = small();
  std::vector<Update> printed(2, move(1, 0, 0, 0, 1)), standard = printed;
  printed[1].step = standard[1].step = 2;
  for (auto* both : {&printed, &standard}) {
    (*both)[0].best_next = (*both)[1].best_next = 10;
    (*both)[0].new_value = (*both)[1].new_value = 5;
  }
  RuleComparison view{&mdp, printed, standard, 0.5, false};
  EXPECT_FALSE(first_difference(view));
  printed[1].reward = 5;
  printed[1].new_value = 10;
  EXPECT_EQ(first_difference(view), 1U);
  EXPECT_EQ(comparison_text(view),
            "step  move  as printed: rE + 0.5 * max QE  |  standard: r + 0.5 * max Q\n"
            "   1  A go  0 + 0.5 * 10 = 5               |  0 + 0.5 * 10 = 5\n"
            "   2  A go  5 + 0.5 * 10 = 10              |  0 + 0.5 * 10 = 5           "
            "<- first difference: 5 + 0.5 * 10 against 0 + 0.5 * 10\n");
}

TEST(ExplainText, WritesUpdatesAsJsonWithTheNextRow) {
  const Mdp mdp = small();
  UpdateTeller teller(mdp, {0, 0, 0.25, 10}, 0.5, UpdateWords::of("standard"));
  Update update = move(1, 0, 0, 0, 1);
  update.best_next = 10;
  update.target = update.new_value = 5;
  JsonWriter json;
  teller.write(json, update, true, 4.0);
  EXPECT_EQ(json.text(),
            R"({"step":1,"state":"A","action":"go","reward":0,"next":"B","terminated":false,)"
            R"("truncated":false,"old":0,"next_q":[{"action":"go","q":0.25},)"
            R"({"action":"end","q":10}],"best_next":10,"target":5,"step_size":1,"new":5,)"
            R"("standard":4})");
  EXPECT_EQ(teller.q()[0], 5);
}

}  // namespace
}  // namespace quoll
