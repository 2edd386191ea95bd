#pragma once
// Drawing numbers with given priorities: a binary tree of sums (Schaul et al. 2016, appendix
// B.2.1). Changing one and finding one cost log2(n) additions.

#include <cstdint>
#include <vector>

#include "quoll/base/archive.hpp"

namespace quoll {

class SumTree {
 public:
  explicit SumTree(std::uint64_t n) {
    while (leaves_ < n) leaves_ *= 2;
    sums_.resize(2 * leaves_);
  }

  double total() const { return sums_[1]; }
  double operator[](std::uint64_t i) const { return sums_[leaves_ + i]; }
  void set(std::uint64_t i, double priority) {
    std::uint64_t node = leaves_ + i;
    sums_[node] = priority;
    while (node > 1) {
      node /= 2;
      sums_[node] = sums_[2 * node] + sums_[2 * node + 1];
    }
  }
  /// The i whose priorities, from 0 on, are the first to sum to more than `mass` < total(); never
  /// one of priority 0 unless all are.
  std::uint64_t find(double mass) const {
    std::uint64_t node = 1;
    while (node < leaves_) {
      node *= 2;
      if (mass >= sums_[node] && sums_[node + 1] > 0.0) mass -= sums_[node++];
    }
    return node - leaves_;
  }

  void persist(Archive& archive) {
    const std::size_t size = sums_.size();
    archive("sums", sums_);
    if (sums_.size() == size) return;
    sums_.resize(size);
    archive.fail("the priorities do not fit what is remembered");
  }

 private:
  std::uint64_t leaves_ = 1;
  std::vector<double> sums_;
};

}  // namespace quoll
