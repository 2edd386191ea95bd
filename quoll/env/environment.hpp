#pragma once
// The border to anything that can be acted in.

#include <cstdint>
#include <memory>

#include "quoll/base/archive.hpp"
#include "quoll/model/experience.hpp"

namespace quoll {

/// What an environment offers. states = 0: not enumerable. observation = floats per lane, 0 = none.
struct Spaces {
  std::uint32_t actions = 0;  ///< largest number of actions of any state
  std::uint32_t states = 0;
  std::uint32_t observation = 0;
};

/// N lanes stepped by one virtual call. Lane i is a pure function of (seed, i) and its actions, so
/// the batch size changes nothing. The caller owns resets: step() delivers the true next state of
/// an ended episode, and restart() begins the next one in the lanes asked for.
class Environment {
 public:
  virtual ~Environment() = default;
  virtual Spaces spaces() const = 0;
  /// Begins an episode in every lane with `restart[lane]` set: fills state (and observation).
  virtual void restart(std::span<const std::uint8_t> restart, Experience& now) = 0;
  /// Number of actions of a numbered state, the same in every lane; 0 = an end.
  virtual std::uint32_t actions(State) const { return spaces().actions; }
  /// Reads state and action; fills feedback and next (and next_observation) of every lane.
  /// In an end nothing happens: reward 0, terminated, the same state.
  virtual void step(Experience& now) = 0;
  /// Puts a lane into a state (the caller writes the state column too); false when this world
  /// cannot be set.
  virtual bool set(std::uint32_t lane, State state) = 0;
  virtual void persist(Archive& archive) = 0;
};

}  // namespace quoll
