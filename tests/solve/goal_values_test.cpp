// Probabilities of reaching a goal, and rewards until then.

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "quoll/model/formats/format.hpp"
#include "quoll/model/goal.hpp"
#include "quoll/solve/defined_part.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

constexpr double width = 1e-9;

Mdp read(const Result<Mdp>& mdp) {
  if (!mdp) {
    ADD_FAILURE() << message(mdp.error());
    std::abort();
  }
  return *mdp;
}

struct Answer {
  DefinedPart outside;
  Solution solution;
};

Answer solved(const Mdp& mdp, const Goal& goal) {
  const Mdp aimed = read(aim(mdp, goal));
  Answer answer;
  if (!goal.rewards.empty()) {
    auto outside = defined_part(aimed, !goal.minimise);
    if (!outside) {
      ADD_FAILURE() << message(outside.error());
      std::abort();
    }
    answer.outside = *std::move(outside);
  }
  SolveSettings settings;
  settings.width = width;
  settings.maximise = !goal.minimise;
  // The parts outside may hold the start, which the solver does not mind as they are ends.
  auto solution = solve(answer.outside.part ? *answer.outside.part : aimed, settings);
  if (!solution) {
    ADD_FAILURE() << message(solution.error());
    std::abort();
  }
  answer.solution = *std::move(solution);
  answer.outside.fill(!goal.minimise, answer.solution);
  return answer;
}

// The value of state 0 lies in the interval and the interval is as narrow as asked.
void expect_value(const Mdp& mdp, const Goal& goal, double value) {
  const Solution solution = solved(mdp, goal).solution;
  const State start = mdp.start()[0];
  const std::string what = goal.states + " " + goal.rewards + (goal.minimise ? " min" : " max");
  constexpr double rounding = 1e-15;
  EXPECT_LE(solution.lower[start], value + rounding * value) << what;
  EXPECT_GE(solution.upper[start], value - rounding * value) << what;
  EXPECT_LE(solution.upper[start] - solution.lower[start], 2 * width) << what;
}

// A die thrown with a coin (Knuth and Yao 1976): each face is reached with probability 1/6, after
// 11/3 throws on average.
const std::string die =
    "@type: DTMC\n@reward_models\nflips\n@nr_states\n13\n@model\n"
    "state 0 [1] init\n1 : 1/2\n2 : 1/2\nstate 1 [1]\n3 : 1/2\n4 : 1/2\n"
    "state 2 [1]\n5 : 1/2\n6 : 1/2\nstate 3 [1]\n1 : 1/2\n7 : 1/2\n"
    "state 4 [1]\n8 : 1/2\n9 : 1/2\nstate 5 [1]\n10 : 1/2\n11 : 1/2\n"
    "state 6 [1]\n2 : 1/2\n12 : 1/2\nstate 7 one done\n7 : 1\nstate 8 done\n8 : 1\n"
    "state 9 done\n9 : 1\nstate 10 done\n10 : 1\nstate 11 done\n11 : 1\nstate 12 six done\n12 : "
    "1\n";

TEST(GoalValues, ADieFromACoin) {
  const Mdp mdp = read(parse_model(die, "die.drn"));
  for (const bool minimise : {false, true}) {
    expect_value(mdp, {"one", "", minimise}, 1.0 / 6);
    expect_value(mdp, {"one | six", "", minimise}, 1.0 / 3);
    expect_value(mdp, {"done & !six", "", minimise}, 5.0 / 6);
    expect_value(mdp, {"done", "flips", minimise}, 11.0 / 3);
  }
}

// 0: risk (1/2 to the goal 3, 1/2 to the trap 2), or to 1 and back without end; 1: back, or risk
// with 3/4.
const std::string loops =
    "@type: MDP\n@reward_models\ntime loss\n@nr_states\n4\n@model\n"
    "state 0 init\n\taction risk [1,-1]\n\t\t3 : 0.5\n\t\t2 : 0.5\n\taction on [1,-1]\n\t\t1 : 1\n"
    "state 1\n\taction back [1,-1]\n\t\t0 : 1\n\taction risk [1,-1]\n\t\t3 : 0.75\n\t\t2 : 0.25\n"
    "state 2 trap\n\taction stay [1,-1]\n\t\t2 : 1\nstate 3 goal\n\taction stay [0,0]\n\t\t3 : 1\n";

TEST(GoalValues, LoopsWithoutRewardDeceiveNobody) {
  const Mdp mdp = read(parse_model(loops, "loops.drn"));
  expect_value(mdp, {"goal", "", false}, 0.75);
  expect_value(mdp, {"goal", "", true}, 0.0);
  expect_value(mdp, {"trap", "", false}, 0.5);
  expect_value(mdp, {"goal | trap", "", false}, 1.0);
  expect_value(mdp, {"goal | trap", "", true}, 0.0);
  expect_value(mdp, {"goal | trap", "time", true}, 1.0);
}

TEST(GoalValues, InfiniteRewardsAreNamed) {
  const Mdp mdp = read(parse_model(loops, "loops.drn"));
  // No policy reaches the goal with probability 1.
  const Answer least = solved(mdp, {"goal", "time", true});
  EXPECT_EQ(least.outside.endless, (std::vector<State>{0, 1, 2}));
  EXPECT_EQ(least.solution.lower[0], infinity);
  EXPECT_EQ(least.solution.upper[3], 0.0);
  // To and fro, time passes for ever.
  const Answer most = solved(mdp, {"goal | trap", "time", false});
  EXPECT_EQ(most.outside.boundless, (std::vector<State>{0, 1}));
  EXPECT_TRUE(most.outside.endless.empty());
  EXPECT_EQ(most.solution.lower[0], infinity);
  // The same as a loss: the best way is the shortest.
  expect_value(mdp, {"goal | trap", "loss", false}, -1.0);
  EXPECT_EQ(solved(mdp, {"goal | trap", "loss", true}).solution.upper[0], -infinity);
  // 1 and 3 stay defined where only some states are not.
  const Answer trap = solved(mdp, {"3", "loss", false});
  EXPECT_EQ(trap.outside.endless, (std::vector<State>{0, 1, 2}));
  EXPECT_EQ(trap.solution.upper[0], -infinity);
}

TEST(GoalValues, ChoicesThatMayMissTheGoalAreLeftOut) {
  // 0: sure, 5 moves' worth of time; or 1 move that may end in the trap 1.
  const Mdp mdp = read(
      parse_model("@type: MDP\n@reward_models\ntime\n@nr_states\n3\n@model\nstate 0 init\n"
                  "\taction risk [1]\n\t\t1 : 0.1\n\t\t2 : 0.9\n\taction sure [5]\n\t\t2 : 1\n"
                  "state 1\n\taction stay [1]\n\t\t1 : 1\nstate 2 goal\n\taction stay\n\t\t2 : 1\n",
                  "w.drn"));
  expect_value(mdp, {"goal", "time", true}, 5.0);
  const Answer answer = solved(mdp, {"goal", "time", true});
  EXPECT_EQ(answer.outside.part->action_name(0), "sure");
  EXPECT_EQ(answer.solution.lower[1], infinity);
  // The same where the trap has no choice at all.
  const Mdp dead =
      read(parse_model("@type: MDP\n@reward_models\ntime\n@nr_states\n3\n@model\nstate 0 init\n"
                       "\taction risk [1]\n\t\t1 : 0.1\n\t\t2 : 0.9\n\taction sure [5]\n\t\t2 : 1\n"
                       "state 1\nstate 2 goal\n",
                       "w.drn"));
  expect_value(dead, {"goal", "time", true}, 5.0);
}

// Models that others publish with their answers, where a folder holds them.
std::optional<Mdp> published(const std::string& file, const Parameters& given = {}) {
  const char* folder = std::getenv("QUOLL_MODELS");
  if (folder == nullptr) return std::nullopt;
  return read(read_model(folder + ("/" + file), given));
}

TEST(GoalValues, PublishedDice) {
  const auto tra = published("two_dice.tra");
  if (!tra) GTEST_SKIP() << "QUOLL_MODELS is not set";
  for (const Mdp& mdp : {*tra, *published("two_dice.drn")}) {
    EXPECT_EQ(mdp.states(), 169u);
    EXPECT_EQ(mdp.outcomes(), 436u);
    for (const bool minimise : {false, true}) {
      expect_value(mdp, {"two", "", minimise}, 1.0 / 36);
      expect_value(mdp, {"three", "", minimise}, 2.0 / 36);
      expect_value(mdp, {"four", "", minimise}, 3.0 / 36);
    }
  }
  const auto moves = published(
      "two_dice.tra",
      {{"rewards", std::string(std::getenv("QUOLL_MODELS")) + "/two_dice.flip.trans.rew"}});
  for (const bool minimise : {false, true}) {
    expect_value(*tra, {"done", "flip", minimise}, 44.0 / 3);
    expect_value(*moves, {"done", "flip", minimise}, 22.0 / 3);
    expect_value(*published("two_dice.drn"), {"done", "coinflips", minimise}, 22.0 / 3);
  }
}

TEST(GoalValues, PublishedRobot) {
  const auto mdp = published("robot.tra");
  if (!mdp) GTEST_SKIP() << "QUOLL_MODELS is not set";
  expect_value(*mdp, {"goal1 | goal2", "reward", true}, 1.2);
  expect_value(*mdp, {"goal1 | goal2", "reward", false}, 3.5);
  expect_value(*mdp, {"goal2", "reward", true}, 19.0 / 15);
  EXPECT_EQ(solved(*mdp, {"goal2", "reward", false}).solution.lower[0], infinity);
  EXPECT_EQ(solved(*mdp, {"goal1", "reward", false}).solution.lower[0], infinity);
  EXPECT_EQ(solved(*mdp, {"goal1", "reward", true}).solution.lower[0], infinity);
}

TEST(GoalValues, PublishedConsensus) {
  const auto mdp = published("consensus2_K2.tra");
  if (!mdp) GTEST_SKIP() << "QUOLL_MODELS is not set";
  expect_value(*mdp, {"finished & all_coins_equal_1", "", true}, 49.0 / 128);
  expect_value(*mdp, {"finished & !agree", "", false}, 13.0 / 120);
  expect_value(*mdp, {"finished", "steps", false}, 75.0);
  expect_value(*mdp, {"finished", "steps", true}, 48.0);
}

}  // namespace
}  // namespace quoll
