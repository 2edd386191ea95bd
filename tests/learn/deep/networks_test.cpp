// What every method that teaches a network keeps.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "../worlds.hpp"
#include "exact_values.hpp"
#include "quoll/learn/deep/learned_network.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// What a network says of what was never tried is an answer, too; in an end nobody acts.
TEST(Networks, ActWhereNothingWasTried) {
  for (const char* const method : {"dqn", "pqn", "nfq", "stream-q"}) {
    for (const World& world : {adventure(), without_model(slippery(5))}) {
      LearnSettings settings;
      settings.method = method;
      settings.until_stable = false;
      const auto one = learner(settings, world);
      const Estimates estimates = one->estimates();
      const std::vector<Action> policy = greedy_policy(estimates);
      const auto environment = world.make({});
      for (State s = 0; s < policy.size(); ++s) {
        EXPECT_EQ(policy[s] == no_action, environment->actions(s) == 0) << world.name << " " << s;
      }
    }
  }
}

// Once nothing is explored, every episode is the best one.
TEST(Networks, ActGreedilyOnceEpsilonIsZero) {
  const World world = corridor(5);
  for (const char* const method : {"dqn", "pqn", "nfq", "stream-q"}) {
    LearnSettings settings;
    settings.method = method;
    settings.until_stable = false;
    settings.epsilon = "1:0:6000";
    const auto one = learner(settings, world);
    one->advance(8000, {});
    one->advance(200, {});
    EXPECT_GT(one->finished().size(), 10u) << method;
    for (const FinishedEpisode& episode : one->finished()) EXPECT_EQ(episode.steps, 5u) << method;
  }
}

// What is given away says what was learned, in units of the world.
TEST(Networks, WhatIsExportedSaysWhatWasLearned) {
  const World world = star();
  for (const char* const method : {"dqn", "pqn", "nfq", "stream-q"}) {
    LearnSettings settings;
    settings.method = method;
    settings.until_stable = false;
    settings.deep.reward_scale = 0.125;
    const auto one = learner(settings, world);
    one->advance(500, {});
    const Estimates estimates = one->estimates();
    const std::shared_ptr<const LearnedNetwork> network = one->network();
    if (settings.method != "stream-q") EXPECT_EQ(network->value_scale, 0.125) << method;
    for (State s = 0; s < world.mdp->states(); ++s) {
      std::vector<float> values(network->actions);
      network->values(s, {}, values);
      for (Action a = 0; a < world.mdp->actions(s); ++a) {
        EXPECT_FLOAT_EQ(values[a], static_cast<float>(estimates.q[world.mdp->choice_begin(s) + a]))
            << method << " " << s;
      }
    }
  }
}

TEST(Networks, StopWhereNumbersGrowWithoutEnd) {
  for (const char* const method : {"dqn", "pqn", "nfq"}) {
    LearnSettings settings = network(method);
    settings.deep.learning_rate = "1000";
    if (settings.method == "nfq") settings.deep.train_every = 100;
    const auto one = learner(settings, adventure());
    EXPECT_EQ(one->advance(5'000, {}).halt, LearnProgress::Halt::diverged) << method;
    EXPECT_LT(one->progress().steps, 5'000u) << method;
  }
}

// Named outputs reach the table too, where states list other actions in other orders.
TEST(Networks, OutputsOfNamesFindTheTable) {
  for (const World& world : {adventure(), star(), game()}) {
    for (const char* const method : {"dqn", "nfq", "pqn", "stream-q"}) {
      LearnSettings settings = network(method);
      settings.deep.inputs = Scaling::letters;
      if (settings.method == "dqn") {
        settings.deep.double_q = true;
        settings.deep.train_every = 4;
      } else if (settings.method == "nfq") {
        settings.deep.train_every = 1000;
        settings.deep.fits = 5;
      } else if (settings.method == "pqn") {
        settings.deep.return_decay = 0.0;
        settings.deep.rollout = 2;
      } else {
        settings.deep.optimiser = settings.deep.loss = "auto";
        settings.deep.clip_gradient = -1.0;
      }
      settings.deep.hidden = "32";
      settings.deep.activation = "tanh";
      settings.deep.layer_norm = Switch::off;
      if (settings.method != "stream-q") settings.deep.optimiser = "adam";
      settings.deep.learning_rate = "0.01:0.0001:8000";
      settings.deep.reward_scale = 0.01;
      const auto one = learner(settings, world);
      one->advance(8000, {});
      EXPECT_LT(error_of(world, *one), 0.05) << world.name << ", " << method;
    }
  }
}

}  // namespace
}  // namespace quoll
