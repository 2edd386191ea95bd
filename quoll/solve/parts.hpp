#pragma once
// A sweep over all states on several threads.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "quoll/base/parallel.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

struct StateRange {
  State begin;
  State end;
  bool backward = false;
};

/// The least and the greatest difference a sweep made; infinity and -infinity = no state swept.
struct Differences {
  double least = infinity;
  double greatest = -infinity;

  void take(double difference) {
    least = std::min(least, difference);
    greatest = std::max(greatest, difference);
  }
  double span() const { return greatest - least; }
};

/// work(StateRange), which returns Differences, for parts of 2,048 states (some ten microseconds, a
/// row or two of a cache), and the least and greatest of all. Minima and maxima do not depend on
/// order, so the bits do not depend on `threads`, nor on the size of a part.
template <class Work>
Differences over_parts(std::uint64_t states, unsigned threads, const Work& work) {
  constexpr std::uint64_t part_size = 1 << 11;
  const std::size_t parts = (states + part_size - 1) / part_size;
  std::vector<Differences> differences(parts);
  parallel_for(parts, threads, [&](std::size_t part) {
    const std::uint64_t begin = part * part_size;
    const std::uint64_t end = std::min(states, begin + part_size);
    differences[part] = work(StateRange{static_cast<State>(begin), static_cast<State>(end)});
  });
  Differences all;
  for (const Differences& part : differences) {
    all.least = std::min(all.least, part.least);
    all.greatest = std::max(all.greatest, part.greatest);
  }
  return all;
}

}  // namespace quoll
