// Rows become columns, for arithmetic.cpp, once for each instruction set.

#if defined(QUOLL_NN_TRANSPOSITION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_TRANSPOSITION_INL
#undef QUOLL_NN_TRANSPOSITION_INL
#else
#define QUOLL_NN_TRANSPOSITION_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/product.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void turn_square(const float* from, std::size_t, float* to, std::size_t) {
  *to = *from;
}
#else
// Each block of 4 numbers of four vectors on its own: vector i then holds what was number i of
// them.
HWY_INLINE void turn_blocks(Vector* x) {
  const Wide d;
  const Vector low02 = hn::InterleaveLower(d, x[0], x[2]),
               high02 = hn::InterleaveUpper(d, x[0], x[2]);
  const Vector low13 = hn::InterleaveLower(d, x[1], x[3]),
               high13 = hn::InterleaveUpper(d, x[1], x[3]);
  x[0] = hn::InterleaveLower(d, low02, low13);
  x[1] = hn::InterleaveUpper(d, low02, low13);
  x[2] = hn::InterleaveLower(d, high02, high13);
  x[3] = hn::InterleaveUpper(d, high02, high13);
}

// A square of as many rows as a vector has lanes.
HWY_INLINE void turn_square(const float* from, std::size_t from_row, float* to,
                            std::size_t to_row) {
  const Wide d;
  Vector x[lanes];
#pragma GCC unroll 16
  for (std::size_t i = 0; i < lanes; ++i) x[i] = hn::LoadU(d, from + i * from_row);
#pragma GCC unroll 16
  for (std::size_t i = 0; i < lanes; i += 4) turn_blocks(x + i);
  const auto put = [&](std::size_t j, Vector y) HWY_ATTR { hn::StoreU(y, d, to + j * to_row); };
  // Block b of x[i + j] is the b-th four of column 4 b + j, rows i to i + 3.
#pragma GCC unroll 4
  for (std::size_t j = 0; j < 4; ++j) {
    if constexpr (lanes == 16) {
      const auto even = [&](std::size_t i) HWY_ATTR {
        return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(x[i + 4]), x[i]);
      };
      const auto odd = [&](std::size_t i) HWY_ATTR {
        return hn::OddEvenBlocks(x[i + 4], hn::SwapAdjacentBlocks(x[i]));
      };
      put(j, hn::ConcatLowerLower(d, even(j + 8), even(j)));
      put(j + 4, hn::ConcatLowerLower(d, odd(j + 8), odd(j)));
      put(j + 8, hn::ConcatUpperUpper(d, even(j + 8), even(j)));
      put(j + 12, hn::ConcatUpperUpper(d, odd(j + 8), odd(j)));
    } else if constexpr (lanes == 8) {
      put(j, hn::ConcatLowerLower(d, x[j + 4], x[j]));
      put(j + 4, hn::ConcatUpperUpper(d, x[j + 4], x[j]));
    } else {
      put(j, x[j]);
    }
  }
}
#endif

// In squares of 16 x 16, so that cache lines are read and written whole: rows of `to` a power of
// two apart would otherwise drive each other out of the cache before they are.
void transpose(const float* from, std::size_t rows, std::size_t columns, std::size_t from_row,
               float* to, std::size_t to_row) {
  for (std::size_t right = 0; right < columns; right += vector_width) {
    for (std::size_t down = 0; down < rows; down += vector_width) {
      for (std::size_t j = right; j < right + vector_width; j += lanes) {
        for (std::size_t i = down; i < down + vector_width; i += lanes) {
          turn_square(from + i * from_row + j, from_row, to + j * to_row + i, to_row);
        }
      }
    }
  }
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
