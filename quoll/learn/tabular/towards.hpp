#pragma once
// One step of a table's value towards a target: what every method with memory does to its table.

#include "quoll/learn/step_size.hpp"
#include "quoll/learn/tabular/method.hpp"
#include "quoll/learn/tabular/rule.hpp"
#include "quoll/learn/tabular/value_table.hpp"

namespace quoll {

/// Q(s,a) <- Q(s,a) + alpha (target - Q(s,a)), exactly the target when alpha is 1; rounded once, at
/// random where an increment can be less than half an ulp (rule.hpp).
template <class Value>
void step_towards(ValueTable<Value>& table, State s, std::uint64_t pair, double target,
                  double alpha, const StepSize& step, std::uint32_t rounding) {
  const double old = double{table[pair]};
  const double moved = alpha == 1.0 ? target : old + alpha * (target - old);
  if constexpr (sizeof(Value) == 4) {
    if (step.small() && alpha != 1.0) return table.set(s, pair, round_at_random(moved, rounding));
  }
  table.set(s, pair, static_cast<Value>(moved));
}

/// The value of the step's own pair towards r + carry * after, `after` being what the method takes
/// the next state to be worth.
template <class Value>
Change learn_from(const Step& step, double after, ValueTable<Value>& table,
                  const StepSize& step_size, const ChoiceDraws& draws) {
  const double target = step.reward + step.carry * after;
  const double alpha = step_size.at(step.n);
  step_towards(table, step.state, step.pair, target, alpha, step_size, draws.rounding());
  return {after, target, alpha};
}

}  // namespace quoll
