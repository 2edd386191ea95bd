// Layer normalisation and its gradient, for arithmetic.cpp, once for each instruction set.
//
// Rows may be as short as the channels of one place, so 16 of them are looked at together, and rows
// of 16 numbers are compiled for themselves.

#if defined(QUOLL_NN_NORMALISATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_NORMALISATION_INL
#undef QUOLL_NN_NORMALISATION_INL
#else
#define QUOLL_NN_NORMALISATION_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/sums.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

// The numbers of a row from column j on, those of the padding as 0.
HWY_INLINE Vector real(const Rows shape, std::size_t j, Vector x) {
  if (j + lanes <= shape.columns) return x;
  const std::size_t count = j < shape.columns ? shape.columns - j : 0;
  return hn::IfThenElseZero(hn::FirstN(Wide(), count), x);
}

// means[r] = the mean of term(r, j) over the columns j, for the first `rows` of 16.
template <class Term>
HWY_INLINE void row_means(const Rows shape, std::size_t rows, const Term& term, float* means) {
  const Wide d;
  Sixteen sums[vector_width];
  for (std::size_t r = 0; r < rows; ++r) {
    Sixteen sum = Sixteen::zero();
    for (std::size_t j = 0; j < shape.columns; j += vector_width) {
      for (std::size_t v = 0; v < Sixteen::count; ++v) {
        const std::size_t at = j + v * lanes;
        sum.part[v] = hn::Add(sum.part[v], real(shape, at, term(r, at)));
      }
    }
    sums[r] = sum;
  }
  for (std::size_t r = rows; r < vector_width; ++r) sums[r] = Sixteen::zero();
  totals(sums, means);
  const Vector count = hn::Set(d, static_cast<float>(shape.columns));
  for (std::size_t r = 0; r < vector_width; r += lanes) {
    hn::StoreU(hn::Div(hn::LoadU(d, means + r), count), d, means + r);
  }
}

HWY_INLINE void normalise_rows(const Rows shape, float epsilon, float* x, const float* gain,
                               const float* shift, bool relu, float* y, float* scales) {
  const Wide d;
  float means[vector_width], roots[vector_width];
  for (std::size_t begin = 0; begin < shape.rows; begin += vector_width) {
    const std::size_t rows = std::min(vector_width, shape.rows - begin);
    float* const from = x + begin * shape.row;
    float* const to = y + begin * shape.row;
    const auto at = [&](std::size_t r, std::size_t j)
                        HWY_ATTR { return hn::LoadU(d, from + r * shape.row + j); };
    const auto off = [&](std::size_t r, std::size_t j)
                         HWY_ATTR { return hn::Sub(at(r, j), hn::Set(d, means[r])); };
    row_means(shape, rows, at, means);
    row_means(
        shape, rows,
        [&](std::size_t r, std::size_t j) HWY_ATTR {
          const Vector one = off(r, j);
          return hn::Mul(one, one);
        },
        roots);
    for (std::size_t r = 0; r < vector_width; r += lanes) {
      const Vector variance = hn::LoadU(d, roots + r);
      const Vector root = hn::Sqrt(hn::Add(variance, hn::Set(d, epsilon)));
      hn::StoreU(hn::Div(hn::Set(d, 1.0f), root), d, roots + r);
    }
    std::copy_n(roots, rows, scales + begin);
    for (std::size_t r = 0; r < rows; ++r) {
      const Vector scale = hn::Set(d, roots[r]);
      for (std::size_t j = 0; j < shape.row; j += lanes) {
        const Vector z = real(shape, j, hn::Mul(off(r, j), scale));
        hn::StoreU(z, d, from + r * shape.row + j);
        const Vector sum = hn::MulAdd(z, hn::LoadU(d, gain + j), hn::LoadU(d, shift + j));
        hn::StoreU(relu ? rectified(sum) : sum, d, to + r * shape.row + j);
      }
    }
  }
}

void normalise(Rows shape, float epsilon, float* x, const float* gain, const float* shift,
               bool relu, float* y, float* scales) {
  if (shape.columns == vector_width) {
    normalise_rows({shape.rows, vector_width, vector_width}, epsilon, x, gain, shift, relu, y,
                   scales);
  } else {
    normalise_rows(shape, epsilon, x, gain, shift, relu, y, scales);
  }
}

// With h = gradient * gain and z the normalised row: (h - mean(h) - z mean(h z)) * scale.
HWY_INLINE void normalise_rows_back(const Rows shape, const float* normalised, const float* scales,
                                    const float* gain, float* gradient, float* gain_gradient,
                                    float* shift_gradient) {
  const Wide d;
  for (std::size_t j = 0; j < shape.row; j += lanes) {
    hn::StoreU(hn::Zero(d), d, gain_gradient + j);
    hn::StoreU(hn::Zero(d), d, shift_gradient + j);
  }
  float means[vector_width], along[vector_width];
  for (std::size_t begin = 0; begin < shape.rows; begin += vector_width) {
    const std::size_t rows = std::min(vector_width, shape.rows - begin);
    const float* const z = normalised + begin * shape.row;
    float* const g = gradient + begin * shape.row;
    const auto h = [&](std::size_t r, std::size_t j) HWY_ATTR {
      return hn::Mul(hn::LoadU(d, g + r * shape.row + j), hn::LoadU(d, gain + j));
    };
    row_means(shape, rows, h, means);
    row_means(
        shape, rows,
        [&](std::size_t r, std::size_t j)
            HWY_ATTR { return hn::Mul(h(r, j), hn::LoadU(d, z + r * shape.row + j)); },
        along);
    for (std::size_t j = 0; j < shape.row; j += lanes) {
      Vector by_gain = hn::LoadU(d, gain_gradient + j);
      Vector by_shift = hn::LoadU(d, shift_gradient + j);
      for (std::size_t r = 0; r < rows; ++r) {
        float* const at = g + r * shape.row + j;
        const Vector zj = hn::LoadU(d, z + r * shape.row + j), gj = hn::LoadU(d, at);
        by_gain = hn::MulAdd(gj, zj, by_gain);
        by_shift = hn::Add(gj, by_shift);
        const Vector off =
            hn::NegMulAdd(zj, hn::Set(d, along[r]), hn::Sub(h(r, j), hn::Set(d, means[r])));
        hn::StoreU(real(shape, j, hn::Mul(off, hn::Set(d, scales[begin + r]))), d, at);
      }
      hn::StoreU(by_gain, d, gain_gradient + j);
      hn::StoreU(by_shift, d, shift_gradient + j);
    }
  }
}

void normalise_back(Rows shape, const float* normalised, const float* scales, const float* gain,
                    float* gradient, float* gain_gradient, float* shift_gradient) {
  if (shape.columns == vector_width) {
    normalise_rows_back({shape.rows, vector_width, vector_width}, normalised, scales, gain,
                        gradient, gain_gradient, shift_gradient);
  } else {
    normalise_rows_back(shape, normalised, scales, gain, gradient, gain_gradient, shift_gradient);
  }
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
