#include "quoll/learn/deep/replay.hpp"

#include <algorithm>

namespace quoll {

Replay::Replay(const Spaces& spaces, std::uint64_t capacity, std::uint32_t lanes)
    : observation_(spaces.observation),
      states_(spaces.states),
      actions_(spaces.actions),
      lanes_(lanes),
      ring_(std::max<std::uint64_t>(capacity / lanes, 1) + 1),
      action_(ring_ * lanes),
      reward_(ring_ * lanes),
      flags_(ring_ * lanes),
      aside_(ring_ * lanes),
      frames_(spaces, ring_ * lanes, 2 * ring_ * lanes + 1) {}

std::uint64_t Replay::frame_aside() {
  if (free_.empty()) {
    frames_.resize(frames_.size() + 1);
    return frames_.size() - 1;
  }
  const std::uint64_t frame = free_.back();
  free_.pop_back();
  return frame;
}

void Replay::push(const Experience& now) {
  const std::uint64_t next_place = (head_ + 1) % ring_;
  for (std::uint64_t lane = 0; lane < lanes_; ++lane) {
    const std::uint64_t slot = lane * ring_ + head_;
    if (over(slot)) free_.push_back(aside_[slot]);
    const auto part = [&](std::span<float> all) -> std::span<const float> {
      return observation_ == 0 ? all : all.subspan(lane * observation_, observation_);
    };
    const Feedback& feedback = now.feedback[lane];
    action_[slot] = now.action[lane];
    reward_[slot] = static_cast<float>(feedback.reward);
    flags_[slot] = static_cast<std::uint8_t>((feedback.terminated ? terminated_flag : 0) |
                                             (feedback.truncated ? truncated_flag : 0) |
                                             (feedback.turn_passes ? turn_flag : 0));
    frames_.write(slot, now.state[lane], part(now.observation));
    if (over(slot)) aside_[slot] = frame_aside();
    const std::uint64_t frame = over(slot) ? aside_[slot] : lane * ring_ + next_place;
    frames_.write(frame, now.next[lane], part(now.next_observation));
  }
  head_ = next_place;
  filled_ = std::min(filled_ + 1, ring_ - 1);
}

void Replay::persist(Archive& archive) {
  const std::uint64_t slots = ring_ * lanes_;
  archive("head", head_);
  archive("filled", filled_);
  archive("action", action_);
  archive("reward", reward_);
  archive("flags", flags_);
  archive("aside", aside_);
  frames_.persist(archive);
  archive("free", free_);
  if (archive.saving() || !archive.good()) return;
  bool fits = head_ < ring_ && filled_ < ring_ && action_.size() == slots &&
              reward_.size() == slots && flags_.size() == slots && aside_.size() == slots &&
              frames_.size() >= slots && frames_.size() <= 2 * slots + 1 && frames_.fits(states_);
  for (std::uint64_t slot = 0; fits && slot < slots; ++slot) {
    fits = !over(slot) || (aside_[slot] >= slots && aside_[slot] < frames_.size());
  }
  for (const Action action : action_) fits &= action < actions_;
  for (const std::uint64_t frame : free_) fits &= frame >= slots && frame < frames_.size();
  if (!fits) archive.fail("the steps that are remembered do not fit together");
}

}  // namespace quoll
