// The loops over flat arrays of arithmetic.cpp, once for each instruction set.

#if defined(QUOLL_NN_ELEMENTWISE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_ELEMENTWISE_INL
#undef QUOLL_NN_ELEMENTWISE_INL
#else
#define QUOLL_NN_ELEMENTWISE_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/sums.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

// e^x = 2^n + 2^n (e^r - 1) with |r| <= log(2) / 2, for x <= 88, anything for larger ones.
struct Exponential {
  Vector power, rest;  // 2^n, e^r - 1
};
HWY_INLINE Exponential exponential(Vector x) {
  const Wide d;
  const Vector least = hn::Set(d, -87.0f);
  x = hn::IfThenElse(hn::Lt(x, least), least, x);
  // Added to 1.5 * 2^23 a float is rounded to a whole number n, which its lowest bits then hold.
  const Vector large = hn::Set(d, 0x1.8p23f);
  const Vector rounded = hn::Add(hn::Mul(x, hn::Set(d, 1.44269504f)), large);
  const Vector n = hn::Sub(rounded, large);
  Vector r = hn::NegMulAdd(n, hn::Set(d, 0.693359375f), x);
  r = hn::NegMulAdd(n, hn::Set(d, -2.12194440e-4f), r);
  Vector sum = hn::Set(d, 1.0f / 5040);
  for (const float coefficient : {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 1.0f / 2}) {
    sum = hn::MulAdd(sum, r, hn::Set(d, coefficient));
  }
  sum = hn::MulAdd(hn::Mul(r, r), sum, r);
  const hn::RebindToSigned<Wide> di;
  const auto bits = hn::ShiftLeft<23>(hn::Add(hn::BitCast(di, rounded), hn::Set(di, 127)));
  return {hn::BitCast(d, bits), sum};
}

HWY_INLINE Vector exponential_less_1(Vector x) {
  const Exponential e = exponential(x);
  return hn::MulAdd(e.rest, e.power, hn::Sub(e.power, hn::Set(Wide(), 1.0f)));
}

// Of what is below -87 0: there floats end.
void exponentials(float* values, std::size_t n) {
  const Wide d;
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector x = hn::LoadU(d, values + i);
    const Exponential e = exponential(x);
    const Vector power = hn::MulAdd(e.rest, e.power, e.power);
    hn::StoreU(hn::IfThenZeroElse(hn::Lt(x, hn::Set(d, -87.0f)), power), d, values + i);
  }
}

constexpr float leak = 0.01f;  // leaky_relu, below 0

HWY_INLINE Vector activated(Activation kind, Vector x) {
  const Wide d;
  switch (kind) {
    case Activation::none:
      return x;
    case Activation::relu:
      return rectified(x);
    case Activation::elu:
      return hn::IfThenElse(hn::Gt(x, hn::Zero(d)), x, exponential_less_1(x));
    case Activation::leaky_relu:
      return hn::IfThenElse(hn::Gt(x, hn::Zero(d)), x, hn::Mul(x, hn::Set(d, leak)));
    case Activation::tanh:
      break;
  }
  // From 10 on tanh rounds to 1.
  const Vector size = hn::Abs(x), most = hn::Set(d, 10.0f);
  const Vector cut = hn::IfThenElse(hn::Gt(size, most), most, size);
  const Vector e = exponential_less_1(hn::Add(cut, cut));
  return hn::CopySign(hn::Div(e, hn::Add(e, hn::Set(d, 2.0f))), x);
}

void activate(Activation kind, float* values, std::size_t n) {
  const Wide d;
  for (std::size_t i = 0; i < n; i += lanes) {
    hn::StoreU(activated(kind, hn::LoadU(d, values + i)), d, values + i);
  }
}

// What the gradient becomes where the output was not above 0.
HWY_INLINE Vector slope_below(Activation kind, Vector y, Vector gradient) {
  const Wide d;
  if (kind == Activation::elu) return hn::MulAdd(gradient, y, gradient);
  if (kind == Activation::leaky_relu) return hn::Mul(gradient, hn::Set(d, leak));
  return hn::Zero(d);
}

void slope(Activation kind, const float* outputs, float* gradient, std::size_t n) {
  if (kind == Activation::none) return;
  const Wide d;
  const Vector one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector y = hn::LoadU(d, outputs + i), g = hn::LoadU(d, gradient + i);
    const Vector by = kind == Activation::tanh
                          ? hn::Mul(g, hn::NegMulAdd(y, y, one))
                          : hn::IfThenElse(hn::Le(y, zero), slope_below(kind, y, g), g);
    hn::StoreU(by, d, gradient + i);
  }
}

void column_sums(const float* x, std::size_t rows, std::size_t columns, std::size_t row,
                 float* sums) {
  const Wide d;
  for (std::size_t j = 0; j < columns; j += lanes) {
    Vector sum = hn::Zero(d);
    for (std::size_t i = 0; i < rows; ++i) sum = hn::Add(sum, hn::LoadU(d, x + i * row + j));
    hn::StoreU(sum, d, sums + j);
  }
}

// Blocks keep the floats' own sums short.
constexpr std::size_t summed_together = 4096;

double sum_of_squares(const float* x, std::size_t n) {
  const Wide d;
  double sum = 0.0;
  for (std::size_t begin = 0; begin < n; begin += summed_together) {
    Sixteen sums = Sixteen::zero();
    for (std::size_t i = begin; i < n && i < begin + summed_together; i += vector_width) {
      for (std::size_t v = 0; v < Sixteen::count; ++v) {
        const Vector one = hn::LoadU(d, x + i + v * lanes);
        sums.part[v] = hn::MulAdd(one, one, sums.part[v]);
      }
    }
    sum += double{sums.total()};
  }
  return sum;
}

double trace(float* z, const float* gradient, std::size_t n, float decay) {
  const Wide d;
  const Vector by = hn::Set(d, decay);
  double sum = 0.0;
  for (std::size_t begin = 0; begin < n; begin += summed_together) {
    Sixteen sums = Sixteen::zero();
    for (std::size_t i = begin; i < n && i < begin + summed_together; i += vector_width) {
      for (std::size_t v = 0; v < Sixteen::count; ++v) {
        float* const at = z + i + v * lanes;
        const Vector one = hn::MulAdd(by, hn::LoadU(d, at), hn::LoadU(d, gradient + i + v * lanes));
        hn::StoreU(one, d, at);
        sums.part[v] = hn::Add(sums.part[v], hn::Abs(one));
      }
    }
    sum += double{sums.total()};
  }
  return sum;
}

void scale(float* x, std::size_t n, float factor) {
  const Wide d;
  const Vector by = hn::Set(d, factor);
  for (std::size_t i = 0; i < n; i += lanes) {
    hn::StoreU(hn::Mul(by, hn::LoadU(d, x + i)), d, x + i);
  }
}

void blend(float* to, const float* from, std::size_t n, float share) {
  const Wide d;
  const Vector by = hn::Set(d, share);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector old = hn::LoadU(d, to + i);
    hn::StoreU(hn::MulAdd(by, hn::Sub(hn::LoadU(d, from + i), old), old), d, to + i);
  }
}

void perturb(const float* mean, const float* spread, float by, const float* factors, std::size_t n,
             float* out) {
  const Wide d;
  const Vector all = hn::Set(d, by);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector one = hn::Mul(all, hn::LoadU(d, factors + i));
    const Vector moved = hn::Mul(hn::LoadU(d, spread + i), one);
    hn::StoreU(mean == nullptr ? moved : hn::Add(hn::LoadU(d, mean + i), moved), d, out + i);
  }
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
