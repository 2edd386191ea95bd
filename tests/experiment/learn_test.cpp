#include "quoll/experiment/learn.hpp"

#include <gtest/gtest.h>

#include "../learn/worlds.hpp"
#include "quoll/base/raise.hpp"

namespace quoll {
namespace {

TEST(Learn, GivesThePolicyAndItsValuesByName) {
  const Learned learned = learn(world("adventure"));
  EXPECT_EQ(learned.q("CAVE", "To-GOAL"), 100.0);
  EXPECT_EQ(learned.q("HALL", "To-CAVE"), 80.0);
  EXPECT_EQ(learned.best("HALL"), "To-CAVE");
  EXPECT_EQ(learned.best("GOAL"), "");
  EXPECT_TRUE(learned.optimal());
  const State cave = *learned.world().mdp->find_state("CAVE");
  EXPECT_EQ(learned.q(cave, learned.policy()(cave)), 100.0);
  EXPECT_GT(learned.visits(cave, 0), 0u);
}

TEST(Learn, RaisesWhatIsWrong) {
  const auto message_of = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const Exception& exception) {
      return exception.what();
    }
    return "nothing raised";
  };
  const auto has = [&](const auto& call, const char* text) {
    EXPECT_NE(message_of(call).find(text), std::string::npos) << message_of(call);
  };
  has([] { return world("adventrue"); }, "adventure");
  has([] { return world("empty", MdpBuilder(0.9)); }, "");
  const Learned learned = learn(world("adventure"));
  has([&] { return learned.best("KAVE"); }, "CAVE");
  has([&] { return learned.q("CAVE", "To-GAOL"); }, "To-GOAL");
  has([&] { return learned.q(99, 0); }, "no action 0 in state 99");
  has([&] { return learned.q(~State{0}, 0); }, "no action");
  LearnSettings settings;
  settings.explore = "gready";
  has([&] { return learn(world("adventure"), settings); }, "greedy");
  RunSettings run;
  run.time = "soon";
  has([&] { return learn(world("adventure"), run); }, "duration");
  run.time.clear();
  run.until = "bored";
  has([&] { return learn(world("adventure"), run); }, "stable");
}

// What `quoll learn WORLD` settles on.
TEST(Learn, ChoosesWhatTheCommandLineChooses) {
  const Learned open = learn(world("frozen-lake"));
  ASSERT_TRUE(open.choice());
  EXPECT_EQ(open.choice()->options(), "--method empirical-model --start each-pair");
  LearnSettings settings;
  settings.method = "auto";
  settings.start = "uniform";
  const Learned halfway = learn(world("frozen-lake"), settings);
  EXPECT_EQ(halfway.choice()->options(), "--method empirical-model --start uniform");
  settings.method = "q-learning";
  EXPECT_FALSE(learn(world("adventure"), settings).choice());
}

TEST(Learn, WorksWithoutAModel) {
  RunSettings settings;
  settings.steps = 20'000;
  const World source = world("adventure");
  const Learned learned = learn(learn_tests::without_model(source), settings);
  const State cave = *source.mdp->find_state("CAVE");
  EXPECT_EQ(learned.q(cave, learned.policy()(cave)), 100.0);
  EXPECT_FALSE(learned.optimal());
  EXPECT_THROW(learned.best("CAVE"), Exception);
}

}  // namespace
}  // namespace quoll
