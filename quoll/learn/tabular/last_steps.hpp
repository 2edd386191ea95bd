#pragma once
// The last n steps of an episode and what they returned: what n-step Q-learning and tree backup
// learn from. They differ only in what a state on the way is worth.

#include <cstdint>
#include <vector>

#include "quoll/learn/tabular/past_step.hpp"

namespace quoll {

/// worth(e, value) = what the state of `e` is taken to be worth when its action is worth `value`.
/// Returns are counted back from the best value of the last next state, each rounded as the table
/// is, so that the values of n = 1 are the fixed point of every n. Cost: n calls of worth a step.
template <class V>
class LastSteps {
 public:
  LastSteps(const LearnSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size), begin_(table.begin()), most_(setup.of_method.return_steps) {}

  /// Keeps a step; when n are kept, learns from the oldest and forgets it.
  template <class Worth>
  void add(const PastStep& step, ValueTable<V>& table, const Worth& worth) {
    kept_.push_back(step);
    if (kept_.size() < most_) return;
    double oldest = 0.0;
    back(table, worth, [&](const PastStep&, double value) { oldest = value; });
    learn_from(kept_.front(), oldest, table, step_size_);
    kept_.erase(kept_.begin());
  }

  /// Learns from all that are kept, the last first, each from its own part of the way; forgets
  /// them.
  template <class Worth>
  void learn_all(ValueTable<V>& table, const Worth& worth) {
    back(table, worth,
         [&](const PastStep& e, double value) { learn_from(e, value, table, step_size_); });
    kept_.clear();
  }

  double step_size(std::uint32_t n) const { return step_size_.at(n); }
  void persist(Archive& archive) { persist_steps(archive, kept_, begin_, most_); }

 private:
  // look(e, return of e) for each, the last first.
  template <class Worth, class Look>
  void back(const ValueTable<V>& table, const Worth& worth, const Look& look) const {
    if (kept_.empty()) return;
    double following = table.best_after(kept_.back().carry, kept_.back().next);
    for (auto e = kept_.rbegin(); e != kept_.rend(); ++e) {
      const double value = double{static_cast<V>(e->reward + e->carry * following)};
      following = worth(*e, value);
      look(*e, value);
    }
  }

  StepSize step_size_;
  const std::vector<std::uint64_t>& begin_;
  std::uint64_t most_;
  std::vector<PastStep> kept_;
};

/// Methods with a return of n steps: n at least 1.
inline Result<void> check_return_steps(const LearnSetup& setup) {
  if (setup.of_method.return_steps > 0) return {};
  return Error{"--return-steps", 0, 0, "a whole number of at least 1 expected, not '0'", ""};
}

}  // namespace quoll
