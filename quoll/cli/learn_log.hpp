#pragma once
// learn --from-data: from logs of steps instead of a world's steps.

#include <string>
#include <vector>

#include "quoll/cli/common.hpp"
#include "quoll/experiment/log_learning.hpp"

namespace quoll::cli {

/// Learns, prints, and writes the policy of -o. The world may be missing.
Exit learn_log(const WorldOption& world, const OutputOption& output, const GivenSettings& how,
               const std::vector<std::string>& logs);

/// A pair that was tried, and how often.
struct TriedPair {
  State state = 0;
  Action action = 0;
  std::uint32_t visits = 0;
};

/// What is told of the counts, without the pairs of states that were only successors in a log
/// without a world.
struct LogCounts {
  std::uint64_t pairs = 0, untried = 0;  ///< of states that are no ends
  std::uint64_t unknown = 0;             ///< states with actions, none of them tried
  std::vector<TriedPair> least;          ///< the five tried least
};
LogCounts counts_of(const LogLearning& learned);

/// For people.
std::string log_text(const LogLearning& learned, const std::vector<std::string>& logs,
                     const std::string& world, bool all);

/// One JSON object (docs/json.md).
std::string log_json(const LogLearning& learned, const std::vector<std::string>& logs, bool all);

}  // namespace quoll::cli
