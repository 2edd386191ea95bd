#pragma once
// What the methods that learn a model share: counting a step, and plans into the table.

#include <algorithm>
#include <cmath>

#include "quoll/learn/learner.hpp"
#include "quoll/learn/tabular/method.hpp"
#include "quoll/learn/tabular/planning.hpp"

namespace quoll {

/// LearnerEntry::check of methods that hope for the most.
inline Result<void> needs_value_range(const LearnSetup& setup) {
  return finite_value_range(*setup.world, setup.rewards, setup.discount, setup.method);
}

/// True when this outcome is new.
inline bool count(CountedModel& model, const Step& step) {
  return model.observe(step.pair, step.terminated ? the_end : step.next, step.reward,
                       step.carry < 0.0);
}

/// The plan of a policy that takes only what was tried: whoever gets where nothing was is worth the
/// least that is possible.
inline Planning known_pairs_only(const LearnSetup& setup) {
  Planning planning;
  planning.discount = setup.discount;
  double low = 0.0;
  if (setup.rewards) low = value_range(*setup.rewards, setup.discount).first;
  // Without a bound: more than any way through all states can cost.
  if (!std::isfinite(low)) {
    low = std::min(0.0, setup.rewards->low()) * static_cast<double>(setup.world->traits.states + 1);
  }
  planning.stuck = std::min(low, 0.0);
  return planning;
}

/// The plan of somebody who takes what was not tried for the best there can be; needs rewards.
inline Planning unknown_pairs_best(const LearnSetup& setup) {
  Planning planning = known_pairs_only(setup);
  planning.unknown = value_range(*setup.rewards, setup.discount).second;
  return planning;
}

/// Writes the values of known pairs into the table.
inline void store(const Plan& plan, ValueTable<double>& table) {
  if (!plan.solved) return;
  for (State s = 0; s < table.states(); ++s) {
    for (Action a = 0; a < table.actions(s); ++a) {
      const std::uint64_t pair = table.pair(s, a);
      if (std::isfinite(plan.pair_value[pair])) table.set(s, pair, plan.pair_value[pair]);
    }
  }
}

/// The same for what is told.
inline void tell(const Plan& plan, Estimates& out) {
  if (!plan.solved) return;
  for (std::uint64_t pair = 0; pair < out.q.size(); ++pair) {
    if (std::isfinite(plan.pair_value[pair])) out.q[pair] = plan.pair_value[pair];
  }
}

}  // namespace quoll
