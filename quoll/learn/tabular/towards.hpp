#pragma once
// One step of a table's value towards a target: what every method with memory does to its table.

#include "quoll/learn/step_size.hpp"
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

}  // namespace quoll
