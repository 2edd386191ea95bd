#include "quoll/experiment/race.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../learn/worlds.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// A -> B -> END, one action each, reward 1 at the end.
World two_steps() {
  MdpBuilder builder(0.9);
  builder.move("A", "on", "B").move("B", "on", "END", 1.0);
  builder.start("A");
  return to_world("two steps", *builder.build());
}

// One state: `left` ends with little, `right` with 1.
World one_choice(double little) {
  MdpBuilder builder(0.9);
  builder.move("S", "left", "END", little).move("S", "right", "END", 1.0);
  builder.start("S");
  return to_world("one choice", *builder.build());
}

// One state: `coin` ends with 1 or 0, half each, `sure` with 0.4.
World coin_or_sure() {
  MdpBuilder builder(0.9);
  builder.move("S", "coin", "END", 1.0, 0.5).move("S", "coin", "END", 0.0, 0.5);
  builder.move("S", "sure", "END", 0.4);
  builder.start("S");
  return to_world("coin or sure", *builder.build());
}

Referee referee_of(const World& world) {
  Result<Referee> referee = Referee::make(world, world.discount);
  EXPECT_TRUE(referee) << (referee ? "" : message(referee.error()));
  return *referee;
}

LearnSettings settings_with(std::uint64_t seed, const char* step_size = "1") {
  LearnSettings settings;
  settings.seed = seed;
  settings.step_size = step_size;
  settings.until_stable = false;
  return settings;
}

TEST(Race, CheckpointsAreSevenPercentApartOnceThatIsMoreThanAStep) {
  EXPECT_EQ(next_checkpoint(0), 1u);
  EXPECT_EQ(next_checkpoint(1), 2u);
  EXPECT_EQ(next_checkpoint(28), 29u);  // 29.96
  EXPECT_EQ(next_checkpoint(29), 31u);  // 31.03
  EXPECT_EQ(next_checkpoint(100), 107u);
  EXPECT_EQ(next_checkpoint(1'000'000), 1'070'000u);
}

TEST(Race, QuartilesLieBetweenNeighboursAndLeaveOutWhatIsNoNumber) {
  const std::vector<double> values{4, std::nan(""), 1, 3, 2, 5};
  const Quartiles five = quartiles(values);
  EXPECT_EQ(five.lower, 2);
  EXPECT_EQ(five.median, 3);
  EXPECT_EQ(five.upper, 4);
  const std::vector<double> pair{1, 2};
  EXPECT_EQ(quartiles(pair).median, 1.5);
  EXPECT_EQ(quartiles(pair).lower, 1.25);
  EXPECT_TRUE(std::isnan(quartiles({}).median));
}

TEST(Race, TheRefereeAllowsOnePercentAndNoMore) {
  const std::vector<Action> left{0, no_action}, right{1, no_action};
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    EXPECT_TRUE(referee_of(one_choice(0.5)).good(right, mode));
    EXPECT_FALSE(referee_of(one_choice(0.5)).good(left, mode));
    EXPECT_TRUE(referee_of(one_choice(0.991)).good(left, mode));
    EXPECT_FALSE(referee_of(one_choice(0.989)).good(left, mode));
  }
}

TEST(Race, TheRefereeCountsAnUnknownActionAsTheLeast) {
  const Referee referee = referee_of(two_steps());
  const std::vector<Action> half{0, no_action, no_action}, whole{0, 0, no_action};
  EXPECT_FALSE(referee.good(half, RaceMode::all));
  EXPECT_FALSE(referee.good(half, RaceMode::start));
  EXPECT_TRUE(referee.good(whole, RaceMode::start));
  // What cannot be reached from the start does not matter there.
  const World from_b = *world_from(two_steps(), "B");
  const std::vector<Action> only_b{no_action, 0, no_action};
  EXPECT_TRUE(referee_of(from_b).good(only_b, RaceMode::start));
  EXPECT_FALSE(referee_of(from_b).good(only_b, RaceMode::all));
}

TEST(Race, TheRefereeNeedNotLookBeforeEnoughIsKnown) {
  EXPECT_EQ(referee_of(two_steps()).fewest_steps(RaceMode::all), 2u);
  EXPECT_EQ(referee_of(two_steps()).fewest_steps(RaceMode::start), 1u);
  // Doors worth 1 to begin at, equally likely. Each of four is a quarter of the value; each of two
  // hundred half a percent, so that two may stay unknown.
  for (const auto& [doors, fewest] : {std::pair(4, 4u), std::pair(200, 198u)}) {
    MdpBuilder builder(0.9);
    for (int i = 0; i < doors; ++i) {
      builder.move("d" + std::to_string(i), "open", "END", 1.0);
      builder.start("d" + std::to_string(i));
    }
    const World world = to_world("doors", *builder.build());
    const Referee referee = referee_of(world);
    EXPECT_EQ(referee.fewest_steps(RaceMode::start), fewest);
    EXPECT_EQ(referee.fewest_steps(RaceMode::all), static_cast<std::uint64_t>(doors));
    std::vector<Action> policy(static_cast<std::size_t>(doors) + 1, no_action);
    for (std::uint64_t i = 0; i < fewest; ++i) {
      policy[*world.mdp->find_state("d" + std::to_string(i))] = 0;
    }
    EXPECT_TRUE(referee.good(policy, RaceMode::start));
    policy[0] = no_action;
    EXPECT_FALSE(referee.good(policy, RaceMode::start));
  }
}

TEST(Race, TheRefereeNeedsAModelAndOnePlayer) {
  const Result<Referee> none = Referee::make(without_model(adventure()), 0.8);
  ASSERT_FALSE(none);
  EXPECT_EQ(message(none.error()),
            "the model of adventure without a model is not known: who is within 1 % of optimal "
            "cannot be told");
  MdpBuilder game(1.0);
  game.alternating(true);
  game.move("2", "take", "1").move("1", "take", "0", 1.0);
  EXPECT_EQ(message(Referee::make(to_world("nim", *game.build()), 1.0).error()),
            "two players move in turn in nim: a race is run by one");
}

TEST(Race, AHeatEndsAtTheFirstOfTwoGoodLooks) {
  const World world = two_steps();
  const Referee referee = referee_of(world);
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    // After step 1 nothing is known of B; after step 2 all is; the look after step 3 confirms it.
    const Heat heat = *run_heat(settings_with(1), world, referee, mode, {.steps = 3});
    EXPECT_EQ(heat.end, HeatEnd::reached);
    EXPECT_EQ(heat.steps, 2u);
    EXPECT_GT(heat.seconds, 0.0);
    EXPECT_GT(heat.bytes, 0u);
    const Heat capped = *run_heat(settings_with(1), world, referee, mode, {.steps = 2});
    EXPECT_EQ(capped.end, HeatEnd::steps);
    EXPECT_EQ(capped.steps, 2u);
  }
}

// With step size 1 the coin's value is its last reward, so that the policy comes and goes: the
// updates tell after which steps it is good.
TEST(Race, APolicyThatComesAndGoesIsJudgedAtTheCheckpointsAlone) {
  const World world = coin_or_sure();
  const Referee referee = referee_of(world);
  std::uint64_t late = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::unique_ptr<Learner> twin = learner(settings_with(seed), world);
    std::vector<Update> log(2000);
    twin->advance(log.size(), log);
    double q[2] = {0, 0};
    bool seen[2] = {false, false}, was_good = false;
    std::uint64_t step = 0, look = 1, before = 0, expected = 0;
    for (const Update& update : log) {
      q[update.action] = update.new_value;
      seen[update.action] = true;
      if (++step != look) continue;
      const bool good = seen[0] && (!seen[1] || q[0] >= q[1]);
      if (good && was_good) {
        expected = before;
        break;
      }
      was_good = good;
      before = look;
      look = next_checkpoint(look);
    }
    ASSERT_GT(expected, 0u);
    const Heat heat =
        *run_heat(settings_with(seed), world, referee, RaceMode::all, {.steps = 100'000});
    EXPECT_EQ(heat.steps, expected) << seed;
    EXPECT_TRUE(heat.good());
    late += expected > 1;
  }
  EXPECT_GT(late, 5u);
}

TEST(Race, EveryEntrantRunsEverySeedWhateverTheThreads) {
  const World world = corridor(4);
  const Referee referee = referee_of(world);
  const std::vector<Entrant> entrants = *parse_entrants("q-learning", RaceMode::all);
  RacePlan plan{&world, &referee, RaceMode::all, 8, 5, {}, 1};
  const RaceResult one = run_race(plan, entrants);
  plan.threads = 3;
  const RaceResult three = run_race(plan, entrants);
  ASSERT_EQ(one.entrants.size(), 2u);
  EXPECT_EQ(one.entrants[0].word, "lecture");
  EXPECT_EQ(one.entrants[0].fewer_steps, 1.0);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(one.entrants[i].heats.size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_EQ(one.entrants[i].heats[k].seed, 5 + k);
      EXPECT_EQ(one.entrants[i].heats[k].steps, three.entrants[i].heats[k].steps);
    }
  }
  EXPECT_EQ(one.entrants[1].fewer_steps,
            one.entrants[0].steps.median / one.entrants[1].steps.median);
}

TEST(Race, AFailedSeedCountsAsTheCap) {
  RaceResult race;
  race.cap_steps = 1000;
  race.entrants.resize(2);
  const auto heat = [](std::uint64_t seed, HeatEnd end, std::uint64_t steps, double seconds) {
    return Heat{seed, end, steps, seconds, 8};
  };
  race.entrants[0].heats = {heat(2, HeatEnd::reached, 100, 1), heat(1, HeatEnd::reached, 300, 3)};
  race.entrants[1].heats = {heat(1, HeatEnd::reached, 40, 4), heat(2, HeatEnd::seconds, 50, 5),
                            heat(3, HeatEnd::interrupted, 0, 0)};
  summarise(race);
  EXPECT_EQ(race.entrants[0].heats[0].seed, 1u);
  EXPECT_EQ(race.entrants[0].steps.median, 200);
  EXPECT_EQ(race.entrants[1].heats.size(), 2u);
  EXPECT_EQ(race.entrants[1].failures, 1u);
  EXPECT_EQ(race.entrants[1].steps.median, 520);   // 40 and the cap of 1000
  EXPECT_EQ(race.entrants[1].seconds.median, 52);  // 4, and 1000 steps at 0.1 s
  EXPECT_EQ(race.entrants[1].step_seconds, 0.1);
  EXPECT_EQ(race.entrants[1].fewer_steps, 200.0 / 520);
  EXPECT_FALSE(race.entrants[1].failed());  // half is not more than half
}

TEST(Race, StopsWhenAskedAndKeepsWhatIsDone) {
  const World world = corridor(4);
  const Referee referee = referee_of(world);
  RaceHooks hooks;
  std::uint64_t finished = 0;
  hooks.finished = [&](const Entrant&, const Heat&) { ++finished; };
  hooks.keep_going = [](std::uint64_t done, std::uint64_t all) {
    EXPECT_EQ(all, 10u);  // the lecture's method and q-learning
    return done < 4;
  };
  const RacePlan plan{&world, &referee, RaceMode::start, 5, 1, {}, 1};
  const RaceResult race = run_race(plan, *parse_entrants("q-learning", RaceMode::start), hooks);
  EXPECT_TRUE(race.interrupted);
  EXPECT_EQ(finished, 4u);
  EXPECT_EQ(race.entrants[0].heats.size(), 2u);
  EXPECT_EQ(race.entrants[1].heats.size(), 2u);
}

TEST(Race, WhoFailsWithEachOfTheFirstSeedsRunsNoOthers) {
  const World world = corridor(8);
  const Referee referee = referee_of(world);
  for (const unsigned threads : {1u, 2u}) {
    // 6 steps are fewer than the way is long.
    RacePlan plan{&world, &referee, RaceMode::start, 9, 1, {6, 0.0}, threads};
    RaceResult race = run_race(plan, *parse_entrants("q-learning", RaceMode::start));
    EXPECT_FALSE(race.interrupted);
    for (const EntrantResult& entrant : race.entrants) {
      EXPECT_EQ(entrant.heats.size(), trial_seeds);
      EXPECT_EQ(entrant.failures, trial_seeds);
      EXPECT_EQ(entrant.steps.median, 6);
    }
    plan.caps.steps = 100'000;
    race = run_race(plan, *parse_entrants("q-learning", RaceMode::start));
    for (const EntrantResult& entrant : race.entrants) EXPECT_EQ(entrant.heats.size(), 9u);
  }
}

TEST(Race, AWorldBeginsWhereOneSays) {
  const World world = *world_from(corridor(4), "c2");
  EXPECT_EQ(world.mdp->start().size(), 1u);
  EXPECT_EQ(world.mdp->state_name(world.mdp->start()[0]), "c2");
  EXPECT_EQ(world_from(corridor(4), "c22").error().nearest, "c2");
  EXPECT_FALSE(world_from(corridor(4), "END"));
}

TEST(Race, GeometricMeans) {
  const std::vector<double> values{2, 8};
  EXPECT_NEAR(geometric_mean(values), 4.0, 1e-15);
  EXPECT_TRUE(std::isnan(geometric_mean({})));
}

}  // namespace
}  // namespace quoll
