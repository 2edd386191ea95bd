#pragma once
// Watching for the point from which nothing changes any more. A counter per pair; all start again
// when a value moves by more than the tolerance or a greedy set changes; stable when every
// reachable pair was visited K times since. The movement of a pair is the mean of its undamped
// errors (target - old) over K visits; with K = 1, tolerance 0 and step size 1 in a deterministic
// world, stability proves that the table is the fixed point of its update.

#include <cmath>
#include <cstdint>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

class Stability {
 public:
  Stability() = default;
  Stability(const StableSetup& setup, std::uint64_t pairs) : setup_(setup), required_(setup.pairs) {
    if (setup.watch) marks_.resize(pairs);
  }

  bool watching() const { return setup_.watch; }
  /// True when the pairs that count are those of the states met so far.
  bool counts_met() const { return setup_.pairs == 0; }
  /// Another state was met for the first time: its pairs count too.
  void met(std::uint64_t pairs) { required_ += pairs; }

  /// One visit; `error` = target - old, `scale` = max(1, |Q|). True when stable.
  bool visited(std::uint64_t pair, double error, double scale, bool greedy_set_changed) {
    if (greedy_set_changed) return restart();
    Mark& mark = marks_[pair];
    if (mark.epoch != epoch_) mark = {epoch_, 0, 0.0f};
    mark.error += static_cast<float>(error);
    // K visits settle a pair; each K more test it again, without counting on for ever.
    const bool again = ++mark.visits == 2 * setup_.visits;
    if (again || mark.visits == setup_.visits) {
      const double mean = double{mark.error} / setup_.visits;
      if (!(std::fabs(mean) <= setup_.tolerance * scale)) return restart();
      mark.error = 0.0f;
      mark.visits = setup_.visits;
      settled_ += !again;
    }
    return settled_ >= required_;
  }

  /// A run that did not watch so far begins to; one that no longer watches forgets.
  void persist(Archive& archive) {
    std::vector<std::uint32_t> epochs, visits;
    std::vector<float> errors;
    for (const Mark& mark : marks_) {
      epochs.push_back(mark.epoch);
      visits.push_back(mark.visits);
      errors.push_back(mark.error);
    }
    Stability saved = *this;
    archive("epoch", saved.epoch_);
    archive("settled", saved.settled_);
    archive("required", saved.required_);
    archive("mark_epochs", epochs);
    archive("mark_visits", visits);
    archive("mark_errors", errors);
    if (archive.saving() || !setup_.watch || epochs.empty()) return;
    if (epochs.size() != marks_.size() || visits.size() != marks_.size() ||
        errors.size() != marks_.size()) {
      return archive.fail("the saved table does not fit this world");
    }
    for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i] = {epochs[i], visits[i], errors[i]};
    epoch_ = saved.epoch_;
    settled_ = saved.settled_;
    required_ = saved.required_;
  }

 private:
  struct Mark {
    std::uint32_t epoch = 0, visits = 0;
    float error = 0.0f;
  };

  bool restart() {
    settled_ = 0;
    if (++epoch_ == 0) {  // after 2^32 restarts: forget the old epochs
      for (Mark& mark : marks_) mark = {};
      epoch_ = 1;
    }
    return false;
  }

  StableSetup setup_;
  std::vector<Mark> marks_;
  std::uint32_t epoch_ = 1;
  std::uint64_t settled_ = 0, required_ = 0;
};

}  // namespace quoll
