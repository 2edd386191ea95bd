#pragma once
// The mean return of the last 100 training episodes, the usual measure of a learner on its way, and
// the moment from which it was as high as somebody asked for.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "quoll/base/archive.hpp"
#include "quoll/learn/finished_episode.hpp"
#include "quoll/learn/update.hpp"

namespace quoll {

/// Where a seed stood when its mean return was reached.
struct ReturnReached {
  std::uint64_t steps = 0, episodes = 0;
  double mean = 0.0;               ///< of the last 100 episodes
  double processor_seconds = 0.0;  ///< of the thread that learned

  void persist(Archive& archive);
};

class ReturnWatch {
 public:
  static constexpr std::size_t window = 100;  ///< episodes

  /// What to look for from now on; another goal than before begins a new search.
  void look_for(double goal, std::uint64_t step, double processor_seconds);
  void add(const FinishedEpisode& episode, double processor_seconds);
  /// The steps of a learner's log that follow those of the last call.
  void add(std::span<const Update> log, double processor_seconds);

  /// Whether 100 episodes have ended.
  bool full() const { return episodes_ >= window; }
  /// Of the last 100; full() only. Summed anew each time: no error gathers.
  double mean() const;
  const std::optional<ReturnReached>& reached() const { return reached_; }

  void persist(Archive& archive);

 private:
  void decide(std::uint64_t step, double processor_seconds);

  std::optional<double> goal_;
  std::optional<ReturnReached> reached_;
  std::array<double, window> totals_{};
  std::uint64_t episodes_ = 0;
  FinishedEpisode open_;  // what the log has told of the episode that goes on
};

}  // namespace quoll
