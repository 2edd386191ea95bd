#pragma once
// What a network that stays the same for a while said of remembered frames: what is drawn again
// before the network changes need not be asked again.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quoll {

class KnownValues {
 public:
  /// Of `row` numbers for each frame.
  explicit KnownValues(std::size_t row) : row_(row) {}

  bool has(std::uint64_t frame) const { return frame < said_.size() && said_[frame] == now_; }
  /// What was said of a frame; has(frame).
  std::span<const float> operator[](std::uint64_t frame) const {
    return std::span(rows_).subspan(frame * row_, row_);
  }
  void keep(std::uint64_t frame, const float* row) {
    if (frame >= said_.size()) {
      said_.resize(frame + 1);
      rows_.resize((frame + 1) * row_);
    }
    said_[frame] = now_;
    std::copy_n(row, row_, rows_.data() + frame * row_);
  }
  /// The frame is another one from now on, or the network.
  void forget(std::uint64_t frame) {
    if (frame < said_.size()) said_[frame] = 0;
  }
  void forget_all() { ++now_; }

 private:
  std::size_t row_;
  std::uint64_t now_ = 1;            // how often everything was forgotten, from 1
  std::vector<std::uint64_t> said_;  // per frame: when that was; 0 = nothing is known
  std::vector<float> rows_;
};

}  // namespace quoll
