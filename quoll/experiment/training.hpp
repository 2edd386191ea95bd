#pragma once
// One seed of a run: a learner advanced in chunks until a limit or a goal, with its curve. Chunks
// end at exact steps and change no bit; everything that looks at a clock stands between them.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "quoll/experiment/learning_curve.hpp"
#include "quoll/experiment/record.hpp"
#include "quoll/experiment/return_watch.hpp"
#include "quoll/experiment/settings.hpp"
#include "quoll/learn/learner.hpp"

namespace quoll {

/// Why a run ended.
enum class Stop : std::uint8_t {
  none,
  steps,        ///< the steps asked for are done
  episodes,     ///< the episodes asked for are done
  time,         ///< the time asked for is over
  stable,       ///< nothing changes any more
  certified,    ///< the bounds are as close as was asked for
  reached,      ///< the mean return of training episodes that was asked for
  diverged,     ///< a value that is no number, or beyond 1e30
  budget,       ///< not stable within the default budget: a goal was missed
  interrupted,  ///< somebody asked to stop
};
std::string_view stop_name(Stop stop);

/// When a run ends; 0 = no such limit.
struct Limits {
  std::uint64_t steps = 0, episodes = 0;
  double seconds = 0.0;
  std::uint64_t budget = 0;           ///< steps after which a goal counts as missed
  std::optional<double> mean_return;  ///< of the last 100 training episodes: good enough
  /// Asked every so often whether the learner's policy is good enough; empty = never.
  std::function<bool(const Learner&)> referee;
};

class Training {
 public:
  /// Between chunks: the training so far; false asks it to stop.
  using Between = std::function<bool(const Training&)>;

  static Result<Training> make(const RunSettings& settings, std::uint64_t index, const World& world,
                               const std::vector<double>& initial_rewards);

  /// Advances until a limit is met or the learner halts. Does nothing when that is so already.
  Stop advance(const Limits& limits, const Between& between, const Sink& sink);

  std::uint64_t seed() const { return seed_; }
  std::uint32_t index() const { return index_; }
  const Learner& learner() const { return *learner_; }
  Learner& learner() { return *learner_; }
  const LearningCurve& curve() const { return curve_; }
  double seconds() const { return seconds_; }  ///< spent learning, resumed parts included
  double processor_seconds() const { return processor_seconds_; }  ///< the same, of this thread
  /// Mean return of the last 100 training episodes, where episodes are told of (of methods without
  /// a table, and where a mean return was asked for); none = fewer have ended.
  std::optional<double> training_return() const {
    return returns_.full() ? std::optional(returns_.mean()) : std::nullopt;
  }
  /// When the mean return asked for was reached; none = not yet.
  const std::optional<ReturnReached>& reached() const { return returns_.reached(); }
  Stop stop() const { return stop_; }

  /// What watches the experience, if a certificate is asked for.
  const Certifier* certifier() const { return certifier_ ? &*certifier_ : nullptr; }

  void persist(Archive& archive);

 private:
  // A Measure as it stood at the last record.
  struct Measured {
    double sum = 0.0;
    std::uint64_t count = 0;
    void persist(Archive& archive) {
      archive("sum", sum);
      archive("count", count);
    }
  };

  LearnProgress advance_by(std::uint64_t steps, const Limits& limits);
  std::uint64_t chunk(const Limits& limits, const LearnProgress& now) const;
  void record(const LearnProgress& now, const Sink& sink);

  std::uint64_t seed_ = 1;
  std::uint32_t index_ = 0;
  std::unique_ptr<Learner> learner_;
  bool approximates_ = false;
  std::optional<Certifier> certifier_;
  std::vector<Update> log_;     // for the certifier, or the returns of a table's episodes
  std::uint64_t refereed_ = 0;  // step of the referee's next look
  ReturnWatch returns_;
  LearningCurve curve_;
  std::vector<Measured> measured_;
  double seconds_ = 0.0, processor_seconds_ = 0.0;
  Stop stop_ = Stop::none;
};

}  // namespace quoll
