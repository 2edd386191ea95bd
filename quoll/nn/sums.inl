// Sums of floats whose order does not depend on the width of a vector, once for each instruction
// set: numbers run in 16 columns, the second half of which is added to the first, and so on.

#if defined(QUOLL_NN_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_SUMS_INL
#undef QUOLL_NN_SUMS_INL
#else
#define QUOLL_NN_SUMS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/product.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

// 16 sums beside each other.
struct Sixteen {
  static constexpr std::size_t count = vector_width / lanes;
  Vector part[count];

  static HWY_INLINE Sixteen zero() {
    Sixteen sums;
    for (Vector& one : sums.part) one = hn::Zero(Wide());
    return sums;
  }
  HWY_INLINE float total() const {
    float x[vector_width];
    for (std::size_t v = 0; v < count; ++v) hn::StoreU(part[v], Wide(), x + v * lanes);
    for (std::size_t half = vector_width / 2; half > 0; half /= 2) {
      for (std::size_t i = 0; i < half; ++i) x[i] += x[i + half];
    }
    return x[0];
  }
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void totals(const Sixteen* rows, float* sums) {
  for (std::size_t i = 0; i < vector_width; ++i) sums[i] = rows[i].total();
}
#else
// A fold adds the second half of each row in `a` and `b` to the first, so that one vector holds
// both: rows of 16, of 8 (one block of 4 to another), of 4 and of 2 numbers.
HWY_INLINE Vector fold_16(Vector a, Vector b) {
  const Wide d;
  return hn::Add(hn::ConcatLowerLower(d, b, a), hn::ConcatUpperUpper(d, b, a));
}
HWY_INLINE Vector fold_8(Vector a, Vector b) {
  return hn::Add(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a),
                 hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a)));
}
HWY_INLINE Vector fold_4(Vector a, Vector b) {
  const Wide d;
  const hn::Repartition<double, Wide> pairs;
  const auto x = hn::BitCast(pairs, a), y = hn::BitCast(pairs, b);
  return hn::Add(hn::BitCast(d, hn::InterleaveLower(pairs, x, y)),
                 hn::BitCast(d, hn::InterleaveUpper(pairs, x, y)));
}
HWY_INLINE Vector fold_2(Vector a, Vector b) {
  return hn::Add(hn::OddEven(hn::Shuffle2301(b), a), hn::OddEven(b, hn::Shuffle2301(a)));
}

// sums[i] = rows[i].total() for 16 rows, with its bits.
HWY_INLINE void totals(const Sixteen* rows, float* sums) {
  // What is left of a row in one vector.
  const auto row = [&](std::size_t i) HWY_ATTR {
    const Vector* const part = rows[i].part;
    if constexpr (Sixteen::count == 4) {
      return hn::Add(hn::Add(part[0], part[2]), hn::Add(part[1], part[3]));
    } else if constexpr (Sixteen::count == 2) {
      return hn::Add(part[0], part[1]);
    } else {
      return part[0];
    }
  };
  // Row i in the first block of 4, row i + 4 in the second, and so on.
  const auto blocks = [&](std::size_t i) HWY_ATTR {
    if constexpr (lanes == 16) {
      return fold_8(fold_16(row(i), row(i + 8)), fold_16(row(i + 4), row(i + 12)));
    } else if constexpr (lanes == 8) {
      return fold_8(row(i), row(i + 4));
    } else {
      return row(i);
    }
  };
  for (std::size_t i = 0; i < vector_width; i += lanes) {
    const Vector even = fold_4(blocks(i), blocks(i + 2)),
                 odd = fold_4(blocks(i + 1), blocks(i + 3));
    hn::StoreU(fold_2(even, odd), Wide(), sums + i);
  }
}
#endif

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
