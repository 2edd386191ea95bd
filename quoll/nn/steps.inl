// One step of each optimiser over flat arrays, for arithmetic.cpp, once for each instruction set.

#if defined(QUOLL_NN_STEPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_STEPS_INL
#undef QUOLL_NN_STEPS_INL
#else
#define QUOLL_NN_STEPS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/product.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

void sgd(float* x, const float* gradient, std::size_t n, float step) {
  const Wide d;
  const Vector by = hn::Set(d, step);
  for (std::size_t i = 0; i < n; i += lanes) {
    hn::StoreU(hn::NegMulAdd(by, hn::LoadU(d, gradient + i), hn::LoadU(d, x + i)), d, x + i);
  }
}

// Means nearer to 0 than this are 0. What is learned does not tell them apart, but where gradients
// have stopped they would halve and halve until they are denormal numbers, which take processors
// many times as long.
constexpr float least_mean = 1e-18F, least_square = least_mean * least_mean;

// The running mean `old` of something, with `share` of its new value.
HWY_INLINE Vector running(Vector old, Vector value, Vector share, float least) {
  const Vector mean = hn::MulAdd(share, hn::Sub(value, old), old);
  return hn::IfThenElseZero(hn::Ge(hn::Abs(mean), hn::Set(Wide(), least)), mean);
}

void adam(float* x, const float* gradient, float* mean, float* square, std::size_t n,
          const AdamStep& how) {
  const Wide d;
  const Vector new1 = hn::Set(d, how.share1), new2 = hn::Set(d, how.share2);
  const Vector step = hn::Set(d, how.step), root_scale = hn::Set(d, how.root_scale);
  const Vector epsilon = hn::Set(d, how.epsilon);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector g = hn::LoadU(d, gradient + i);
    const Vector m = running(hn::LoadU(d, mean + i), g, new1, least_mean);
    const Vector v = running(hn::LoadU(d, square + i), hn::Mul(g, g), new2, least_square);
    hn::StoreU(m, d, mean + i);
    hn::StoreU(v, d, square + i);
    const Vector below = hn::MulAdd(hn::Sqrt(v), root_scale, epsilon);
    hn::StoreU(hn::NegMulAdd(step, hn::Div(m, below), hn::LoadU(d, x + i)), d, x + i);
  }
}

void rmsprop(float* x, const float* gradient, float* mean, float* square, std::size_t n,
             const RmsStep& how) {
  const Wide d;
  const Vector share = hn::Set(d, how.share), step = hn::Set(d, how.step);
  const Vector epsilon = hn::Set(d, how.epsilon);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector g = hn::LoadU(d, gradient + i);
    Vector v = running(hn::LoadU(d, square + i), hn::Mul(g, g), share, least_square);
    hn::StoreU(v, d, square + i);
    if (how.centred) {
      const Vector m = running(hn::LoadU(d, mean + i), g, share, least_mean);
      hn::StoreU(m, d, mean + i);
      // Rounding may take the variance below 0.
      v = hn::Max(hn::NegMulAdd(m, m, v), hn::Zero(d));
    }
    const Vector below = hn::Add(hn::Sqrt(v), epsilon);
    hn::StoreU(hn::NegMulAdd(step, hn::Div(g, below), hn::LoadU(d, x + i)), d, x + i);
  }
}

void rprop(float* x, const float* gradient, float* before, float* steps, std::size_t n,
           const RpropStep& how) {
  const Wide d;
  const Vector zero = hn::Zero(d);
  const Vector up = hn::Set(d, how.up), down = hn::Set(d, how.down);
  const Vector largest = hn::Set(d, how.largest), smallest = hn::Set(d, how.smallest);
  for (std::size_t i = 0; i < n; i += lanes) {
    const Vector g = hn::LoadU(d, gradient + i);
    // Signs, not values, so that small gradients do not vanish in the product.
    const Vector old = hn::LoadU(d, before + i);
    const auto same = hn::Or(hn::And(hn::Gt(g, zero), hn::Gt(old, zero)),
                             hn::And(hn::Lt(g, zero), hn::Lt(old, zero)));
    const auto turned = hn::Or(hn::And(hn::Gt(g, zero), hn::Lt(old, zero)),
                               hn::And(hn::Lt(g, zero), hn::Gt(old, zero)));
    Vector step = hn::LoadU(d, steps + i);
    step = hn::IfThenElse(same, hn::Min(hn::Mul(step, up), largest), step);
    step = hn::IfThenElse(turned, hn::Max(hn::Mul(step, down), smallest), step);
    hn::StoreU(step, d, steps + i);
    const Vector used = hn::IfThenZeroElse(turned, g);
    hn::StoreU(used, d, before + i);
    const Vector moved = hn::IfThenElse(hn::Gt(used, zero), step,
                                        hn::IfThenElse(hn::Lt(used, zero), hn::Neg(step), zero));
    hn::StoreU(hn::Sub(hn::LoadU(d, x + i), moved), d, x + i);
  }
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
