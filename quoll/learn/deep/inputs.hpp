#pragma once
// What a network reads of a lane: its observed numbers, scaled or as they are, or for a numbered
// state one 1 among zeros, or a 1 for each letter of its name.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/learn/deep/deep_setup.hpp"
#include "quoll/learn/deep/running_scale.hpp"

namespace quoll {

class Inputs {
 public:
  Inputs(const World& world, const DeepSetup& deep)
      : size_(deep.input.size()), numbered_(deep.spaces.observation == 0), letters_(deep.letters) {
    if (deep.running) {
      scale_.assign(size_, 1.0F);
      middle_.assign(size_, 0.0F);
    }
    if (!deep.scaled) return;
    for (const Measured& number : world.measured) {
      const double half = (number.high - number.low) / 2;
      scale_.push_back(static_cast<float>(1.0 / half));
      middle_.push_back(static_cast<float>(number.low + half));
    }
  }

  std::size_t size() const { return size_; }
  bool numbered() const { return numbered_; }
  /// An observed number x is read as (x - middle) * scale; empty: as it is.
  std::span<const float> middle() const { return middle_; }
  std::span<const float> scale() const { return scale_; }

  /// From now on observed numbers are told by how many deviations they are from their mean; only
  /// where DeepSetup::running.
  void scale_by(const RunningScale& seen) {
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      middle_[i] = static_cast<float>(seen.mean(i));
      scale_[i] = static_cast<float>(1.0 / seen.deviation(i));
    }
  }

  /// The inputs that are 1 for a numbered state, ascending; valid as long as `state` is.
  std::span<const std::uint32_t> ones(const State& state) const {
    return letters_ ? letters_->of(state) : std::span<const std::uint32_t>(&state, 1);
  }
  /// Writes size() floats for a numbered state, or for the size() numbers that were observed.
  void write(State state, std::span<const float> observation, std::span<float> out) const {
    if (numbered_) {
      std::fill(out.begin(), out.end(), 0.0F);
      for (const std::uint32_t spot : ones(state)) out[spot] = 1.0F;
    } else {
      read(observation, out);
    }
  }
  /// Writes size() floats for as many that were observed, or that letters gave.
  void read(std::span<const float> observation, std::span<float> out) const {
    if (scale_.empty()) {
      std::copy(observation.begin(), observation.end(), out.begin());
      return;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = (observation[i] - middle_[i]) * scale_[i];
    }
  }
  /// The same for a lane of columns.
  void write(std::span<const State> state, std::span<const float> observation, std::size_t lane,
             std::span<float> out) const {
    write(state[lane], numbered_ ? observation : observation.subspan(lane * size_, size_), out);
  }

 private:
  std::size_t size_;
  bool numbered_;
  std::shared_ptr<const NameLetters> letters_;
  std::vector<float> scale_, middle_;
};

}  // namespace quoll
