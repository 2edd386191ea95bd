#pragma once
// How the values of one state's actions lie in memory, and how the best of them is found. Two
// layouts: FourRows, rows padded to four so that a row is one 128-bit load, and RaggedRows, exactly
// one value per pair. Padding holds -infinity (never a maximiser), rows of ends hold 0. Both give
// the same choices for the same draws.

#include <cstdint>
#include <limits>

#include "quoll/base/random.hpp"
#include "quoll/model/mdp.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace quoll {

/// The largest value of a row and who attains it.
template <class Value>
struct RowView {
  Value best;
  std::uint32_t ties;   ///< FourRows: bit a set = action a attains it; RaggedRows: how many do
  std::uint32_t legal;  ///< number of actions
};

namespace detail {
/// nth_bit[mask][k] = index of the k-th set bit of a 4-bit mask.
inline constexpr std::uint8_t nth_bit[16][4] = {
    {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1, 1}, {0, 1, 1, 1}, {2, 2, 2, 2}, {0, 2, 2, 2},
    {1, 2, 2, 2}, {0, 1, 2, 2}, {3, 3, 3, 3}, {0, 3, 3, 3}, {1, 3, 3, 3}, {0, 1, 3, 3},
    {2, 3, 3, 3}, {0, 2, 3, 3}, {1, 2, 3, 3}, {0, 1, 2, 3}};
/// Number of set bits of a 4-bit mask: a table, since the base instruction set has no popcount.
inline constexpr std::uint8_t set_bits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
}  // namespace detail

template <class Value>
struct FourRows {
  bool full = false;  ///< every row that is looked at has four actions: no padding to count
  static constexpr Value padding = -std::numeric_limits<Value>::infinity();

  std::uint64_t pair(State state, Action action) const { return std::uint64_t{state} * 4 + action; }

  RowView<Value> view(const Value* values, State state) const {
    const Value* q = values + std::uint64_t{state} * 4;
#if defined(__SSE2__)
    if constexpr (sizeof(Value) == 4) {
      const __m128 row = _mm_loadu_ps(q);
      const __m128 swapped = _mm_max_ps(row, _mm_shuffle_ps(row, row, _MM_SHUFFLE(1, 0, 3, 2)));
      const __m128 best = _mm_max_ps(swapped, _mm_shuffle_ps(swapped, swapped, 0xb1));
      const auto ties = static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpeq_ps(row, best)));
      if (full) return {_mm_cvtss_f32(best), ties, 4};
      const auto closed =
          static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpeq_ps(row, _mm_set1_ps(padding))));
      return {_mm_cvtss_f32(best), ties, 4u - detail::set_bits[closed]};
    }
#endif
    const Value left = q[0] < q[1] ? q[1] : q[0], right = q[2] < q[3] ? q[3] : q[2];
    const Value best = left < right ? right : left;
    std::uint32_t ties = 0, legal = 0;
    for (std::uint32_t a = 0; a < 4; ++a) {
      ties |= std::uint32_t{q[a] == best} << a;
      legal += q[a] != padding;
    }
    return {best, ties, legal};
  }

  /// How many attain the maximum.
  std::uint32_t count(const RowView<Value>& row) const { return detail::set_bits[row.ties]; }
  /// The maximiser that the 32 random bits select, each with equal probability.
  Action pick(const Value*, State, const RowView<Value>& row, std::uint32_t bits) const {
    return detail::nth_bit[row.ties][scale(bits, count(row))];
  }
  /// The maximiser with the lowest index.
  Action first(const Value*, State, const RowView<Value>& row) const {
    return detail::nth_bit[row.ties][0];
  }
};

template <class Value>
struct RaggedRows {
  const std::uint64_t* begin;  ///< first pair of each state, and the end

  std::uint64_t pair(State state, Action action) const { return begin[state] + action; }

  RowView<Value> view(const Value* values, State state) const {
    const Value* q = values + begin[state];
    const auto legal = static_cast<std::uint32_t>(begin[state + 1] - begin[state]);
    if (legal == 0) return {0, 0, 0};
    Value best = q[0];
    std::uint32_t ties = 1;
    for (std::uint32_t a = 1; a < legal; ++a) {
      if (q[a] > best) {
        best = q[a];
        ties = 1;
      } else {
        ties += q[a] == best;
      }
    }
    return {best, ties, legal};
  }

  std::uint32_t count(const RowView<Value>& row) const { return row.ties; }
  Action pick(const Value* values, State state, const RowView<Value>& row,
              std::uint32_t bits) const {
    return nth(values, state, row, scale(bits, row.ties));
  }
  Action first(const Value* values, State state, const RowView<Value>& row) const {
    return nth(values, state, row, 0);
  }

 private:
  Action nth(const Value* values, State state, const RowView<Value>& row, std::uint32_t k) const {
    const Value* q = values + begin[state];
    for (Action a = 0; a < row.legal; ++a) {
      if (q[a] == row.best && k-- == 0) return a;
    }
    return 0;
  }
};

}  // namespace quoll
