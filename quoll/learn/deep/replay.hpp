#pragma once
// What a learner remembers of its steps: a ring for each lane, each state once, in as few bytes as
// it needs. A transition is its slot; what it came to is the frame of the next slot, or, where the
// episode ended, a frame kept aside.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/learn/deep/frames.hpp"
#include "quoll/model/experience.hpp"

namespace quoll {

class Replay {
 public:
  /// `capacity` transitions of all lanes together, at least one of each. Whole numbers are kept as
  /// bits while none but 0 and 1 was seen, numbered states as their number, all else as floats.
  Replay(const Spaces& spaces, std::uint64_t capacity, std::uint32_t lanes);

  /// Remembers the step of every lane.
  void push(const Experience& now);
  /// Transitions that are remembered, and the slot of each: index 0 is the oldest of lane 0.
  std::uint64_t size() const { return filled_ * lanes_; }
  std::uint64_t slot(std::uint64_t index) const {
    const std::uint64_t place = head_ + ring_ - filled_ + index % filled_;
    return index / filled_ * ring_ + place % ring_;
  }
  /// Slots are below this.
  std::uint64_t slots() const { return ring_ * lanes_; }
  /// The slot that push() wrote last in a lane.
  std::uint64_t newest(std::uint32_t lane) const {
    return lane * ring_ + (head_ + ring_ - 1) % ring_;
  }
  /// The slot of the lane that the next push() makes forgotten, if it held a transition.
  std::uint64_t forgotten_next(std::uint32_t lane) const { return lane * ring_ + head_; }

  Action action(std::uint64_t slot) const { return action_[slot]; }
  float reward(std::uint64_t slot) const { return reward_[slot]; }
  bool terminated(std::uint64_t slot) const { return (flags_[slot] & terminated_flag) != 0; }
  bool over(std::uint64_t slot) const { return (flags_[slot] & over_flags) != 0; }
  bool turn_passes(std::uint64_t slot) const { return (flags_[slot] & turn_flag) != 0; }

  /// The transition that followed in the same episode, or no_slot where none is remembered.
  static constexpr std::uint64_t no_slot = ~std::uint64_t{0};
  std::uint64_t after(std::uint64_t slot) const {
    const std::uint64_t place = (slot % ring_ + 1) % ring_;
    return over(slot) || place == head_ ? no_slot : slot / ring_ * ring_ + place;
  }

  /// What was seen before a transition, or after it: the number of the state, or the observation
  /// (written to `observation`).
  State before(std::uint64_t slot, std::span<float> observation) const {
    return frames_.read(slot, observation);
  }
  State next(std::uint64_t slot, std::span<float> observation) const {
    return frames_.read(frame_after(slot), observation);
  }
  /// Where these lie: of two with one number it is the same, until push() writes there.
  std::uint64_t frame_before(std::uint64_t slot) const { return slot; }
  std::uint64_t frame_after(std::uint64_t slot) const {
    return over(slot) ? aside_[slot] : slot / ring_ * ring_ + (slot % ring_ + 1) % ring_;
  }

  void persist(Archive& archive);

 private:
  static constexpr std::uint8_t terminated_flag = 1, truncated_flag = 2, turn_flag = 4;
  static constexpr std::uint8_t over_flags = terminated_flag | truncated_flag;

  std::uint64_t frame_aside();

  std::uint32_t observation_ = 0;
  std::uint64_t states_ = 0, actions_ = 0;  // that there are
  std::uint64_t lanes_ = 1, ring_ = 2;      // ring_ - 1 transitions of each lane are remembered
  std::uint64_t head_ = 0, filled_ = 0;     // the place of the next push; transitions of a lane
  std::vector<Action> action_;              // per slot, as what follows
  std::vector<float> reward_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::uint64_t> aside_;
  Frames frames_;                    // one for each slot, then those aside
  std::vector<std::uint64_t> free_;  // frames aside that nobody needs
};

}  // namespace quoll
