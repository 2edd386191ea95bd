#pragma once
// One step of several lanes as columns: what environments fill, policies read and learners learn
// from.

#include <cstdint>
#include <span>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// The two ways an episode stops: `terminated` = the world ended, nothing follows; `truncated` =
/// cut off from outside, the future still counts. Both may be set. `turn_passes`: the next move is
/// the opponent's, so that what follows counts with the opposite sign; not set where nothing
/// follows.
struct Feedback {
  double reward = 0.0;
  bool terminated = false;
  bool truncated = false;
  bool turn_passes = false;

  bool over() const { return terminated | truncated; }
};

/// Columns with one entry per lane. `observation` columns hold lanes x observation_size floats and
/// are empty for worlds whose states are numbered.
struct Experience {
  std::span<State> state;
  std::span<Action> action;
  std::span<Feedback> feedback;
  std::span<State> next;  ///< the state after the action, of an ended episode too
  std::span<float> observation;
  std::span<float> next_observation;
};

}  // namespace quoll
