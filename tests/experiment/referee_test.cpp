// The referee looks at the part of the world that a policy can come to, remembers what was too bad
// and decides by sweeps where it can: all must say what an evaluation of the whole world says.

#include "quoll/experiment/referee.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/builder.hpp"
#include "quoll/solve/evaluate.hpp"

namespace quoll {
namespace {

constexpr double share = 0.1;

struct Kind {
  bool deterministic;
  double discount;
};

// 20 to 60 states with up to four actions each; some stay where they are, some states cannot be
// left, one in ten moves may end. Without discounting every move costs something, or is a circle
// that costs nothing, and one action of each state may end.
World random_world(Rng& rng, const Kind& kind) {
  MdpBuilder builder(kind.discount);
  const std::uint32_t states = 20 + rng.below(41);
  const auto name = [](std::uint32_t s) { return "s" + std::to_string(s); };
  const bool total = kind.discount == 1.0;
  for (std::uint32_t s = 0; s < states; ++s) {
    const std::uint32_t actions = 1 + rng.below(4);
    const bool trap = !total && rng.below(12) == 0;
    for (std::uint32_t a = 0; a < actions; ++a) {
      const std::string action = "a" + std::to_string(a);
      const bool circle = trap || rng.below(10) == 0;
      const double reward = total ? (circle && a > 0 && rng.below(2) == 0 ? 0.0 : -rng.uniform())
                                  : rng.uniform() - 0.3;
      if (circle && (trap || a > 0)) {
        builder.move(name(s), action, name(s), reward);
        continue;
      }
      const bool ends = rng.below(10) == 0 || (total && a == 0);
      const std::string next = ends ? "END" : name(rng.below(states));
      if (kind.deterministic || rng.below(3) == 0) {
        builder.move(name(s), action, next, reward);
        continue;
      }
      const double p = (1 + rng.below(7)) / 8.0;
      builder.move(name(s), action, next, reward, p);
      builder.move(name(s), action, name(rng.below(states)), reward - 0.2, 1.0 - p);
    }
  }
  const std::uint32_t starts = 1 + rng.below(3);
  for (std::uint32_t i = 0; i < starts; ++i) {
    builder.start(name(rng.below(states)), 1.0 + rng.below(3));
  }
  return to_world("random", *builder.build());
}

std::vector<Action> best_policy(const Mdp& mdp, const std::vector<double>& best, double discount) {
  std::vector<Action> policy(mdp.states(), no_action);
  for (State s = 0; s < mdp.states(); ++s) {
    double most = -HUGE_VAL;
    for (Action a = 0; a < mdp.actions(s) && !mdp.terminal(s); ++a) {
      const std::uint64_t c = mdp.choice_begin(s) + a;
      double value = mdp.reward(c);
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        value += discount * mdp.probability(o) * best[mdp.next(o)];
      }
      if (value > most) {
        most = value;
        policy[s] = a;
      }
    }
  }
  return policy;
}

enum class Said : std::uint8_t { bad, good, near };

// What one evaluation of all states says; near = to within what rounding may decide.
Said by_the_whole(const Mdp& mdp, const Referee& referee, const std::vector<Action>& policy,
                  RaceMode mode) {
  const std::vector<double>& best = referee.values();
  const Result<Evaluation> value = evaluate(mdp, policy, referee.discount(), 1e-9);
  EXPECT_TRUE(value);
  double spare = HUGE_VAL;
  if (mode == RaceMode::start) {
    double sum = 0.0, most = 0.0;
    for (std::size_t i = 0; i < mdp.start().size(); ++i) {
      sum += mdp.start_probability(i) * value->lower[mdp.start()[i]];
      most += mdp.start_probability(i) * best[mdp.start()[i]];
    }
    spare = sum - (most - share * std::fabs(most));
  } else {
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s) || !std::isfinite(best[s])) continue;
      if (policy[s] == no_action) return Said::bad;
      spare = std::min(spare, value->lower[s] - (best[s] - share * std::fabs(best[s])));
    }
  }
  if (std::fabs(spare) < 1e-7) return Said::near;
  return spare > 0 ? Said::good : Said::bad;
}

// A policy as learning changes it, from nothing known to optimal, now and then back.
void change(Rng& rng, const Mdp& mdp, const std::vector<Action>& best,
            std::vector<Action>& policy) {
  const auto states = static_cast<std::uint32_t>(mdp.states());
  const std::uint32_t changes = 1 + rng.below(states / 2);
  for (std::uint32_t i = 0; i < changes; ++i) {
    const State s = rng.below(states);
    if (mdp.terminal(s)) continue;
    const std::uint32_t what = rng.below(40);
    policy[s] = what == 0 ? no_action : what == 1 ? rng.below(mdp.actions(s)) : best[s];
  }
}

TEST(Referee, SaysOfThePartWhatItSaysOfTheWhole) {
  Rng rng = stream(1, "referee");
  int good[2] = {0, 0}, bad[2] = {0, 0}, near = 0, worlds = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const double discounts[] = {0.5, 0.9, 0.98, 1.0};
    const Kind kind{trial % 2 == 0, discounts[trial / 2 % 4]};
    const World world = random_world(rng, kind);
    const Mdp& mdp = *world.mdp;
    const Result<Referee> referee = Referee::make(world, kind.discount, share);
    if (!referee) continue;  // without discounting there may be no way to an end
    ++worlds;
    const std::vector<Action> best = best_policy(mdp, referee->values(), kind.discount);
    for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
      RefereeNotes notes;
      std::vector<Action> policy(mdp.states(), no_action);
      for (int look = 0; look < 40; ++look) {
        if (look > 0 && rng.below(4) > 0) change(rng, mdp, best, policy);
        const PolicyView view = [&](State s) { return policy[s]; };
        const bool said = referee->good(view, mode, notes);
        const Said whole = by_the_whole(mdp, *referee, policy, mode);
        near += whole == Said::near;
        if (whole == Said::near) continue;
        ASSERT_EQ(said, whole == Said::good)
            << "world " << trial << ", look " << look << ", mode " << static_cast<int>(mode);
        ASSERT_EQ(referee->good(policy, mode), said) << "world " << trial << ", look " << look;
        ++(said ? good : bad)[mode == RaceMode::all ? 0 : 1];
      }
    }
  }
  EXPECT_GT(worlds, 70);
  EXPECT_LT(near, 100);
  for (const int i : {0, 1}) {
    EXPECT_GT(good[i], 300) << i;
    EXPECT_GT(bad[i], 300) << i;
  }
}

// A loop of k states in front of which the policy turns away: only what it can come to is asked.
TEST(Referee, AsksOnlyWhereThePolicyCanCome) {
  MdpBuilder builder(0.9);
  builder.move("A", "short", "END", 1.0).move("A", "long", "B0");
  for (int i = 0; i < 1000; ++i) {
    const std::string from = "B" + std::to_string(i), to = "B" + std::to_string((i + 1) % 1000);
    builder.move(from, "on", to).move(from, "back", "A");
  }
  builder.start("A");
  const World world = to_world("loop", *builder.build());
  const Referee referee = *Referee::make(world, 0.9);
  RefereeNotes notes;
  std::uint64_t asked = 0;
  const State a = *world.mdp->find_state("A"), b5 = *world.mdp->find_state("B5");
  const auto good = [&](Action at_a, Action at_b5) {
    asked = 0;
    return referee.good(
        [&](State s) {
          ++asked;
          return s == a ? at_a : s == b5 ? at_b5 : Action{0};
        },
        RaceMode::start, notes);
  };
  EXPECT_TRUE(good(0, 0));
  EXPECT_EQ(asked, 1u);
  EXPECT_FALSE(good(1, 0));
  EXPECT_EQ(asked, 1001u);
  EXPECT_FALSE(good(1, no_action));
  EXPECT_EQ(asked, 7u);  // A, B0 .. B5
}

TEST(Referee, LooksFirstWhereItWasBad) {
  MdpBuilder builder(0.9);
  for (int i = 0; i < 100; ++i) {
    builder.move("s" + std::to_string(i), "lose", "END", 0.0);
    builder.move("s" + std::to_string(i), "win", "END", 1.0);
  }
  const World world = to_world("row", *builder.build());
  const Referee referee = *Referee::make(world, 0.9);
  RefereeNotes notes;
  std::vector<Action> policy(world.mdp->states(), 1);
  std::uint64_t asked = 0;
  const auto good = [&] {
    asked = 0;
    return referee.good(
        [&](State s) {
          ++asked;
          return policy[s];
        },
        RaceMode::all, notes);
  };
  const State s70 = *world.mdp->find_state("s70");
  policy[s70] = 0;
  EXPECT_FALSE(good());
  EXPECT_GE(asked, 100u);
  EXPECT_FALSE(good());
  EXPECT_LE(asked, 2u);
  policy[s70] = no_action;
  EXPECT_FALSE(good());
  EXPECT_EQ(asked, 1u);
  policy[s70] = 1;
  EXPECT_TRUE(good());
}

}  // namespace
}  // namespace quoll
