#pragma once
// What tests of built-in worlds share: a world played with given actions, and its optimum by plain
// value iteration (the solvers stand on a higher floor).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "moves.hpp"
#include "quoll/env/world.hpp"

namespace quoll::world_tests {

inline Error refused(const std::string& name, const Parameters& parameters) {
  const Result<World> world = find_world(name, parameters);
  EXPECT_FALSE(world) << name;
  return world ? Error{} : world.error();
}

struct Played {
  std::vector<Tree> starts, observed;  ///< of each episode, and after each step
  std::vector<double> rewards;
  std::vector<bool> terminated, truncated;
  std::string text;  ///< of the last state
};

/// One lane; a new episode whenever one stops. action(t) is the action of step t.
template <class ActionOfStep>
Played play(const World& world, std::uint64_t seed, int steps, ActionOfStep action,
            std::shared_ptr<const std::vector<double>> draws = nullptr) {
  const auto environment = world.make({1, seed, 0, std::move(draws)});
  State state = 0, next = 0;
  Action taken = 0;
  Feedback feedback;
  std::uint8_t restart = 1;
  Experience now{{&state, 1}, {&taken, 1}, {&feedback, 1}, {&next, 1}, {}, {}};
  Inspector& look = *environment->inspector();
  Played played;
  for (int t = 0; t < steps; ++t) {
    if (restart) {
      environment->restart({&restart, 1}, now);
      played.starts.push_back(look.observation(0, state));
    }
    taken = action(t);
    environment->step(now);
    played.observed.push_back(look.observation(0, next));
    played.rewards.push_back(feedback.reward);
    played.terminated.push_back(feedback.terminated);
    played.truncated.push_back(feedback.truncated);
    restart = feedback.terminated || feedback.truncated;
    state = next;
  }
  played.text = look.text(0, state);
  return played;
}

inline std::vector<Tree> numbers(const std::vector<std::int64_t>& list) {
  std::vector<Tree> trees;
  for (const std::int64_t number : list) trees.emplace_back(number);
  return trees;
}

/// The most an action of a state can be expected to earn.
inline double backup(const Mdp& mdp, State s, const std::vector<double>& value, double discount) {
  double best = -HUGE_VAL;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    double q = 0.0;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      q += mdp.probability(o) * (mdp.reward(c, o) + discount * value[mdp.next(o)]);
    }
    best = std::max(best, q);
  }
  return best;
}

inline double at_start(const Mdp& mdp, const std::vector<double>& value) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mdp.start().size(); ++i) {
    sum += mdp.start_probability(i) * value[mdp.start()[i]];
  }
  return sum;
}

/// The expected optimal value of a start, sweeping until nothing moves by more than 1e-15.
inline double optimum(const World& world, double discount) {
  const Mdp& mdp = *world.mdp;
  std::vector<double> value(mdp.states());
  for (double moved = 1.0; moved > 1e-15;) {
    moved = 0.0;
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      const double better = backup(mdp, s, value, discount);
      moved = std::max(moved, std::abs(better - value[s]) / std::max(1.0, std::abs(better)));
      value[s] = better;
    }
  }
  return at_start(mdp, value);
}

/// The same undiscounted, with so many steps to go.
inline double optimum_in(const World& world, std::uint64_t steps) {
  const Mdp& mdp = *world.mdp;
  std::vector<double> value(mdp.states());
  for (std::uint64_t t = 0; t < steps; ++t) {
    const std::vector<double> later = value;
    for (State s = 0; s < mdp.states(); ++s) {
      if (!mdp.terminal(s)) value[s] = backup(mdp, s, later, 1.0);
    }
  }
  return at_start(mdp, value);
}

}  // namespace quoll::world_tests
