// The matrix product of arithmetic.cpp, once for each instruction set.
//
// C is cut into tiles of MR rows x NV vectors, which stay in registers while k runs; a block of 128
// or 384 k at a time, so that the rows of B in use stay in the near caches. Sums go on from
// what C holds, so that blocks change no bit. A is read where it lies, also transposed.

#if defined(QUOLL_NN_PRODUCT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_PRODUCT_INL
#undef QUOLL_NN_PRODUCT_INL
#else
#define QUOLL_NN_PRODUCT_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "quoll/nn/arithmetic.hpp"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<float, vector_width>;
using Vector = hn::Vec<Wide>;
constexpr std::size_t lanes = hn::MaxLanes(Wide());

// 0 for what is below; what is no number stays so, whatever a maximum makes of it.
HWY_INLINE Vector rectified(Vector x) {
  return hn::IfThenZeroElse(hn::Lt(x, hn::Zero(Wide())), x);
}

struct Block {
  std::size_t row, column, k_begin, k_end;
  bool first, last;  // of the blocks of k
};

template <int MR, int NV, bool across>
HWY_INLINE void tile(const Product& p, const Block& at) {
  const Wide d;
  Vector sums[MR][NV];
  float* const c = p.c + at.row * p.c_row + at.column;
  const bool go_on = p.add || !at.first;
#pragma GCC unroll 16
  for (int v = 0; v < NV; ++v) {
    const Vector begin =
        p.bias != nullptr && !go_on ? hn::LoadU(d, p.bias + at.column + v * lanes) : hn::Zero(d);
#pragma GCC unroll 16
    for (int r = 0; r < MR; ++r) {
      sums[r][v] = go_on ? hn::LoadU(d, c + r * p.c_row + v * lanes) : begin;
    }
  }
  const float* a = p.a + at.row * p.a_row + at.k_begin * p.a_column;
  const float* b = p.b + at.k_begin * p.b_row + at.column;
  const std::size_t a_row = across ? 1 : p.a_row;
  const std::size_t a_column = across ? p.a_column : 1;
  for (std::size_t k = at.k_begin; k < at.k_end; ++k) {
    Vector row[NV];
#pragma GCC unroll 16
    for (int v = 0; v < NV; ++v) row[v] = hn::LoadU(d, b + v * lanes);
#pragma GCC unroll 16
    for (int r = 0; r < MR; ++r) {
      const Vector factor = hn::Set(d, a[r * a_row]);
#pragma GCC unroll 16
      for (int v = 0; v < NV; ++v) sums[r][v] = hn::MulAdd(factor, row[v], sums[r][v]);
    }
    a += a_column;
    b += p.b_row;
  }
  const bool cut = p.relu && at.last;
#pragma GCC unroll 16
  for (int r = 0; r < MR; ++r) {
#pragma GCC unroll 16
    for (int v = 0; v < NV; ++v) {
      const Vector sum = cut ? rectified(sums[r][v]) : sums[r][v];
      hn::StoreU(sum, d, c + r * p.c_row + v * lanes);
    }
  }
}

// All rows of NV vectors of columns, in tiles of nearly the same number of rows, at most MR.
template <int MR, int NV, bool across>
HWY_INLINE void tile_of(std::size_t rows, const Product& p, const Block& at) {
  if constexpr (MR > 1) {
    if (rows < MR) return tile_of<MR - 1, NV, across>(rows, p, at);
  }
  tile<MR, NV, across>(p, at);
}

template <int MR, int NV, bool across>
void panel(const Product& p, Block at) {
  const std::size_t tiles = (p.m + MR - 1) / MR;
  for (std::size_t i = 0; i < tiles; ++i) {
    at.row = i * p.m / tiles;
    tile_of<MR, NV, across>((i + 1) * p.m / tiles - at.row, p, at);
  }
}

// As many rows as the registers hold beside the row of B and a factor of A.
template <int NV, bool across>
void panel_of(const Product& p, const Block& at) {
  constexpr int most = lanes == 16 ? 26 / NV : 12 / NV;
  panel<std::min(most, 12), NV, across>(p, at);
}

template <bool across>
void columns(const Product& p, Block at) {
  constexpr int widest = lanes == 16 ? 4 : 2;
  std::size_t left = p.n / lanes;
  at.column = 0;
  // A row alone has too few sums to hide the time of one: more columns at once.
  for (; p.m == 1 && left >= 8; left -= 8, at.column += 8 * lanes) tile<1, 8, across>(p, at);
  while (left > 0) {
    // 5 = 3 + 2, rather than 4 + 1.
    const std::size_t take = left == 5 && widest == 4 ? 3 : std::min<std::size_t>(left, widest);
    switch (take) {
      case 4:
        panel_of<widest, across>(p, at);
        break;
      case 3:
        panel_of<std::min(3, widest), across>(p, at);
        break;
      case 2:
        panel_of<2, across>(p, at);
        break;
      default:
        panel_of<1, across>(p, at);
        break;
    }
    at.column += take * lanes;
    left -= take;
  }
}

void product(const Product& p) {
  // Where A is read across its rows, which may lie a power of two apart, fewer lines of it stay in
  // the caches.
  const std::size_t depth = p.a_row == 1 ? 128 : 384;
  Block at{};
  do {
    at.first = at.k_begin == 0;
    at.k_end = std::min(p.k, at.k_begin + depth);
    at.last = at.k_end == p.k;
    if (p.a_row == 1) {
      columns<true>(p, at);
    } else {
      columns<false>(p, at);
    }
    at.k_begin = at.k_end;
  } while (!at.last);
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
