#pragma once
// The model that experience shows: how often each pair was tried, what followed how often, and what
// it earned on average. What was never seen is not in it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// The successor of a step that ended the episode: worth nothing, whatever state it shows.
inline constexpr State the_end = std::numeric_limits<State>::max();

class CountedModel {
 public:
  /// One kind of outcome of a pair.
  struct Outcome {
    double reward_sum = 0.0;
    State next = the_end;
    std::uint32_t count = 0;
    std::uint32_t link = none;  // of the pair's next outcome
    bool turn_passes = false;

    double mean_reward() const { return reward_sum / count; }
    bool gave(double reward) const {
      return std::fabs(mean_reward() - reward) <= 1e-9 * std::max(1.0, std::fabs(reward));
    }
    void persist(Archive& archive) {
      archive("next", next);
      archive("turn_passes", turn_passes);
      archive("count", count);
      archive("reward_sum", reward_sum);
      archive("link", link);
    }
  };

  CountedModel() = default;
  /// Room for one outcome of each pair is reserved.
  explicit CountedModel(std::uint64_t pairs) : first_(pairs, none), tried_(pairs, 0) {
    outcomes_.reserve(pairs);
  }

  std::uint64_t pairs() const { return first_.size(); }
  /// Kinds of outcomes seen, of all pairs.
  std::uint64_t outcomes() const { return outcomes_.size(); }
  std::uint32_t tried(std::uint64_t pair) const { return tried_[pair]; }

  /// Counts a step; `next` = the_end where it ended the episode. True when this outcome of the pair
  /// is new. Ends of different reward are different outcomes, sixteen at most. Cost: the outcomes
  /// of the pair seen so far.
  bool observe(std::uint64_t pair, State next, double reward, bool turn_passes = false) {
    ++tried_[pair];
    std::uint32_t* at = &first_[pair];
    for (int ends = 0; *at != none;) {
      Outcome& outcome = outcomes_[*at];
      if (outcome.next == next && outcome.turn_passes == turn_passes &&
          (next != the_end || outcome.gave(reward) || ++ends == most_ends)) {
        ++outcome.count;
        outcome.reward_sum += reward;
        return false;
      }
      at = &outcome.link;
    }
    *at = static_cast<std::uint32_t>(outcomes_.size());
    outcomes_.push_back({reward, next, 1, none, turn_passes});
    return true;
  }

  /// Calls look(outcome) for each outcome of the pair, in the order they were first seen.
  template <class Look>
  void each(std::uint64_t pair, const Look& look) const {
    for (std::uint32_t i = first_[pair]; i != none; i = outcomes_[i].link) look(outcomes_[i]);
  }

  /// sum_s' c/N (mean reward + discount * value(s')); 0 for a pair never tried.
  template <class Value>
  double backup(std::uint64_t pair, double discount, const Value& value) const {
    double sum = 0.0;
    each(pair, [&](const Outcome& outcome) {
      sum += outcome.reward_sum;
      if (outcome.next == the_end) return;
      const double carry = outcome.turn_passes ? -discount : discount;
      sum += outcome.count * (carry * value(outcome.next));
    });
    return tried_[pair] == 0 ? 0.0 : sum / tried_[pair];
  }

  /// Refuses what no experience in a world of so many states can have left.
  void persist(Archive& archive, std::uint64_t states) {
    const std::size_t pairs = first_.size();
    archive("first", first_);
    archive("tried", tried_);
    archive("outcomes", outcomes_);
    if (archive.saving()) return;
    bool fits = first_.size() == pairs && tried_.size() == pairs;
    // Links lead forwards, so that no list can run in a circle.
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
      const Outcome& o = outcomes_[i];
      fits = fits && (o.next < states || o.next == the_end) && o.count > 0 &&
             (o.link == none || (o.link > i && o.link < outcomes_.size()));
    }
    for (const std::uint32_t i : first_) fits = fits && (i == none || i < outcomes_.size());
    if (fits) return;
    archive.fail("a model of another world");
    *this = CountedModel(pairs);
  }

 private:
  static constexpr int most_ends = 16;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> first_;  // per pair: its first outcome
  std::vector<std::uint32_t> tried_;
  std::vector<Outcome> outcomes_;
};

}  // namespace quoll
