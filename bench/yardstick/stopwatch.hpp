#pragma once
// What the benchmarks measure with: the wall time of a piece of work, and the middle of several.

#include <algorithm>
#include <chrono>
#include <vector>

namespace yardstick {

/// How long `work()` takes.
inline double seconds(auto&& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// The upper one of an even number of values; at least one expected.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace yardstick
