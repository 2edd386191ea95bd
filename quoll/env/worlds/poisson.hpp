#pragma once
// The Poisson distribution cut off where nothing more can happen.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "quoll/base/math.hpp"

namespace quoll {

/// Probabilities of 0, 1, ..., most - 1 events and of `most` or more, for a mean of at most 100.
inline std::vector<double> poisson_up_to(double mean, std::uint32_t most) {
  std::vector<double> probability;
  double at = math::exp(-mean);
  double rest = 1.0;
  for (std::uint32_t k = 0; k < most; ++k) {
    probability.push_back(at);
    rest -= at;
    at *= mean / (k + 1);
  }
  probability.push_back(std::max(rest, 0.0));
  return probability;
}

}  // namespace quoll
