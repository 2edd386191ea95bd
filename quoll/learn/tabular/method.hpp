#pragma once
// What a method with memory is: traces, an episode, a model, a queue beside the table. The loop
// around it is in method_engine.hpp.

#include <concepts>
#include <cstdint>

#include "quoll/act/exploration.hpp"
#include "quoll/learn/tabular/value_table.hpp"

namespace quoll {

/// One step of experience, the visit of its pair already counted.
struct Step {
  State state = 0;
  Action action = 0;
  std::uint64_t pair = 0;
  double reward = 0.0;
  State next = 0;
  double carry = 0.0;  ///< factor of what follows: 0 after the end, negative when the turn passes
  bool terminated = false;
  bool truncated = false;          ///< the episode is cut off here: what follows still counts
  std::uint32_t n = 1;             ///< visits of the pair, this one included
  std::uint64_t number = 0;        ///< of the step, from 1
  Action next_action = no_action;  ///< looks_ahead only: what will be done in `next`
  bool watched = true;             ///< somebody looks at the Change
};

/// How the value of the pair just left was changed, for whoever watches.
struct Change {
  double best_next = 0.0;  ///< what the target took as the value of the next state
  double target = 0.0;
  double step_size = 1.0;
};

/// `learn` is called once a step, `end_episode` after the step that ends or cuts an episode.
/// looks_ahead: the next action is chosen before `learn`, as on-policy methods need. Beyond these a
/// method may have
///   Chosen choose(table, state, draws, step)   its own way to act
///   void estimates(table, Estimates&)          its own answer, if that is not the table
///   State start(Rng&)                          where the next episode begins, for widest-gap
template <class M>
concept Method = requires(M method, ValueTable<typename M::Value>& table, const Step& step,
                          const ChoiceDraws& draws, Archive& archive) {
  typename M::Value;
  { M::looks_ahead } -> std::convertible_to<bool>;
  { method.learn(step, table, draws) } -> std::same_as<Change>;
  method.end_episode(table);
  method.persist(archive);
};

}  // namespace quoll
