#pragma once
// The table of a method with memory: a value and a count per pair, rows without padding. Whatever
// changes a value goes through set(), so that watching for stability misses nothing.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/act/rows.hpp"
#include "quoll/base/archive.hpp"

namespace quoll {

template <class V>
class ValueTable {
 public:
  using Value = V;

  /// `begin` = first pair of each state, and the end; ends have no pairs, or one nobody acts on.
  ValueTable(std::vector<std::uint64_t> begin, Value initial)
      : begin_(std::move(begin)), values_(begin_.back(), initial), visits_(begin_.back()) {}

  std::uint64_t states() const { return begin_.size() - 1; }
  std::uint64_t pairs() const { return values_.size(); }
  const std::vector<std::uint64_t>& begin() const { return begin_; }
  std::uint64_t begin(State s) const { return begin_[s]; }
  Action actions(State s) const { return static_cast<Action>(begin_[s + 1] - begin_[s]); }
  std::uint64_t pair(State s, Action a) const { return begin_[s] + a; }

  Value operator[](std::uint64_t pair) const { return values_[pair]; }
  const Value* values() const { return values_.data(); }
  const std::uint32_t* visits() const { return visits_.data(); }
  std::uint32_t visits(std::uint64_t pair) const { return visits_[pair]; }
  RaggedRows<Value> rows() const { return {begin_.data()}; }
  RowView<Value> row(State s) const { return rows().view(values_.data(), s); }
  /// max_a Q(s, a); 0 without actions. The first four are compared without a branch: how many
  /// actions the state of a random walk has is nothing a processor can guess.
  double best(State s) const {
    const Value* const q = values_.data() + begin_[s];
    const std::uint64_t n = begin_[s + 1] - begin_[s];
    if (n == 0) return 0.0;
    const auto at = [&](std::uint64_t a) { return q[std::min(a, n - 1)]; };
    Value best = larger(larger(at(0), at(1)), larger(at(2), at(3)));
    for (std::uint64_t a = 4; a < n; ++a) best = larger(best, q[a]);
    return double{best};
  }

  /// max_b Q(next, b), or 0 where `carry` says that nothing follows.
  double best_after(double carry, State next) const { return carry == 0.0 ? 0.0 : best(next); }

  /// One more visit; returns the count, which stops at 2^32 - 1.
  std::uint32_t visit(std::uint64_t pair) { return visits_[pair] += visits_[pair] != ~0u; }

  /// Q(s, a) <- value.
  void set(State s, std::uint64_t pair, Value value) {
    if (watch_ == Watch::nothing) {
      values_[pair] = value;
      return;
    }
    const Value old = values_[pair];
    if (value == old) return;
    const RowView<Value> before = row(s);
    values_[pair] = value;
    const RowView<Value> after = row(s);
    const bool was_best = old == before.best, is_best = value == after.best;
    moved_ = moved_ || watch_ == Watch::values || was_best != is_best ||
             (is_best && before.ties != after.ties);
  }

  /// What counts as a movement: any change of a value, or only one of a greedy set.
  enum class Watch : std::uint8_t { nothing, greedy_sets, values };
  void watch(Watch what) { watch_ = what; }
  /// Whether there was a movement since the last call.
  bool take_moved() { return std::exchange(moved_, false); }

  void persist(Archive& archive) {
    const std::size_t pairs = values_.size();
    archive("values", values_);
    archive("visits", visits_);
    if (archive.saving() || (values_.size() == pairs && visits_.size() == pairs)) return;
    archive.fail("the saved table does not fit this world");
    values_.resize(pairs);
    visits_.resize(pairs);
  }

 private:
  static Value larger(Value a, Value b) { return b > a ? b : a; }

  std::vector<std::uint64_t> begin_;
  std::vector<Value> values_;
  std::vector<std::uint32_t> visits_;
  Watch watch_ = Watch::nothing;
  bool moved_ = false;
};

}  // namespace quoll
