#include "quoll/learn/deep/replay.hpp"

#include <algorithm>
#include <array>

namespace quoll {

namespace {
std::uint64_t words_of(std::uint32_t numbers) {
  return (numbers + 63) / 64;
}

// The floats of four bits, the lowest first.
constexpr auto floats_of_bits = [] {
  std::array<std::array<float, 4>, 16> floats{};
  for (std::size_t bits = 0; bits < floats.size(); ++bits) {
    for (std::size_t i = 0; i < 4; ++i) floats[bits][i] = static_cast<float>(bits >> i & 1);
  }
  return floats;
}();
}  // namespace

Replay::Replay(const Spaces& spaces, std::uint64_t capacity, std::uint32_t lanes)
    : observation_(spaces.observation),
      bits_(spaces.whole && spaces.observation > 0),
      lanes_(lanes),
      ring_(std::max<std::uint64_t>(capacity / lanes, 1) + 1),
      action_(ring_ * lanes),
      reward_(ring_ * lanes),
      flags_(ring_ * lanes),
      aside_(ring_ * lanes) {
  make_frames(ring_ * lanes);
}

void Replay::make_frames(std::uint64_t count) {
  frames_ = count;
  if (observation_ == 0) {
    states_.resize(count);
  } else if (bits_) {
    words_.resize(count * words_of(observation_));
  } else {
    floats_.resize(count * observation_);
  }
}

// Something else than 0 and 1 was seen: from now on floats.
void Replay::unpack() {
  floats_.resize(frames_ * observation_);
  for (std::uint64_t frame = 0; frame < frames_; ++frame) {
    read(frame, std::span(floats_).subspan(frame * observation_, observation_));
  }
  bits_ = false;
  words_ = {};
}

void Replay::write(std::uint64_t frame, State state, std::span<const float> observation) {
  if (observation_ == 0) {
    states_[frame] = state;
    return;
  }
  if (bits_) {
    const std::uint64_t each = words_of(observation_);
    bool flags = true;
    for (std::uint64_t w = 0; w < each; ++w) {
      const std::size_t begin = w * 64, end = std::min<std::size_t>(begin + 64, observation_);
      std::uint64_t word = 0;
      for (std::size_t i = begin; i < end; ++i) {
        flags &= observation[i] == 0.0F || observation[i] == 1.0F;
        word |= std::uint64_t{observation[i] != 0.0F} << (i - begin);
      }
      words_[frame * each + w] = word;
    }
    if (flags) return;
    unpack();
  }
  std::copy_n(observation.begin(), observation_,
              floats_.begin() + static_cast<std::ptrdiff_t>(frame * observation_));
}

State Replay::read(std::uint64_t frame, std::span<float> observation) const {
  if (observation_ == 0) return states_[frame];
  if (bits_) {
    const std::uint64_t* const words = words_.data() + frame * words_of(observation_);
    const auto four = [&](std::size_t i) -> const std::array<float, 4>& {
      return floats_of_bits[words[i / 64] >> (i % 64) & 15];
    };
    std::size_t i = 0;
    for (; i + 4 <= observation_; i += 4) std::copy_n(four(i).begin(), 4, &observation[i]);
    for (; i < observation_; ++i) observation[i] = four(i / 4 * 4)[i % 4];
  } else {
    std::copy_n(floats_.begin() + static_cast<std::ptrdiff_t>(frame * observation_), observation_,
                observation.begin());
  }
  return 0;
}

std::uint64_t Replay::frame_aside() {
  if (free_.empty()) {
    make_frames(frames_ + 1);
    return frames_ - 1;
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
    write(slot, now.state[lane], part(now.observation));
    if (over(slot)) aside_[slot] = frame_aside();
    const std::uint64_t frame = over(slot) ? aside_[slot] : lane * ring_ + next_place;
    write(frame, now.next[lane], part(now.next_observation));
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
  archive("bits", bits_);
  archive("frames", frames_);
  archive("states", states_);
  archive("floats", floats_);
  archive("words", words_);
  archive("free", free_);
  if (archive.saving() || !archive.good()) return;
  const bool numbers = observation_ > 0;
  bool fits = head_ < ring_ && filled_ < ring_ && action_.size() == slots &&
              reward_.size() == slots && flags_.size() == slots && aside_.size() == slots &&
              frames_ >= slots && frames_ <= 2 * slots + 1 &&
              states_.size() == (numbers ? 0 : frames_) &&
              floats_.size() == (numbers && !bits_ ? frames_ * observation_ : 0) &&
              words_.size() == (numbers && bits_ ? frames_ * words_of(observation_) : 0);
  for (std::uint64_t slot = 0; fits && slot < slots; ++slot) {
    fits = !over(slot) || (aside_[slot] >= slots && aside_[slot] < frames_);
  }
  for (const std::uint64_t frame : free_) fits &= frame >= slots && frame < frames_;
  if (!fits) archive.fail("the steps that are remembered do not fit together");
}

}  // namespace quoll
