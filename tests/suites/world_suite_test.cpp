// Properties of every world of the registry, and of small ones with noise beside them.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "../learn/worlds.hpp"
#include "quoll/env/table.hpp"

namespace quoll {
namespace {

std::vector<World> all_worlds() {
  std::vector<World> all{learn_tests::slippery(5), learn_tests::star(), learn_tests::lottery()};
  for (const WorldEntry* const entry : worlds()) {
    Result<World> world = entry->make({});
    EXPECT_TRUE(world) << entry->name;
    if (world) all.push_back(std::move(*world));
  }
  return all;
}

// Lanes of one world, played with their own coins: what each lane saw.
struct Play {
  std::unique_ptr<Environment> environment;
  std::vector<State> state, next;
  std::vector<Action> action;
  std::vector<Feedback> feedback;
  std::vector<std::uint8_t> restart;
  std::vector<Rng> coins;
  std::vector<std::vector<double>> seen;
  int forced = 40;     ///< restarts every so many steps, 0 = where an episode is over only
  bool listed = true;  ///< restart() is told which lanes

  Play(const World& world, std::uint32_t lanes, std::uint64_t seed)
      : environment(world.make({lanes, seed, 0, nullptr})),
        state(lanes),
        next(lanes),
        action(lanes),
        feedback(lanes),
        restart(lanes, 1),
        seen(lanes) {
    for (std::uint32_t lane = 0; lane < lanes; ++lane) coins.push_back(stream(1, "coin", lane));
  }

  void play(int steps) {
    Experience now{state, action, feedback, next, {}, {}};
    for (int t = 0; t < steps; ++t) {
      environment->restart(listed || t == 0 ? restart : std::span<const std::uint8_t>(), now);
      for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t actions = environment->actions(state[i]);
        const std::uint64_t bits = coins[i].next();
        action[i] = actions == 0 ? 0 : scale(static_cast<std::uint32_t>(bits >> 32), actions);
      }
      environment->step(now);
      for (std::size_t i = 0; i < state.size(); ++i) {
        seen[i].insert(seen[i].end(), {double(state[i]), double(action[i]), feedback[i].reward,
                                       double(next[i]), double(feedback[i].terminated)});
        restart[i] = feedback[i].over() || (forced > 0 && t % forced == forced - 1);
      }
      state = next;
    }
  }
};

TEST(Worlds, RowsSumToOne) {
  for (const World& world : all_worlds()) {
    if (!world.mdp) continue;
    for (State s = 0; s < world.mdp->states(); ++s) {
      for (std::uint64_t c = world.mdp->choice_begin(s); c < world.mdp->choice_end(s); ++c) {
        double sum = 0.0;
        for (std::uint64_t o = world.mdp->outcome_begin(c); o < world.mdp->outcome_end(c); ++o) {
          sum += world.mdp->probability(o);
        }
        EXPECT_NEAR(sum, 1.0, 1e-9) << world.name << " " << world.mdp->state_name(s);
      }
    }
  }
}

TEST(Worlds, ABatchIsItsLanes) {
  for (const World& world : all_worlds()) {
    Play three(world, 3, 7), seven(world, 7, 7), one(world, 1, 7);
    three.play(500);
    seven.play(500);
    one.play(500);
    EXPECT_EQ(one.seen[0], three.seen[0]) << world.name;
    for (int lane = 0; lane < 3; ++lane) EXPECT_EQ(three.seen[lane], seven.seen[lane]);
  }
}

TEST(Worlds, AnEmptyListRestartsTheLanesThatAreOver) {
  for (const World& world : all_worlds()) {
    Play listed(world, 9, 7), not_listed(world, 9, 7);
    listed.forced = not_listed.forced = 0;
    not_listed.listed = false;
    listed.play(300);
    not_listed.play(300);
    EXPECT_EQ(listed.seen, not_listed.seen) << world.name;
  }
}

TEST(Worlds, GoOnWhereTheyWereSaved) {
  for (const World& world : all_worlds()) {
    const int stride = world.traits.states > 10'000 ? 20 : 3;  // large tables take time to make
    for (int cut = 0; cut < 60; cut += stride) {
      Play whole(world, 2, 7), rest(world, 2, 8);
      whole.play(cut);
      Archive out;
      whole.environment->persist(out);
      Archive in{std::span<const std::byte>(out.bytes())};
      rest.environment->persist(in);
      ASSERT_TRUE(in.good() && in.at_end()) << world.name;
      rest.state = whole.state;
      rest.restart = whole.restart;
      rest.coins = whole.coins;
      rest.seen = whole.seen;
      whole.play(100);
      rest.play(100);
      EXPECT_EQ(whole.seen, rest.seen) << world.name << " cut at " << cut;
    }
  }
}

// Per choice, at most 200 of a world: 20,000 steps; the share of each (successor, reward) is within
// 5 standard deviations and 5 steps of its probability (a rare outcome's count is not normal): for
// a right world a fresh seed would fail less than one comparison in 1.7 million.
TEST(Worlds, SteppedFrequenciesAreTheModelsProbabilities) {
  constexpr int steps = 20'000;
  for (const World& world : all_worlds()) {
    if (!world.mdp) continue;
    const Mdp& mdp = *world.mdp;
    int tried = 0;
    const auto environment = world.make({1, 3, 0, nullptr});
    State state = 0, next = 0;
    Action action = 0;
    Feedback feedback;
    Experience now{{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, {}, {}};
    for (State s = 0; s < mdp.states() && s < 50; ++s) {
      for (Action a = 0; a < mdp.actions(s) && !mdp.terminal(s); ++a) {
        if (++tried > 200) break;
        std::map<std::pair<State, double>, double> share, expected;
        const std::uint64_t c = mdp.choice_begin(s) + a;
        for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
          expected[{mdp.next(o), mdp.reward(c, o)}] += mdp.probability(o);
        }
        for (int i = 0; i < steps; ++i) {
          state = s;
          action = a;
          environment->set(0, s);
          environment->step(now);
          share[{next, feedback.reward}] += 1.0 / steps;
          EXPECT_EQ(feedback.terminated, mdp.terminal(next));
        }
        for (const auto& [outcome, p] : share) EXPECT_TRUE(expected.contains(outcome));
        for (const auto& [outcome, p] : expected) {
          EXPECT_NEAR(share[outcome], p, 5 * std::sqrt(p * (1 - p) / steps) + 5.0 / steps)
              << world.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace quoll
