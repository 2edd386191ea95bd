#pragma once
// What is remembered of an episode that has ended.

#include <cstdint>

namespace quoll {

struct FinishedEpisode {
  std::uint64_t step = 0;   ///< of the run, from 1: the one that ended it
  double total = 0.0;       ///< undiscounted return, each reward counted for whoever moved
  std::uint64_t steps = 0;  ///< its length
};

}  // namespace quoll
