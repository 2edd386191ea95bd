#pragma once
// What linear-q sees of a lane: the tiles of its observed numbers, or, where states are numbered,
// the one feature that is its state. A weight for each feature and action.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quoll/learn/deep/tile_coding.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/model/experience.hpp"

namespace quoll {

class LinearFeatures {
 public:
  /// Error: the world has neither numbered states nor ranges of what is observed, or too many tiles
  /// were asked for.
  static Result<LinearFeatures> make(const LearnSetup& setup);

  /// How many are on at a time.
  std::uint32_t on() const { return coder_ ? coder_->tilings() : 1; }
  /// Whether each state has a feature of its own.
  bool numbered() const { return !coder_; }
  std::uint64_t weights() const { return features_ * actions_; }
  Action actions() const { return actions_; }

  /// First weight of each feature that is on in a lane's state; those of the actions follow it.
  void of(std::span<const State> state, std::span<const float> observation, std::size_t lane,
          std::span<std::uint32_t> first) const {
    if (!coder_) {
      first[0] = state[lane] * actions_;
      return;
    }
    coder_->code(observation.subspan(lane * numbers_, numbers_), first);
    for (std::uint32_t& weight : first) weight *= actions_;
  }

 private:
  std::optional<TileCoder> coder_;
  std::uint64_t features_ = 0;
  std::uint32_t numbers_ = 0;
  Action actions_ = 0;
};

}  // namespace quoll
