#pragma once
// Learners of small worlds, and how far they are from the values of those.

#include <algorithm>
#include <cmath>
#include <string>

#include "../worlds.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::learn_tests {

/// A table in the form of a network: no hidden layer, plain steps, everything explored.
inline LearnSettings network(const std::string& method) {
  LearnSettings settings;
  settings.method = method;
  settings.explore = "uniform";
  settings.until_stable = false;
  settings.deep.hidden = "none";
  settings.deep.optimiser = "sgd";
  settings.deep.loss = "half-squared";
  settings.deep.clip_gradient = 0.0;
  settings.deep.learning_rate = "2";
  if (settings.method != "dqn") return settings;
  settings.deep.batch = 32;
  settings.deep.learning_starts = 100;
  settings.deep.train_every = 1;
  settings.deep.target_every = 50;
  return settings;
}

/// Largest difference from Q*, in units of the largest reward.
inline double error_of(const World& world, const Learner& learner) {
  SolveSettings exactly;
  exactly.discount = world.discount;
  const Solution best = *solve(*world.mdp, exactly);
  const Estimates estimates = learner.estimates();
  double worst = 0.0, scale = 0.0;
  for (State s = 0; s < world.mdp->states(); ++s) {
    scale = std::max(scale, std::fabs(best.upper[s]));
    if (world.mdp->terminal(s)) continue;
    for (Action a = 0; a < world.mdp->actions(s); ++a) {
      const std::uint64_t c = world.mdp->choice_begin(s) + a;
      const double q = q_star(*world.mdp, best.upper, c, world.discount);
      worst = std::max(worst, std::fabs(estimates.q[c] - q));
    }
  }
  return worst / scale;
}

}  // namespace quoll::learn_tests
