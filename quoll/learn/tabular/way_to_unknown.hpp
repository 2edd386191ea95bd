#pragma once
// Optimism in a world without noise: the way from a state to what is worth most if every pair not
// tried yet is worth the most that anything can be.

#include <cstdint>
#include <vector>

#include "quoll/learn/tabular/counted_model.hpp"

namespace quoll {

/// Best-first search (Dijkstra 1959) on what the most, `best`, exceeds a way by. A step that goes
/// on from where g = discount^k is left adds g (best - r - discount best) >= 0, an end adds g (best
/// - r), a pair never tried adds nothing; ways of equal excess are taken by length. Each state is
/// expanded once, the first time it is reached: where rewards differ from step to step a later,
/// longer way into it could be better by less than its excess; what is explored is not affected,
/// only in which order.
class WayToUnknown {
 public:
  explicit WayToUnknown(std::uint64_t states) : met_(states, 0) {}

  /// The pairs to take from `from`, in order, to a pair never tried or to an end; empty when
  /// neither can be reached. `begin` = first pair of each state, and the end. Cost: the part of the
  /// world that is nearer than the answer.
  const std::vector<std::uint64_t>& find(const CountedModel& model,
                                         const std::vector<std::uint64_t>& begin, State from,
                                         double best, double discount);

 private:
  struct Label {
    double excess = 0.0, factor = 1.0;  // factor = discount^steps
    std::uint32_t steps = 0, parent = 0;
    State state = 0;
    std::uint64_t pair = 0;  // by which it was reached
  };

  bool later(std::uint32_t a, std::uint32_t b) const;
  void push(const Label& label);
  std::uint32_t pop();
  void trace(std::uint32_t label);

  std::vector<std::uint32_t> met_;  // per state: the search that expanded it
  std::uint32_t search_ = 0;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> heap_;
  std::vector<std::uint64_t> way_;
};

}  // namespace quoll
