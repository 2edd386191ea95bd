#include <array>
#include <cmath>
#include <limits>

#include "quoll/base/double_pair.hpp"
#include "quoll/base/math.hpp"

// All are the angle of a point (x, y). Its octant is brought to 0 <= y <= x, then turned back by
// the nearest of the angles with tangent c = 0, 1/8, ..., 1:
//
//   atan (y / x) = atan c + atan t,   t = (y - c x) / (x + c y),   |t| <= 1/16,
//
// with t as a pair and the Taylor series of atan t, whose terms left out are below 2^-64 of the
// first. Below 2^-27 the angle is y / x itself.

namespace quoll::math {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double small_ratio = 0x1p-27;
constexpr Pair half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// atan (k / 8).
constexpr Pair eighths[] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

// 1/15, -1/13, ..., 1/3 with the signs of the series, from the last to the first.
constexpr auto terms = [] {
  std::array<double, 7> series{};
  for (int i = 0; i < 7; ++i) series[i] = (i % 2 == 0 ? -1.0 : 1.0) / (15 - 2 * i);
  return series;
}();

Pair minus(Pair a, Pair b) {
  const Pair difference = sum(a.high, -b.high);
  return sum(difference.high, difference.low + (a.low - b.low));
}

// The angle of a point with 0 <= y <= x and both between 2^-100 and 2^100, or y = 0.
Pair first_octant(Pair y, Pair x) {
  const double ratio = y.high / x.high;
  if (ratio < small_ratio) return {ratio, 0.0};
  const int k = static_cast<int>(8.0 * ratio + 0.5);
  const double c = 0.125 * k;

  const Pair cx = product(c, x.high), cy = product(c, y.high);
  Pair numerator = sum(y.high, -cx.high);
  numerator.low += (y.low - cx.low) - c * x.low;
  Pair denominator = sum(x.high, cy.high);
  denominator.low += (x.low + cy.low) + c * y.low;

  const double t = numerator.high / denominator.high;
  const Pair back = product(t, denominator.high);
  const double rest = ((numerator.high - back.high) - back.low) + numerator.low;
  const double t_low = (rest - t * denominator.low) / denominator.high;

  const double z = t * t;
  double series = 0.0;
  for (const double term : terms) series = (series + term) * z;
  const Pair angle = sum(eighths[k].high, t);
  return sum(angle.high, angle.low + (eighths[k].low + (t_low + t * series)));
}

Pair first_quadrant(Pair y, Pair x) {
  return y.high <= x.high ? first_octant(y, x) : minus(half_pi, first_octant(x, y));
}

double value(Pair p) {
  return p.high + p.low;
}

}  // namespace

double atan(double x) {
  const double size = std::fabs(x);
  if (!(size >= small_ratio)) return x;  // nan too
  if (size > 0x1p60) return std::copysign(half_pi.high, x);
  return std::copysign(value(first_quadrant({size, 0.0}, {1.0, 0.0})), x);
}

double asin(double x) {
  const double size = std::fabs(x);
  if (!(size <= 1.0)) return nan;
  if (size < small_ratio) return x;
  if (size == 1.0) return std::copysign(half_pi.high, x);
  // The other side of the triangle: root = sqrt (1 - x^2), once corrected.
  const Pair square = product(size, size);
  const Pair rest = sum(1.0, -square.high);
  const double root = std::sqrt(rest.high);
  const Pair back = product(root, root);
  const double missing = ((rest.high - back.high) - back.low) + (rest.low - square.low);
  return std::copysign(value(first_quadrant({size, 0.0}, {root, missing / (2.0 * root)})), x);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return nan;
  double up = std::fabs(y), across = std::fabs(x);
  if (std::isinf(up) || std::isinf(across)) {
    up = std::isinf(up) ? 1.0 : 0.0;
    across = std::isinf(across) ? 1.0 : 0.0;
  }
  const bool steep = up > across;
  const double longer = steep ? up : across, shorter = steep ? across : up;
  Pair angle{longer == 0.0 ? 0.0 : shorter / longer, 0.0};
  if (angle.high >= small_ratio) {
    const int exponent = -std::ilogb(longer);
    angle =
        first_octant({std::scalbn(shorter, exponent), 0.0}, {std::scalbn(longer, exponent), 0.0});
  }
  if (steep) angle = minus(half_pi, angle);
  if (std::signbit(x)) angle = minus(pi, angle);
  return std::copysign(value(angle), y);
}

}  // namespace quoll::math
