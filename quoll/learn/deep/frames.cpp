#include "quoll/learn/deep/frames.hpp"

#include <algorithm>

#include "quoll/nn/arithmetic.hpp"

namespace quoll {

namespace {
std::uint64_t words_of(std::uint32_t numbers) {
  return (numbers + 63) / 64;
}
}  // namespace

Frames::Frames(const Spaces& spaces, std::uint64_t count, std::uint64_t most)
    : observation_(spaces.observation), bits_(spaces.whole && spaces.observation > 0), most_(most) {
  resize(count);
}

// Memory that is reserved and never touched costs nothing.
template <typename Number>
void Frames::grow(std::vector<Number>& numbers, std::uint64_t of_a_frame) {
  numbers.reserve(most_ * of_a_frame);
  numbers.resize(size_ * of_a_frame);
}

void Frames::resize(std::uint64_t count) {
  size_ = count;
  if (observation_ == 0) {
    grow(states_, 1);
  } else if (bits_) {
    grow(words_, words_of(observation_));
  } else {
    grow(floats_, observation_);
  }
}

// Something else than 0 and 1 was seen: from now on floats.
void Frames::unpack() {
  grow(floats_, observation_);
  for (std::uint64_t frame = 0; frame < size_; ++frame) {
    read(frame, std::span(floats_).subspan(frame * observation_, observation_));
  }
  bits_ = false;
  words_ = {};
}

void Frames::write(std::uint64_t frame, State state, std::span<const float> observation) {
  if (observation_ == 0) {
    states_[frame] = state;
    return;
  }
  if (bits_) {
    std::uint64_t* const words = words_.data() + frame * words_of(observation_);
    if (nn::arithmetic().pack(observation.data(), observation_, words)) return;
    unpack();
  }
  std::copy_n(observation.data(), observation_, floats_.data() + frame * observation_);
}

State Frames::read(std::uint64_t frame, std::span<float> observation) const {
  if (observation_ == 0) return states_[frame];
  if (bits_) {
    nn::arithmetic().unpack(words_.data() + frame * words_of(observation_), observation_,
                            observation.data());
  } else {
    std::copy_n(floats_.data() + frame * observation_, observation_, observation.data());
  }
  return 0;
}

void Frames::persist(Archive& archive) {
  archive("bits", bits_);
  archive("frames", size_);
  archive("states", states_);
  archive("floats", floats_);
  archive("words", words_);
}

bool Frames::fits(std::uint64_t states) const {
  const bool numbers = observation_ > 0;
  for (const State state : states_) {
    if (state >= states) return false;
  }
  return states_.size() == (numbers ? 0 : size_) &&
         floats_.size() == (numbers && !bits_ ? size_ * observation_ : 0) &&
         words_.size() == (numbers && bits_ ? size_ * words_of(observation_) : 0);
}

}  // namespace quoll
