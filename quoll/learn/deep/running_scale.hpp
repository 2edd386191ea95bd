#pragma once
// Mean and deviation of a row of numbers so far, for learners that scale what they see as they go.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"

namespace quoll {

/// Welford 1962 ("Note on a method for calculating corrected sums of squares and products").
class RunningScale {
 public:
  explicit RunningScale(std::size_t numbers) : mean_(numbers), squares_(numbers) {}

  std::size_t size() const { return mean_.size(); }
  template <class Number>
  void add(std::span<const Number> x) {
    ++count_;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double value = static_cast<double>(x[i]), off = value - mean_[i];
      mean_[i] += off / static_cast<double>(count_);
      squares_[i] += off * (value - mean_[i]);
    }
  }

  double mean(std::size_t i) const { return mean_[i]; }
  /// The root of the sample's variance, which is 1 before two rows; never 0.
  double deviation(std::size_t i) const {
    const double variance = count_ < 2 ? 1.0 : squares_[i] / static_cast<double>(count_ - 1);
    return std::sqrt(variance + 1e-8);
  }

  void persist(Archive& archive) {
    std::span<double> mean = mean_, squares = squares_;
    archive("count", count_);
    archive("mean", mean);
    archive("squares", squares);
  }

 private:
  std::uint64_t count_ = 0;
  std::vector<double> mean_, squares_;
};

}  // namespace quoll
