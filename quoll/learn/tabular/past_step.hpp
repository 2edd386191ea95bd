#pragma once
// A step kept for later, by methods that learn from more than the last one.

#include <cstdint>
#include <vector>

#include "quoll/learn/settings.hpp"
#include "quoll/learn/tabular/method.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {

struct PastStep {
  std::uint64_t pair = 0;
  double reward = 0.0, carry = 0.0;
  State state = 0, next = 0;
  std::uint32_t rounding = 0;

  static PastStep of(const Step& step, const ChoiceDraws& draws) {
    return {step.pair, step.reward, step.carry, step.state, step.next, draws.rounding()};
  }

  void persist(Archive& archive) {
    archive("pair", pair);
    archive("reward", reward);
    archive("carry", carry);
    archive("state", state);
    archive("next", next);
    archive("rounding", rounding);
  }
};

/// One step of the pair's value towards `target`; returns the step size.
template <class Value>
double learn_from(const PastStep& e, double target, ValueTable<Value>& table,
                  const StepSize& step) {
  const double alpha = step.at(table.visits(e.pair));
  step_towards(table, e.state, e.pair, target, alpha, step, e.rounding);
  return alpha;
}

/// Saves or loads the steps kept, fewer than `most`; those that do not fit the rows are refused.
inline void persist_steps(Archive& archive, std::vector<PastStep>& steps,
                          const std::vector<std::uint64_t>& begin, std::uint64_t most) {
  archive("episode", steps);
  const std::uint64_t states = begin.size() - 1;
  bool fit = steps.size() < most;
  for (const PastStep& e : steps) {
    fit = fit && e.state < states && e.next < states && e.pair >= begin[e.state] &&
          e.pair < begin[e.state + 1];
  }
  if (fit) return;
  steps.clear();
  archive.fail("an episode of another world");
}

}  // namespace quoll
