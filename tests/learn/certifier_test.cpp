// Certificates from experience: true whenever given, and given at the same step whether or not a
// model stands behind the steps.

#include "quoll/learn/certifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/solver.hpp"
#include "worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

TEST(KlInterval, HasTheClosedFormsAtTheEdges) {
  // Never seen in n = 10 with level 3: 1 - q >= exp(-3 / 10).
  const auto never = kl_interval(0.0, 0.3);
  EXPECT_EQ(never.first, 0.0);
  EXPECT_NEAR(never.second, 1.0 - std::exp(-0.3), 1e-9);
  const auto always = kl_interval(1.0, 0.3);
  EXPECT_NEAR(always.first, std::exp(-0.3), 1e-9);
  EXPECT_EQ(always.second, 1.0);
}

TEST(KlInterval, EndsWhereTheDivergenceReachesTheLevel) {
  const auto kl = [](double p, double q) {
    return p * std::log(p / q) + (1 - p) * std::log((1 - p) / (1 - q));
  };
  for (const double p : {0.1, 0.5, 0.75}) {
    const auto [low, high] = kl_interval(p, 0.02);
    EXPECT_NEAR(kl(p, low), 0.02, 1e-9);
    EXPECT_NEAR(kl(p, high), 0.02, 1e-9);
    EXPECT_LT(low, p);
    EXPECT_GT(high, p);
    // Outward: never inside.
    EXPECT_GE(kl(p, low), 0.02);
    EXPECT_GE(kl(p, high), 0.02);
  }
}

struct Certified {
  std::uint64_t steps = 0;
  ExperienceCertificate certificate;
};

// Steps until the goal is reached, at most `most`; look(certifier) after each check.
template <class Look>
Certified run(const LearnSettings& settings, const World& world, const CertifyGoal& goal,
              std::uint64_t most, const Look& look) {
  const auto setup = resolve(settings, world);
  EXPECT_TRUE(setup) << (setup ? "" : message(setup.error()));
  Result<Certifier> certifier = Certifier::make(*setup, goal);
  EXPECT_TRUE(certifier) << (certifier ? "" : message(certifier.error()));
  const auto one = learner(settings, world);
  std::vector<Update> log(1000);
  std::uint64_t steps = 0;
  while (steps < most) {
    const std::uint64_t chunk = std::min<std::uint64_t>(certifier->due() - steps, log.size());
    const LearnProgress now = one->advance(chunk, std::span(log).first(chunk));
    certifier->observe(std::span(log).first(now.logged));
    steps = now.steps;
    if (steps < certifier->due()) continue;
    const bool reached = certifier->check();
    look(*certifier);
    if (reached) break;
  }
  return {steps, certifier->certificate()};
}

LearnSettings directed(std::uint64_t seed) {
  LearnSettings settings;
  settings.method = "optimistic-model";
  settings.until_stable = false;
  settings.seed = seed;
  return settings;
}

// Bounds that hold, and a policy worth its lower bound.
void expect_true(const World& world, const ExperienceCertificate& found, double slack) {
  SolveSettings exactly;
  exactly.width = 1e-11;
  const auto solution = solve(*world.mdp, exactly);
  ASSERT_TRUE(solution);
  const auto worth = evaluate(*world.mdp, found.policy, world.discount, 1e-11);
  ASSERT_TRUE(worth) << message(worth.error());
  for (State s = 0; s < world.mdp->states(); ++s) {
    if (world.mdp->terminal(s)) continue;
    EXPECT_LE(found.lower[s], solution->upper[s] + slack) << world.name << s;
    EXPECT_GE(found.upper[s], solution->lower[s] - slack) << world.name << s;
    if (found.policy[s] != no_action && std::isfinite(found.lower[s])) {
      EXPECT_GE(worth->upper[s], found.lower[s] - slack) << world.name << s;
    }
  }
}

TEST(Certifier, IsTrueAtEveryCheckWithoutNoise) {
  std::vector<World> worlds{adventure(), corridor(6), star()};
  for (const char* name : {"combination-lock", "cliff-walking", "deep-sea"}) {
    worlds.push_back(*find_world(name));
  }
  for (const World& world : worlds) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Certified done =
          run(directed(seed), world, {}, 100'000, [&](const Certifier& certifier) {
            if (!certifier.certificate().lower.empty()) {
              expect_true(world, certifier.certificate(), 1e-9);
            }
          });
      EXPECT_TRUE(done.certificate.reached) << world.name << " seed " << seed;
    }
  }
}

// What is certified is where episodes begin: the step before nothing was certified yet.
TEST(Certifier, NeedsTheStepsItTakes) {
  // c0 .. c5, left and right: the way to the end must be walked, and both moves tried of every cell
  // from which the other one could still be better.
  const World world = corridor(6);
  const Certified done = run(directed(1), world, {}, 1000, [](const Certifier&) {});
  EXPECT_TRUE(done.certificate.reached);
  EXPECT_GE(done.steps, 11u);  // 12 pairs, of which (c0, left) leads nowhere
  EXPECT_NEAR(done.certificate.start_lower, std::pow(0.9, 5), 1e-12);
  EXPECT_NEAR(done.certificate.start_upper, std::pow(0.9, 5), 1e-12);
}

TEST(Certifier, StopsAtTheSameStepWithoutATable) {
  for (const World& world : {corridor(6), star(), slippery(4)}) {
    World steps_only = without_model(world);
    std::pair<double, double> running{HUGE_VAL, -HUGE_VAL};
    for (State s = 0; s < world.mdp->states(); ++s) {
      if (world.mdp->terminal(s)) continue;
      for (std::uint64_t c = world.mdp->choice_begin(s); c < world.mdp->choice_end(s); ++c) {
        for (std::uint64_t o = world.mdp->outcome_begin(c); o < world.mdp->outcome_end(c); ++o) {
          if (world.mdp->terminal(world.mdp->next(o))) continue;
          running.first = std::min(running.first, world.mdp->reward(c, o));
          running.second = std::max(running.second, world.mdp->reward(c, o));
        }
      }
    }
    steps_only.traits.running_rewards = running;
    CertifyGoal goal;
    goal.gap = world.traits.deterministic ? 0.0 : 0.5;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      LearnSettings settings = directed(seed);
      if (!world.traits.deterministic) settings.method = "q-learning";
      const auto ignore = [](const Certifier&) {};
      const Certified table = run(settings, world, goal, 3'000'000, ignore);
      const Certified stepped = run(settings, steps_only, goal, 3'000'000, ignore);
      EXPECT_TRUE(table.certificate.reached) << world.name;
      EXPECT_EQ(table.steps, stepped.steps) << world.name << " seed " << seed;
    }
  }
}

// A certificate may be wrong once in 1 / (1 - confidence) runs, all its checks together. At
// confidence 0.5 a hundred of 200 runs might fail; more than 125 would happen by chance less than
// once in 3,000 times.
TEST(Certifier, IsSeldomWrongUnderNoise) {
  for (const World& world : {slippery(3), lottery()}) {
    SolveSettings exactly;
    exactly.width = 1e-11;
    const auto solution = solve(*world.mdp, exactly);
    ASSERT_TRUE(solution);
    int wrong = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      LearnSettings settings;
      settings.until_stable = false;
      settings.seed = seed;
      CertifyGoal goal;
      goal.confidence = 0.5;
      bool true_so_far = true;
      run(settings, world, goal, 20'000, [&](const Certifier& certifier) {
        const ExperienceCertificate& found = certifier.certificate();
        for (State s = 0; s < world.mdp->states(); ++s) {
          true_so_far = true_so_far && found.lower[s] <= solution->upper[s] + 1e-9 &&
                        found.upper[s] >= solution->lower[s] - 1e-9;
        }
      });
      wrong += true_so_far ? 0 : 1;
    }
    EXPECT_LE(wrong, 125) << world.name;
  }
}

TEST(Certifier, NamesWhatBlocksIt) {
  // Nothing but left tried in c0: right could still earn the most.
  const World world = corridor(3);
  const auto setup = resolve(directed(1), world);
  ASSERT_TRUE(setup);
  Result<Certifier> certifier = Certifier::make(*setup, {});
  ASSERT_TRUE(certifier);
  Update left;
  left.state = 0, left.action = 0, left.next = 0;
  certifier->observe({&left, 1});
  EXPECT_FALSE(certifier->check());
  const std::vector<Blocking> blocking = certifier->blocking(5);
  ASSERT_EQ(blocking.size(), 1u);
  EXPECT_EQ(blocking[0].state, 0u);
  EXPECT_EQ(blocking[0].action, 1u);
  EXPECT_EQ(blocking[0].tried, 0u);
}

TEST(Certifier, NeedsDeclaredRewards) {
  World world = without_model(slippery(3));
  world.traits.reward_bounds.reset();
  const auto setup = resolve(LearnSettings(), world);
  ASSERT_TRUE(setup);
  const Result<Certifier> certifier = Certifier::make(*setup, {});
  ASSERT_FALSE(certifier);
  EXPECT_EQ(certifier.error().file, "--reward-range");
}

TEST(Certifier, GoesOnFromWhatWasSaved) {
  const World world = slippery(3);
  const auto setup = resolve(LearnSettings(), world);
  ASSERT_TRUE(setup);
  Result<Certifier> whole = Certifier::make(*setup, {}), again = Certifier::make(*setup, {});
  ASSERT_TRUE(whole && again);
  const auto one = learner(LearnSettings(), world);
  std::vector<Update> log(2000);
  one->advance(log.size(), log);
  whole->observe(std::span(log).first(1000));
  whole->check();
  Archive saved;
  saved("certifier", *whole);
  Archive archive{std::span<const std::byte>(saved.bytes())};
  archive("certifier", *again);
  ASSERT_TRUE(archive.good() && archive.at_end()) << archive.error().expected;
  whole->observe(std::span(log).last(1000));
  again->observe(std::span(log).last(1000));
  whole->check();
  again->check();
  EXPECT_EQ(whole->certificate().lower, again->certificate().lower);
  EXPECT_EQ(whole->certificate().upper, again->certificate().upper);
  EXPECT_EQ(whole->due(), again->due());
}

}  // namespace
}  // namespace quoll
