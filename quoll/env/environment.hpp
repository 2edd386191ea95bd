#pragma once
// The border to anything that can be acted in.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/tree.hpp"
#include "quoll/env/drawing.hpp"
#include "quoll/model/experience.hpp"

namespace quoll {

/// What an environment offers. states = 0: not enumerable. observation = floats per lane, 0 = none.
struct Spaces {
  std::uint32_t actions = 0;  ///< largest number of actions of any state
  std::uint32_t states = 0;
  std::uint32_t observation = 0;
  /// How an observation is laid out (its product is `observation`), e.g. {10, 10, 4}; all 0 = flat.
  std::array<std::uint32_t, 3> shape{};
  bool whole = false;  ///< every observed number is a whole one (flags, counts)
};

/// Which lanes to make, and where their randomness comes from.
struct Lanes {
  std::uint32_t count = 1;
  std::uint64_t seed = 1;
  std::uint64_t episode_steps = 0;  ///< truncate after so many steps; 0 = the world's own limit
  /// Numbers to use as the draws of lane 0, in order, instead of a generator (see env/dice.hpp).
  std::shared_ptr<const std::vector<double>> draws;
};

/// An observation of the shape that `spaces` says, as nested lists.
Tree observation_tree(const Spaces& spaces, std::span<const float> x);

/// What a person or a test wants of one lane: its whole state as data, text and picture. `at` is
/// the lane's numbered state (worlds whose state is a number keep it nowhere else).
class Inspector {
 public:
  virtual ~Inspector() = default;
  virtual Tree state(std::uint32_t lane, State at) const = 0;
  /// Puts the lane into a state given as state() gives it; the caller reads `at` back. Error: what
  /// does not fit.
  virtual Result<void> set(std::uint32_t lane, const Tree& state, State& at) = 0;
  /// The observation as people of this world know it: a number, a list, a tuple.
  virtual Tree observation(std::uint32_t lane, State at) const = 0;
  /// Lines of text, or empty when the world has no text form.
  virtual std::string text(std::uint32_t lane, State at) const = 0;
  /// Empty (width 0) when the world has no picture.
  virtual Drawing drawing(std::uint32_t lane, State at) const = 0;
  /// False after draws given by Lanes were used up or did not fit.
  virtual bool draws_left() const { return true; }
};

/// N lanes stepped by one virtual call. Lane i is a pure function of (seed, i) and its actions, so
/// the batch size changes nothing. The caller owns resets: step() delivers the true next state of
/// an ended episode, and restart() begins the next one in the lanes asked for. Step limits are
/// counted inside: `truncated` is set at the limit, beside `terminated` where both hold.
class Environment {
 public:
  virtual ~Environment() = default;
  virtual Spaces spaces() const = 0;
  /// Begins an episode in every lane with `restart[lane]` set: fills state (and observation). An
  /// empty `restart`, once after a step(), means every lane that is over by now.feedback, which is
  /// to be as step() left it; with many lanes that is the fastest way.
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
  /// Nullptr when there is nothing to look at.
  virtual Inspector* inspector() { return nullptr; }

 protected:
  /// Whether restart() is to begin an episode in this lane.
  static bool begins(std::span<const std::uint8_t> restart, const Experience& now,
                     std::size_t lane) {
    return restart.empty() ? now.feedback[lane].over() : restart[lane] != 0;
  }
};

}  // namespace quoll
