// Negative results that are published: what does not work, and beside it what does. Fixed seeds;
// the figures in comments were measured with other seeds.

#include <gtest/gtest.h>

#include <cmath>

#include "../worlds.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

World named(const std::string& name, const Parameters& parameters = {}) {
  return *find_world(name, parameters);
}

LearnSettings exploring(const char* explore, double discount, const char* method = "q-learning") {
  LearnSettings settings;
  settings.method = method;
  settings.explore = explore;
  settings.discount = discount;
  settings.until_stable = false;
  return settings;
}

// The value of the greedy policy from the start, as a share of the optimal one's (V* > 0).
struct Race {
  const World& world;
  std::uint64_t every;  // steps between two looks
  double best = 0.0;
  double discount = 0.0;

  Race(const World& of, double at, std::uint64_t steps) : world(of), every(steps), discount(at) {
    SolveSettings settings;
    settings.discount = discount;
    best = mean(solve(*world.mdp, settings)->lower);
  }
  double mean(const std::vector<double>& value) const {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < world.mdp->start().size(); ++i) {
      sum += world.mdp->start_probability(i) * value[world.mdp->start()[i]];
    }
    return sum;
  }
  double loss(Learner& learner) const {
    const std::vector<Action> policy = greedy_policy(learner.estimates());
    return (best - mean(evaluate(*world.mdp, policy, discount)->lower)) / std::fabs(best);
  }
  // Steps until it loses at most 1 %; 0 = not within `most`.
  std::uint64_t steps(Learner& learner, std::uint64_t most) const {
    for (std::uint64_t t = every; t <= most; t += every) {
      learner.advance(every, {});
      if (loss(learner) <= 0.01) return t;
    }
    return 0;
  }
  std::uint64_t steps(const LearnSettings& settings, std::uint64_t most) const {
    return steps(*learner(settings, world), most);
  }
};

// Deep sea of 10 rows: going right costs, and only ten times right finds the treasure. Once the
// costs are known epsilon-greedy goes left for good; chance finds the treasure each 2^10 falls, and
// hope at once (about 100 falls of 10 steps).
TEST(Traps, EpsilonGreedyWithAZeroTableStaysAshore) {
  const World sea = named("deep-sea", {{"size", "10"}});
  const Race race(sea, 0.99, 500);
  EXPECT_EQ(race.steps(exploring("epsilon-greedy", 0.99), 100'000), 0u);
  EXPECT_GT(race.steps(exploring("uniform", 0.99), 100'000), 2000u);
  LearnSettings hopeful = exploring("greedy", 0.99);
  hopeful.initial_value = "optimistic";
  const std::uint64_t soon = race.steps(hopeful, 100'000);
  EXPECT_GT(soon, 0u);
  EXPECT_LE(soon, 2000u);
  const std::uint64_t also = race.steps(exploring("auto", 0.99, "ucb-q"), 100'000);
  EXPECT_GT(also, 0u);
  EXPECT_LE(also, 2000u);
}

// River swim: 0.005 at home, 1 upstream. Epsilon-greedy stays at home (0.5 of 37.9); chance swims
// through in some 1,500 steps.
TEST(Traps, EpsilonGreedyTakesTheNearestCrumb) {
  const World river = named("river-swim", {{"variant", "osband"}});
  const Race race(river, 0.99, 200);
  EXPECT_EQ(race.steps(exploring("epsilon-greedy", 0.99), 200'000), 0u);
  EXPECT_GT(race.steps(exploring("uniform", 0.99), 20'000), 0u);
}

// A gamble worth 5 (10 or nothing) against a sure 4. Every value begins at 10, and the first step
// has size 1: who loses the first gamble never gambles again, one half of all seeds, and later
// losses add to them.
TEST(Traps, OneUnluckySampleIsFinalForOptimisticValues) {
  MdpBuilder builder(0.5);
  builder.move("S", "gamble", "END", 10, 0.5).move("S", "gamble", "END", 0, 0.5);
  builder.move("S", "sure", "END", 4);
  const World world = to_world("gamble", *builder.build());
  int stuck = 0, stuck_by_chance = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    LearnSettings hopeful = exploring("greedy", 0.0);
    hopeful.initial_value = "optimistic";
    hopeful.seed = seed;
    const auto one = learner(hopeful, world);
    one->advance(5000, {});
    stuck += greedy_policy(one->estimates())[0] == 1;
    hopeful.explore = "uniform";
    const auto other = learner(hopeful, world);
    other->advance(5000, {});
    stuck_by_chance += greedy_policy(other->estimates())[0] == 1;
  }
  EXPECT_GE(stuck, 40);
  EXPECT_EQ(stuck_by_chance, 0);
}

// The same on the ice: with steps of 1/N^0.8 hope has gone after 300,000 steps while the policy
// still loses much (three seeds after 1,000,000: 20, 26 and 69 %); steps of (H + 1) / (H + N)
// forget the early samples more slowly than they are made, and get there.
TEST(Traps, OptimisticValuesUnderNoiseDependOnTheStepSize) {
  const World lake = named("frozen-lake", {{"map", "8x8"}});
  const Race race(lake, lake.discount, 5000);
  LearnSettings hopeful = exploring("greedy", 0.0);
  hopeful.initial_value = "optimistic";
  hopeful.step_size = "1/N^0.8";
  EXPECT_EQ(race.steps(hopeful, 300'000), 0u);
  hopeful.step_size = "auto";
  EXPECT_GT(race.steps(hopeful, 300'000), 0u);
}

// The horizon in the step size of UCB-Q is part of its proof: a tenth of it, and the hope is gone
// before it has travelled. Full H: 240,000 to 440,000 steps on the small lake.
TEST(Traps, UcbQWithAShortenedHorizonFails) {
  const World lake = named("frozen-lake");
  const Race race(lake, lake.discount, 5000);
  const LearnSettings settings = exploring("auto", 0.0, "ucb-q");
  EXPECT_GT(race.steps(settings, 1'000'000), 0u);
  LearnSetup shortened = *resolve(settings, lake);
  ASSERT_NEAR(shortened.step_size.value, 100.0, 1e-9);
  shortened.step_size.value *= 0.1;
  EXPECT_EQ(race.steps(*(*find_learner(settings))->make(shortened), 1'000'000), 0u);
}

// Traces are cut where the behaviour is not greedy: with actions by chance there is nothing left to
// gain (factor 1.0 over seeds), with epsilon-greedy 1.45.
TEST(Traps, WatkinsTracesAreUselessWithUniformBehaviour) {
  const World maze = named("maze", {{"size", "10"}, {"seed", "2"}});
  const Race race(maze, 0.95, 100);
  const auto factor = [&](const char* explore) {
    double log_factor = 0.0;
    constexpr int seeds = 5;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      double steps[2] = {};
      for (const int traces : {0, 1}) {
        LearnSettings settings = exploring(explore, 0.95, traces == 1 ? "q-lambda" : "q-learning");
        settings.step_size = "0.1";
        settings.seed = seed;
        steps[traces] = static_cast<double>(race.steps(settings, 200'000));
        EXPECT_GT(steps[traces], 0.0);
      }
      log_factor += std::log(steps[0] / steps[1]) / seeds;
    }
    return std::exp(log_factor);
  };
  EXPECT_GT(factor("epsilon-greedy"), 1.3);
  EXPECT_LT(factor("uniform"), 1.15);
}

}  // namespace
}  // namespace quoll
