#include "quoll/experiment/entrant.hpp"

#include <gtest/gtest.h>

#include "../learn/worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

std::string refusal(const char* words, RaceMode mode = RaceMode::start) {
  const Result<std::vector<Entrant>> entrants = parse_entrants(words, mode);
  return entrants ? "none" : message(entrants.error());
}

TEST(Entrants, AWordIsAMethodAndItsSettings) {
  const std::vector<Entrant> entrants = *parse_entrants(
      "q-learning, q-learning:explore=epsilon-greedy:epsilon=1:0.05:10000:initial-value=optimistic",
      RaceMode::start);
  ASSERT_EQ(entrants.size(), 2u);
  EXPECT_EQ(entrants[0].word, "q-learning");
  EXPECT_FALSE(entrants[0].settings.until_stable);
  const LearnSettings& settings = entrants[1].settings;
  EXPECT_EQ(settings.explore, "epsilon-greedy");
  EXPECT_EQ(settings.epsilon, "1:0.05:10000");
  EXPECT_EQ(settings.initial_value, "optimistic");
}

TEST(Entrants, TheModeDecidesWhereEpisodesBegin) {
  EXPECT_EQ(parse_entrant("q-learning", RaceMode::start)->settings.start, "world");
  EXPECT_NE(parse_entrant("q-learning", RaceMode::all)->settings.start, "world");
  EXPECT_EQ(parse_entrant("q-learning:start=uniform", RaceMode::all)->settings.start, "uniform");
  EXPECT_EQ(refusal("q-learning:start=uniform"),
            "--methods: start=uniform chooses start states; only --mode all allows that");
}

TEST(Entrants, ErrorsNameTheNearest) {
  EXPECT_EQ(refusal("q-lerning"),
            "--methods: no method 'q-lerning'; see 'quoll list methods'; did you mean "
            "'q-learning'?");
  EXPECT_EQ(refusal("q-learning:explor=greedy"),
            "--methods: no setting 'explor'; did you mean 'explore'?");
  EXPECT_EQ(refusal("q-learning:ties=frist"),
            "--methods ties: one of uniform | first expected, not 'frist'; did you mean 'first'?");
  EXPECT_EQ(refusal("q-learning:greedy"),
            "--methods: method:key=value:key=value expected, not 'greedy'");
  EXPECT_EQ(refusal("q-learning:"),
            "--methods: method:key=value:key=value expected, not 'q-learning:'");
  EXPECT_EQ(refusal("q-learning:seed=3"),
            "--methods: seed is the same for all who race: it stands in no word");
  EXPECT_EQ(refusal("q-learning,q-learning"), "--methods: q-learning stands twice");
  EXPECT_EQ(refusal("q-learning,,"),
            "--methods: a list such as q-learning,dyna-q expected, not 'q-learning,,'");
  EXPECT_EQ(refusal("lecture"), "--methods: the lecture's method always runs: name the others");
  EXPECT_EQ(refusal("q-learning:rule=as-printed"),
            "--methods: the rule as-printed exists to be studied, it does not race");
}

TEST(Entrants, EveryMethodThatLearnsWhatItShouldRacesInBothModes) {
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    const std::vector<Entrant> entrants = all_entrants(mode);
    for (const LearnerEntry& entry : learners()) {
      std::size_t count = 0;
      for (const Entrant& one : entrants) count += one.word == entry.method;
      if (entry.traits.approximates)
        EXPECT_EQ(count, 0u) << entry.method;
      else
        EXPECT_EQ(count, entry.sound ? 1u : count) << entry.method;
    }
  }
}

TEST(Entrants, TheCompleteWordGivesTheSameSettings) {
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    std::vector<Entrant> entrants = all_entrants(mode);
    entrants.push_back(*parse_entrant("q-learning:step-size=1/N^0.6:epsilon=1:0.1:50", mode));
    for (const Entrant& one : lecture_entrants(adventure(), mode, 0.8)) entrants.push_back(one);
    for (Entrant& entrant : entrants) {
      const std::string word = complete_word(entrant.settings);
      Result<Entrant> again = parse_entrant(word, mode);
      ASSERT_TRUE(again) << word << ": " << message(again.error());
      const std::vector<Setting> one = settings_of(entrant.settings);
      const std::vector<Setting> other = settings_of(again->settings);
      for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(text_of(one[i]), text_of(other[i])) << word << ' ' << one[i].name;
      }
    }
  }
}

TEST(Entrants, TheLecturesMethodFollowsTheWorld) {
  const std::vector<Entrant> from_start = lecture_entrants(adventure(), RaceMode::start, 0.8);
  ASSERT_EQ(from_start.size(), 1u);
  EXPECT_EQ(from_start[0].settings.step_size, "1");
  EXPECT_EQ(from_start[0].settings.explore, "uniform");
  EXPECT_EQ(from_start[0].settings.episode_steps, 2000u);
  const std::vector<Entrant> from_all = lecture_entrants(lottery(), RaceMode::all, 0.8);
  ASSERT_EQ(from_all.size(), 2u);
  EXPECT_EQ(from_all[0].settings.step_size, "1/N^0.6");
  EXPECT_EQ(from_all[0].settings.start, "uniform");
  EXPECT_EQ(from_all[0].settings.episode_steps, 2000u);
  EXPECT_EQ(from_all[1].settings.episode_steps, 5u);  // 1 / (1 - 0.8)
  EXPECT_EQ(lecture_entrants(lottery(), RaceMode::all, 1.0)[1].settings.episode_steps, 32u);
}

}  // namespace
}  // namespace quoll
