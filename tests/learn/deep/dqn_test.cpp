// Deep Q-learning in small worlds whose values are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../resume.hpp"
#include "../worlds.hpp"
#include "exact_values.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

TEST(Dqn, ALinearNetworkOfOneNumberPerStateFindsTheTable) {
  for (const World& world : {adventure(), star(), corridor(5)}) {
    for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::separate}) {
      LearnSettings settings = network("dqn");
      settings.deep.layout = layout;
      const auto one = learner(settings, world);
      one->advance(10'000, {});
      EXPECT_LT(error_of(world, *one), 1e-4) << world.name;
    }
  }
}

TEST(Dqn, ANetworkThatReadsTheActionFindsItToo) {
  LearnSettings settings = network("dqn");
  settings.deep.layout = NetworkLayout::joint;
  settings.deep.hidden = "32";
  settings.deep.optimiser = "adam";
  settings.deep.learning_rate = "0.005:0.0001:15000";
  settings.deep.reward_scale = 0.01;
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(15'000, {});
  EXPECT_LT(error_of(world, *one), 0.02);
}

TEST(Dqn, SwitchesThatKeepTheFixedPointReachIt) {
  const World world = adventure();
  for (int which = 0; which < 16; ++which) {
    LearnSettings settings = network("dqn");
    settings.deep.double_q = (which & 1) != 0;
    settings.deep.duelling = (which & 2) != 0;
    settings.deep.prioritised = (which & 4) != 0;
    settings.deep.noisy = (which & 8) != 0;
    if (settings.deep.prioritised) {
      settings.deep.priority_correction = "1";
      settings.deep.replay = 200;  // what is forgotten is not drawn
    }
    settings.deep.learning_rate = "0.5";
    const auto one = learner(settings, world);
    one->advance(20'000, {});
    EXPECT_LT(error_of(world, *one), 1e-3) << which;
  }
}

// Noise explores alone, and every cut continues it bit for bit.
TEST(Dqn, NoiseExploresAndIsContinued) {
  const World world = adventure();
  LearnSettings settings = network("dqn");
  settings.explore = "auto";
  settings.deep.noisy = true;
  settings.deep.hidden = "16";
  settings.deep.optimiser = "adam";
  settings.deep.learning_rate = "0.002";
  settings.deep.reward_scale = 0.01;
  settings.deep.double_q = settings.deep.duelling = settings.deep.prioritised = true;
  settings.deep.multi_step = 3;
  const auto whole = learner(settings, world);
  whole->advance(3000, {});
  const Estimates estimates = whole->estimates();
  const std::vector<Action> policy = greedy_policy(estimates);
  EXPECT_EQ(world.mdp->action_name(world.mdp->choice_begin(1) + policy[1]), "To-CAVE");
  for (const std::uint64_t cut : {50u, 101u, 1777u}) {
    const auto first = learner(settings, world);
    first->advance(cut, {});
    const auto second = learner(settings, world);
    ASSERT_NO_FATAL_FAILURE(resume(*first, *second));
    second->advance(3000 - cut, {});
    EXPECT_EQ(saved(*second), saved(*whole)) << cut;
  }
}

// What the target network said of a frame counts until either changes: a learner that goes on from
// what is saved knows nothing of it, and learns the same.
TEST(Dqn, ValuesOfTheTargetAreThoseItWouldSayNow) {
  for (const World& world : {adventure(), corridor(5)}) {
    for (const bool munchausen : {false, true}) {
      LearnSettings settings = network("dqn");
      settings.deep.munchausen = munchausen;
      settings.deep.hidden = "8";
      settings.deep.optimiser = "adam";
      settings.deep.learning_rate = "0.002";
      settings.deep.reward_scale = 0.01;
      settings.deep.walkers = 2;
      settings.deep.multi_step = 2;
      settings.deep.replay = 60;
      settings.deep.learning_starts = 10;
      settings.deep.target_every = 500;
      const auto whole = learner(settings, world);
      whole->advance(1400, {});
      auto part = learner(settings, world);
      for (int cut = 0; cut < 100; ++cut) {
        part->advance(14, {});
        auto next = learner(settings, world);
        ASSERT_NO_FATAL_FAILURE(resume(*part, *next));
        part = std::move(next);
      }
      EXPECT_EQ(saved(*part), saved(*whole)) << world.name << " " << munchausen;
    }
  }
}

TEST(Dqn, DistributionsHaveTheRightMean) {
  const World world = adventure();
  for (const Returns returns : {Returns::categorical, Returns::quantile}) {
    LearnSettings settings = network("dqn");
    settings.deep.returns = returns;
    settings.deep.loss = "auto";
    settings.deep.atoms = 21;
    if (returns == Returns::categorical) {
      settings.deep.lowest_return = 0.0;
      settings.deep.highest_return = 1.0;
    }
    settings.deep.reward_scale = 0.01;
    settings.deep.optimiser = "adam";
    settings.deep.learning_rate = "0.02:0.0005:15000";
    const auto one = learner(settings, world);
    one->advance(15'000, {});
    EXPECT_LT(error_of(world, *one), 0.03) << returns_names[static_cast<int>(returns)];
  }
}

// A prize of 20 one time in ten is worth 2, not the 0 of nearly always.
TEST(Dqn, FindsTheMeanOfWhatFollows) {
  MdpBuilder builder(0.5);
  builder.move("A", "gamble", "END", 0.0, 0.9).move("A", "gamble", "END", 20.0, 0.1);
  builder.move("A", "sure", "END", 1.0);
  const World world = to_world("prize", *builder.start("A").build());
  for (const bool prioritised : {false, true}) {
    LearnSettings settings;
    settings.method = "dqn";
    settings.until_stable = false;
    settings.deep.prioritised = prioritised;
    // Surprising prizes are drawn more often, and count as much less.
    if (prioritised) settings.deep.priority_correction = "1";
    const auto one = learner(settings, world);
    one->advance(30'000, {});
    const Estimates estimates = one->estimates();
    EXPECT_NEAR(estimates.q[0], 2.0, 0.5) << prioritised;
    EXPECT_NEAR(estimates.q[1], 1.0, 0.25) << prioritised;
  }
}

// Q of the equation that Munchausen's targets stand for, one step at a time: Vieillard, Pietquin,
// Geist 2020, equation 1, with its temperature, weight and cut in units of scaled rewards.
std::vector<double> munchausen_values(const World& world, double reward_scale) {
  const Mdp& mdp = *world.mdp;
  const double temperature = 0.03 / reward_scale, least = -1.0 / reward_scale;
  std::vector<double> q(mdp.choices()), value(mdp.states());
  std::vector<double> log_policy(mdp.choices());  // times the temperature
  for (int pass = 0; pass < 2000; ++pass) {
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      const std::uint64_t begin = mdp.choice_begin(s), end = mdp.choice_end(s);
      const double best = *std::max_element(&q[begin], &q[begin] + (end - begin));
      double sum = 0.0;
      for (std::uint64_t c = begin; c < end; ++c) sum += std::exp((q[c] - best) / temperature);
      value[s] = best + temperature * std::log(sum);  // sum of pi (q - log pi)
      for (std::uint64_t c = begin; c < end; ++c) log_policy[c] = q[c] - value[s];
    }
    for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
      q[c] = q_star(mdp, value, c, world.discount) + 0.9 * std::max(log_policy[c], least);
    }
  }
  return q;
}

TEST(Dqn, MunchausenFindsItsOwnFixedPoint) {
  for (const World& world : {adventure(), star(), game()}) {
    for (const Scaling inputs : {Scaling::automatic, Scaling::letters}) {
      LearnSettings settings = network("dqn");
      settings.deep.munchausen = true;
      settings.deep.reward_scale = 0.01;
      settings.deep.learning_rate = "1";
      if (inputs == Scaling::letters) {
        settings.deep.inputs = inputs;
        settings.deep.hidden = "32";
        settings.deep.activation = "tanh";
        settings.deep.layer_norm = Switch::off;
        settings.deep.optimiser = "adam";
        settings.deep.learning_rate = "0.01:0.0001:16000";
      }
      const auto one = learner(settings, world);
      one->advance(20'000, {});
      const std::vector<double> expected = munchausen_values(world, 0.01);
      const Estimates estimates = one->estimates();
      for (std::uint64_t c = 0; c < expected.size(); ++c) {
        EXPECT_NEAR(estimates.q[c], expected[c], 1.0) << world.name << " " << c;
      }
    }
  }
}

// The atoms of C51 reach as far as values do, if nobody says.
TEST(Dqn, DistributionsCoverWhatRewardsAllow) {
  LearnSettings settings = network("dqn");
  settings.deep.returns = Returns::categorical;
  settings.deep.hidden = "16";
  settings.deep.optimiser = "adam";
  settings.deep.loss = "auto";
  settings.deep.learning_rate = "0.005";
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(5000, {});
  EXPECT_LT(error_of(world, *one), 0.05);
}

// Two who move in turn: values from the mover's view, as the table's.
TEST(Dqn, TakesTurns) {
  const World world = game();
  const auto one = learner(network("dqn"), world);
  one->advance(20'000, {});
  EXPECT_LT(error_of(world, *one), 1e-3);
}

}  // namespace
}  // namespace quoll
