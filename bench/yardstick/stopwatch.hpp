#pragma once
// What the benchmarks measure with: the wall time of a piece of work, and the middle of several.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace yardstick {

/// How long `work()` takes.
inline double seconds(auto&& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// Time of the processor that `work()` takes, all threads together: what other programs take does
/// not count.
inline double cpu_seconds(auto&& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begun = now();
  work();
  return now() - begun;
}

/// The upper one of an even number of values; at least one expected.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace yardstick
