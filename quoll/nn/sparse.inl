// Layers over inputs that are mostly 0 (one-hot states, planes of 0 and 1), for arithmetic.cpp,
// once for each instruction set.
//
// Only what is not 0 is multiplied, in the order in which product() comes to it, so that the bits
// are those of product() over all inputs.

#if defined(QUOLL_NN_SPARSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_SPARSE_INL
#undef QUOLL_NN_SPARSE_INL
#else
#define QUOLL_NN_SPARSE_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/product.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

std::size_t find_spots(const float* x, std::size_t n, std::uint32_t* at, std::size_t most) {
  const Wide d;
  std::size_t count = 0, i = 0;
  for (; i + lanes <= n; i += lanes) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Not(hn::Eq(hn::LoadU(d, x + i), hn::Zero(d))), bytes);
    for (std::uint32_t bits = bytes[0] | std::uint32_t{bytes[1]} << 8; bits != 0;
         bits &= bits - 1) {
      if (count == most) return most + 1;
      at[count++] =
          static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(bits));
    }
  }
  for (; i < n; ++i) {
    if (x[i] == 0.0f) continue;
    if (count == most) return most + 1;
    at[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

// Calls use(place, input) for every place that reads number `at` of a sample, with which of its
// inputs that is.
template <class Use>
HWY_INLINE void each_reader(const Window& w, std::uint32_t at, const Use& use) {
  if (w.readers == nullptr) return use(0, at);
  const Readers r = w.readers[at];
  std::size_t place = r.place, input = r.input;
  for (std::size_t line = 0; line < r.lines; ++line, place += w.out_width, input -= w.down) {
    for (std::size_t i = 0; i < r.across; ++i) use(place + i, input - i * w.right);
  }
}

// to += factor * from; `row` is the width of a row where that is known beforehand.
template <std::size_t row>
HWY_INLINE void add_row(Vector factor, const float* from, float* to, std::size_t n) {
  const Wide d;
  if constexpr (row > 0) n = row;
#pragma GCC unroll 4
  for (std::size_t j = 0; j < n; j += lanes) {
    hn::StoreU(hn::MulAdd(factor, hn::LoadU(d, from + j), hn::LoadU(d, to + j)), d, to + j);
  }
}

template <std::size_t row>
HWY_INLINE void add_spots(const Window w, const Spots spots, const float* weights, float* y) {
  for (std::size_t i = 0; i < spots.count; ++i) {
    const Vector factor = hn::Set(Wide(), spots.x[spots.at[i]]);
    each_reader(w, spots.at[i], [&](std::size_t place, std::size_t input) HWY_ATTR {
      const std::size_t wide = row > 0 ? row : w.row;
      add_row<row>(factor, weights + input * wide, y + place * wide, wide);
    });
  }
}

void sparse_forward(const Window& w, const Spots& spots, const float* weights, const float* bias,
                    bool relu, float* y) {
  const Wide d;
  const std::size_t n = w.places * w.row;
  for (std::size_t at = 0; at < n; at += w.row) {
    for (std::size_t j = 0; j < w.row; j += lanes)
      hn::StoreU(hn::LoadU(d, bias + j), d, y + at + j);
  }
  if (w.row == vector_width) {
    add_spots<vector_width>(w, spots, weights, y);
  } else {
    add_spots<0>(w, spots, weights, y);
  }
  for (std::size_t i = 0; i < n && relu; i += lanes) {
    hn::StoreU(rectified(hn::LoadU(d, y + i)), d, y + i);
  }
}

template <std::size_t row>
HWY_INLINE void collect_spots(const Window w, const Spots spots, const float* by_y,
                              float* by_weights) {
  for (std::size_t i = 0; i < spots.count; ++i) {
    const Vector factor = hn::Set(Wide(), spots.x[spots.at[i]]);
    each_reader(w, spots.at[i], [&](std::size_t place, std::size_t input) HWY_ATTR {
      const std::size_t wide = row > 0 ? row : w.row;
      add_row<row>(factor, by_y + place * wide, by_weights + input * wide, wide);
    });
  }
}

void sparse_back(const Window& w, const Spots& spots, const float* by_y, float* by_weights) {
  if (w.row == vector_width) {
    collect_spots<vector_width>(w, spots, by_y, by_weights);
  } else {
    collect_spots<0>(w, spots, by_y, by_weights);
  }
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
