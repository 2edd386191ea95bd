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

/// The largest value of a row, who attains it and who is there: FourRows tell by a mask (bit a =
/// action a), RaggedRows how many.
template <class Value>
struct RowView {
  Value best;
  std::uint32_t ties;   ///< the actions that attain it
  std::uint32_t legal;  ///< the actions of the state
};

namespace detail {
/// Number of set bits of a 4-bit mask: a table, since the base instruction set has no popcount.
inline constexpr std::uint8_t set_bits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/// What scale(bits, n) is for every n up to 4 at once: n = 4 in the low two bits (n = 2 in the
/// upper one of them), n = 3 above. It does not wait for the row, as scale(bits, ties) would.
constexpr std::uint32_t quarters_and_thirds(std::uint32_t bits) {
  return bits >> 30 | scale(bits, 3) << 2;
}

/// picked_bit.index[quarters_and_thirds(bits)][mask] = index of the set bit that `bits` select.
struct PickedBit {
  std::uint8_t index[16][16] = {};
  constexpr PickedBit() {
    for (std::uint32_t mask = 1; mask < 16; ++mask) {
      for (std::uint32_t code = 0; code < 16; ++code) {
        const std::uint32_t of[5] = {0, 0, code >> 1 & 1, code >> 2, code & 3};
        std::uint32_t left = of[set_bits[mask]], bit = 0;
        while (bit < 3 && (!(mask >> bit & 1) || left-- > 0)) ++bit;
        index[code][mask] = static_cast<std::uint8_t>(bit);
      }
    }
  }
};
inline constexpr PickedBit picked_bit;
}  // namespace detail

template <class Value>
struct FourRows {
  bool full = false;  ///< every row that is looked at has four actions: no padding to look for
  static constexpr Value padding = -std::numeric_limits<Value>::infinity();

  std::uint64_t pair(State state, Action action) const { return std::uint64_t{state} * 4 + action; }

  [[gnu::always_inline]] RowView<Value> view(const Value* values, State state) const {
    const Value* q = values + std::uint64_t{state} * 4;
#if defined(__SSE2__)
    if constexpr (sizeof(Value) == 4) {
      const __m128 row = _mm_loadu_ps(q);
      const __m128 swapped = _mm_max_ps(row, _mm_shuffle_ps(row, row, _MM_SHUFFLE(1, 0, 3, 2)));
      const __m128 best = _mm_max_ps(swapped, _mm_shuffle_ps(swapped, swapped, 0xb1));
      const auto ties = static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpeq_ps(row, best)));
      if (full) return {_mm_cvtss_f32(best), ties, 15};
      const auto legal =
          static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpneq_ps(row, _mm_set1_ps(padding))));
      return {_mm_cvtss_f32(best), ties, legal};
    }
#endif
    const Value left = q[0] < q[1] ? q[1] : q[0], right = q[2] < q[3] ? q[3] : q[2];
    const Value best = left < right ? right : left;
    std::uint32_t ties = 0, legal = 0;
    for (std::uint32_t a = 0; a < 4; ++a) {
      ties |= std::uint32_t{q[a] == best} << a;
      legal |= std::uint32_t{q[a] != padding} << a;
    }
    return {best, ties, legal};
  }

  /// How many attain the maximum, and how many actions there are.
  std::uint32_t ties(const RowView<Value>& row) const { return detail::set_bits[row.ties]; }
  std::uint32_t legal(const RowView<Value>& row) const { return detail::set_bits[row.legal]; }
  /// The maximiser that the 32 random bits select, each with equal probability.
  Action pick(const Value*, State, const RowView<Value>& row, std::uint32_t bits) const {
    return of(row.ties, bits);
  }
  /// The maximiser with the lowest index.
  Action first(const Value*, State, const RowView<Value>& row) const { return of(row.ties, 0); }
  /// The action that the 32 random bits select, each with equal probability.
  Action any(const RowView<Value>& row, std::uint32_t bits) const { return of(row.legal, bits); }
  /// The action of a mask that the 32 random bits select.
  static Action of(std::uint32_t mask, std::uint32_t bits) {
    return detail::picked_bit.index[detail::quarters_and_thirds(bits)][mask];
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

  std::uint32_t ties(const RowView<Value>& row) const { return row.ties; }
  std::uint32_t legal(const RowView<Value>& row) const { return row.legal; }
  Action pick(const Value* values, State state, const RowView<Value>& row,
              std::uint32_t bits) const {
    return nth(values, state, row, scale(bits, row.ties));
  }
  Action first(const Value* values, State state, const RowView<Value>& row) const {
    return nth(values, state, row, 0);
  }
  Action any(const RowView<Value>& row, std::uint32_t bits) const { return scale(bits, row.legal); }

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
