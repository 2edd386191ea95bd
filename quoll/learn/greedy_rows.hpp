#pragma once
// The greedy policy state by state, for whoever needs few of its actions.

#include <optional>

#include "quoll/act/policy.hpp"

namespace quoll {

/// What a learner may be besides (dynamic_cast tells): one that holds its answer as a table.
class GreedyRows {
 public:
  virtual ~GreedyRows() = default;
  /// What greedy_policy(estimates()) has for this state, at the cost of its row. Nothing, for any
  /// state: the answer is planned, and only estimates() tells.
  virtual std::optional<Action> greedy_action(State state) const = 0;
};

/// Of a row's actions the one of largest value(a) among those with visits(a), ties to the lowest;
/// no_action where none was visited.
template <class Value, class Visits>
Action best_visited(Action actions, const Value& value, const Visits& visits) {
  Action best = no_action;
  for (Action a = 0; a < actions; ++a) {
    if (!visits(a)) continue;
    if (best == no_action || value(a) > value(best)) best = a;
  }
  return best;
}

}  // namespace quoll
