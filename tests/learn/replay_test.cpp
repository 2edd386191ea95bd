// The slides' trace, number by number, by the rules' own code.

#include "quoll/learn/tabular/replay.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "quoll/learn/learner.hpp"

namespace quoll {
namespace {

struct Lesson {
  World world;
  LearnSetup setup;
  const LearnerEntry* entry = nullptr;
};

Lesson lesson(const std::string& rule, bool zero_rewards = false) {
  Lesson out;
  out.world = *find_world("adventure");
  LearnSettings settings;
  settings.rule = rule;
  std::vector<double> rewards;
  if (zero_rewards) rewards.assign(out.world.mdp->choices(), 0.0);
  out.setup = *resolve(settings, out.world, rewards);
  out.entry = *find_learner(settings);
  return out;
}

std::vector<Update> script(const Mdp& mdp,
                           const std::vector<std::pair<std::string, std::string>>& moves) {
  std::vector<Update> out;
  for (const auto& [state, action] : moves) {
    Update update;
    update.step = out.size() + 1;
    update.state = *mdp.find_state(state);
    std::uint64_t c = mdp.choice_begin(update.state);
    while (mdp.action_name(c) != action) ++c;
    update.action = static_cast<Action>(c - mdp.choice_begin(update.state));
    update.next = mdp.next(mdp.outcome_begin(c));
    update.reward = mdp.reward(c);
    update.terminated = mdp.terminal(update.next);
    out.push_back(update);
  }
  return out;
}

std::vector<double> new_values(const Lesson& lesson, std::size_t revisits) {
  std::vector<std::pair<std::string, std::string>> moves{
      {"HALL", "To-CAVE"}, {"CAVE", "To-GOAL"}, {"HALL", "To-CAVE"}};
  moves.insert(moves.end(), revisits, {"HALL", "To-CAVE"});
  std::vector<double> values;
  Lesson here = lesson;
  here.setup.world = &here.world;
  for (const Update& update : here.entry->replay(here.setup, script(*here.world.mdp, moves))) {
    values.push_back(update.new_value);
  }
  return values;
}

// Slides: 0 + 0.8 max{0, 0, 0} = 0; 100 + 0.8 * 0 = 100; 0 + 0.8 max{100, 0, 0} = 80.
TEST(Replay, GivesTheTraceOfTheSlides) {
  EXPECT_EQ(new_values(lesson("standard"), 2), (std::vector<double>{0, 100, 80, 80, 80}));
  EXPECT_EQ(new_values(lesson("reward-estimate"), 2), (std::vector<double>{0, 100, 80, 80, 80}));
  EXPECT_EQ(new_values(lesson("as-printed"), 0), (std::vector<double>{0, 100, 80}));
}

// rE holds the future already: 80 + 0.8 * 100 = 160, 240, ...; the first above 100 / (1 - 0.8) =
// 500 is 480 + 80 = 560, at the seventh visit that sees CAVE's 100.
TEST(Replay, AsPrintedCountsTheFutureAgain) {
  EXPECT_EQ(new_values(lesson("as-printed"), 6),
            (std::vector<double>{0, 100, 80, 160, 240, 320, 400, 480, 560}));
}

// The rule never reads the observed reward: from rE = 0 every value is 0 + 0.8 * 0.
TEST(Replay, AsPrintedLearnsNothingFromZeroRewards) {
  EXPECT_EQ(new_values(lesson("as-printed", true), 6), std::vector<double>(9, 0.0));
}

// The numbers of the update that taught 80, each as the slide writes it.
TEST(Replay, FillsEveryNumberOfAnUpdate) {
  Lesson here = lesson("standard");
  here.setup.world = &here.world;
  const auto updates = here.entry->replay(
      here.setup, script(*here.world.mdp, {{"CAVE", "To-GOAL"}, {"HALL", "To-CAVE"}}));
  EXPECT_EQ(updates[0].best_next, 0);
  EXPECT_EQ(updates[0].reward, 100);
  EXPECT_TRUE(updates[0].terminated);
  EXPECT_EQ(updates[1].old_value, 0);
  EXPECT_EQ(updates[1].best_next, 100);
  EXPECT_EQ(updates[1].target, 80);
  EXPECT_EQ(updates[1].step_size, 1);
  EXPECT_EQ(updates[1].step, 2U);
}

}  // namespace
}  // namespace quoll
