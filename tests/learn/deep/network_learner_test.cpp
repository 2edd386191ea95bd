#include "quoll/learn/deep/network_learner.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "../worlds.hpp"
#include "quoll/env/dynamics.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// 0 offers three actions, 1 offers one.
World uneven() {
  MdpBuilder builder(0.9);
  builder.move("0", "a", "1").move("0", "b", "0", 1.0).move("0", "c", "END", 5.0);
  builder.move("1", "back", "0", 2.0);
  return to_world("uneven", *builder.start("0").build());
}

LearnSettings untaught(const std::string& method) {
  LearnSettings settings;
  settings.method = method;
  settings.until_stable = false;
  settings.deep.hidden = "8";
  settings.deep.learning_rate = "0";
  return settings;
}

TEST(NetworkLearner, CountsVisitsOfThePairsThatThereAre) {
  const World world = uneven();
  for (const char* method : {"dqn", "pqn", "nfq", "stream-q"}) {
    const auto one = learner(untaught(method), world);
    const std::uint64_t steps = one->advance(320, {}).steps;
    const Estimates estimates = one->estimates();
    ASSERT_EQ(estimates.visits.size(), world.mdp->choices()) << method;
    EXPECT_EQ(std::accumulate(estimates.visits.begin(), estimates.visits.end(), std::uint64_t{0}),
              steps)
        << method;
    for (const std::uint64_t visits : estimates.visits) EXPECT_GT(visits, 0u) << method;
  }
}

// Values that are learned at half their size are weighed at their own.
TEST(NetworkLearner, TemperaturesAreInUnitsOfTheWorldsValues) {
  const World world = uneven();
  for (const bool softmax : {true, false}) {
    std::vector<std::uint64_t> visits[3];
    for (int k = 0; k < 3; ++k) {
      LearnSettings settings = untaught("pqn");
      settings.explore = softmax ? "softmax" : "mellowmax";
      // The same network says twice as much of the world if it learned half: at twice the
      // temperature, or half the omega, that is the same policy. The third is another one.
      settings.deep.reward_scale = k == 0 ? 1.0 : 0.5;
      if (softmax) settings.temperature = k == 1 ? "0.2" : "0.1";
      if (!softmax) settings.omega = k == 1 ? 4.0 : 8.0;
      const auto one = make_learner(settings, world);
      ASSERT_TRUE(one) << message(one.error());
      (*one)->advance(2000, {});
      const Estimates estimates = (*one)->estimates();
      visits[k].assign(estimates.visits.begin(), estimates.visits.end());
    }
    EXPECT_EQ(visits[0], visits[1]) << softmax;
    EXPECT_NE(visits[0], visits[2]) << softmax;
  }
}

// Numbered and seen at once; the second of its two places offers one action less.
struct Shown {
  using Position = State;
  Spaces spaces() const { return {.actions = 2, .states = 2, .observation = 1}; }
  Position start(auto&) const { return 0; }
  Feedback step(Position& at, Action, auto&) const {
    at = 1 - at;
    return {.reward = 1.0F};
  }
  State number(const Position& at) const { return at; }
  void observe(const Position& at, std::span<float> x) const { x[0] = static_cast<float>(at); }
  Action actions(State s) const { return 2 - s; }
};

TEST(NetworkLearner, RefusesWhatNumbersDoNotTell) {
  const World world = to_world("shown", Shown{}, 0.9);
  for (const char* method : {"dqn", "pqn", "nfq", "stream-q"}) {
    const auto one = make_learner(untaught(method), world);
    ASSERT_FALSE(one) << method;
    EXPECT_EQ(message(one.error()),
              "--method: networks read the numbers that shown shows, and not which of its actions "
              "a state has; a world with the same actions everywhere expected");
  }
  EXPECT_TRUE(make_learner({}, world));  // by a table
}

}  // namespace
}  // namespace quoll
