#pragma once
// Fills the arrays of a model state by state and action by action, outcomes in the order in which
// they come: nothing is joined or sorted, so that a draw can be read against the original program's
// list.

#include <cstdint>
#include <string_view>
#include <utility>

#include "quoll/model/mdp.hpp"

namespace quoll {

class TableWriter {
 public:
  explicit TableWriter(double discount) { arrays_.discount = discount; }

  /// Begins the next state. One without a choice is an end.
  void state() { arrays_.choice_begin.push_back(arrays_.action.size()); }
  void state(std::string_view name) {
    state();
    arrays_.state_names.push_back(name);
  }
  /// Begins the next choice of the state: an index into the action names.
  void choice(std::uint32_t action) {
    arrays_.outcome_begin.push_back(arrays_.next.size());
    arrays_.action.push_back(action);
  }
  /// Adds an outcome to the choice.
  void outcome(double probability, State next, double reward) {
    arrays_.probability.push_back(probability);
    arrays_.next.push_back(next);
    arrays_.outcome_reward.push_back(reward);
  }
  /// A start state, in ascending order; all are equally likely.
  void start(State s) { arrays_.start.push_back(s); }
  void start(State s, double probability) {
    start(s);
    arrays_.start_probability.push_back(probability);
  }

  /// What else a model has: names, starts, layout.
  MdpArrays& arrays() { return arrays_; }

  Result<Mdp> finish() {
    arrays_.choice_begin.push_back(arrays_.action.size());
    arrays_.outcome_begin.push_back(arrays_.next.size());
    return Mdp::make(std::move(arrays_));
  }

 private:
  MdpArrays arrays_;
};

}  // namespace quoll
