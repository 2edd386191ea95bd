#pragma once
// The mean return of the episodes that ended in each bin of steps. At most 512 bins: when they are
// full, neighbours are joined and bins become twice as wide, so that the curve of a run depends on
// its steps alone, never on its limit, its cuts or the clock.

#include <cstdint>
#include <vector>

#include "quoll/base/archive.hpp"

namespace quoll {

class LearningCurve {
 public:
  static constexpr std::uint64_t first_width = 64;
  static constexpr std::size_t most_bins = 512;

  struct Bin {
    std::uint64_t episodes = 0;
    double return_sum = 0.0;
    void persist(Archive& archive) {
      archive("episodes", episodes);
      archive("return_sum", return_sum);
    }
    double mean() const { return return_sum / static_cast<double>(episodes); }
  };

  /// The step at which the open bin ends; a chunk runs over it by less than a round of lanes.
  std::uint64_t boundary() const { return width_ * (bins_.size() + 1); }

  /// Counts since the beginning of the run, at a step before boundary() or the first one known at
  /// or beyond it; of bins jumped over the last has the episodes. True when it was closed.
  bool advance(std::uint64_t step, std::uint64_t episodes, double return_sum);

  std::uint64_t width() const { return width_; }
  /// Closed bins; bin i covers steps (i * width, (i + 1) * width].
  const std::vector<Bin>& bins() const { return bins_; }
  /// The bin that is still open.
  Bin open() const { return {episodes_ - closed_episodes_, return_sum_ - closed_return_sum_}; }

  void persist(Archive& archive);

 private:
  void push(const Bin& bin);

  std::uint64_t width_ = first_width;
  std::vector<Bin> bins_;
  std::uint64_t episodes_ = 0, closed_episodes_ = 0;
  double return_sum_ = 0.0, closed_return_sum_ = 0.0;
};

}  // namespace quoll
