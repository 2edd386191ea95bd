#pragma once
// One update of one value, complete enough to be explained, replayed and checked by hand.

#include <cstdint>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Update {
  std::uint64_t step = 0;  ///< from 1
  std::uint32_t lane = 0;
  State state = 0;
  Action action = 0;
  double reward = 0.0;  ///< what the rule used as reward: observed, or its own estimate
  State next = 0;
  bool terminated = false;
  bool truncated = false;
  bool explored = false;  ///< chance chose the action
  double old_value = 0.0;
  double best_next = 0.0;  ///< max over the next state's actions; 0 when terminated
  double target = 0.0;
  double step_size = 1.0;
  double new_value = 0.0;
};

}  // namespace quoll
