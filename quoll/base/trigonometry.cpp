#include <array>
#include <cmath>
#include <limits>

#include "quoll/base/double_pair.hpp"
#include "quoll/base/math.hpp"

// x = k pi/2 + r, |r| <= pi/4, with pi/2 in parts (Cody, Waite 1980, "Software Manual for the
// Elementary Functions", ch. 8): two heads of 33 bits, whose products with k below 2^20 are exact,
// and a tail of two doubles, since r can be as small as 2^-60. r is carried as high + low; then the
// Taylor series, whose terms left out are below 2^-60 of the first.
//
//   sin (h + l) = sin h + l cos h,   cos (h + l) = cos h - l sin h

namespace quoll::math {
namespace {

constexpr double half_pi_head = 0x1.921fb544p+0;
constexpr double half_pi_middle = 0x1.0b4611a6p-34;
constexpr double half_pi_tail = 0x1.3198a2e037073p-69;
constexpr double half_pi_rest = 0x1.129024e088a68p-123;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double two_pi = 0x1.921fb54442d18p+2;
constexpr double exact_below = 0x1p20;

// (-1)^k / (2k + 1)! or (-1)^k / (2k)!, from the last to the first.
template <int first, int count>
constexpr auto series() {
  std::array<double, count> terms{};
  double factorial = 1.0, sign = 1.0;
  for (int k = 0, n = 1; k < count; ++k) {
    for (; n <= first + 2 * k; ++n) factorial *= n;
    terms[static_cast<std::size_t>(count - 1 - k)] = sign / factorial;
    sign = -sign;
  }
  return terms;
}
constexpr auto sine_terms = series<3, 8>();    // 1/3!, -1/5!, ..., -1/17!
constexpr auto cosine_terms = series<4, 7>();  // 1/4!, -1/6!, ..., 1/16!

struct Reduced {
  double high, low;
  unsigned quadrant;
};

Reduced reduce(double x) {
  // Beyond the exact range: first into (-2 pi, 2 pi), with the error of two_pi times the turns.
  if (std::fabs(x) > exact_below) x = std::fmod(x, two_pi);
  const double k = std::floor(x * two_over_pi + 0.5);
  if (k == 0.0) return {x, 0.0, 0};
  const Pair head = sum(x - k * half_pi_head, -(k * half_pi_middle));
  const Pair tail = product(k, half_pi_tail);
  const Pair close = sum(head.high, -tail.high);
  const Pair r = sum(close.high, close.low + ((head.low - tail.low) - k * half_pi_rest));
  return {r.high, r.low, static_cast<unsigned>(static_cast<long long>(k)) & 3u};
}

// Of the reduced angle, as high + low.
Pair sine(const Reduced& r) {
  const double z = r.high * r.high;
  double sum = 0.0;
  for (const double term : sine_terms) sum = sum * z + term;
  const double cubed = z * r.high;
  return {r.high, r.low * (1.0 - 0.5 * z) - cubed * sum};
}

Pair cosine(const Reduced& r) {
  const double z = r.high * r.high;
  double sum = 0.0;
  for (const double term : cosine_terms) sum = sum * z + term;
  const double half = 0.5 * z, one = 1.0 - half;
  return {one, ((1.0 - one) - half) + (z * z * sum - r.high * r.low)};
}

double value(Pair p) {
  return p.high + p.low;
}

double ratio(Pair a, Pair b) {
  a = sum(a.high, a.low);
  b = sum(b.high, b.low);
  const double q = a.high / b.high;
  const Pair back = product(q, b.high);
  return q + (((a.high - back.high) - back.low) + (a.low - q * b.low)) / b.high;
}

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return x;
  const Reduced r = reduce(x);
  const double size = value((r.quadrant & 1u) ? cosine(r) : sine(r));
  return (r.quadrant & 2u) ? -size : size;
}

double cos(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce(x);
  const double size = value((r.quadrant & 1u) ? sine(r) : cosine(r));
  return r.quadrant == 1u || r.quadrant == 2u ? -size : size;
}

double tan(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  if (std::fabs(x) < 0x1p-27) return x;
  const Reduced r = reduce(x);
  return (r.quadrant & 1u) ? -ratio(cosine(r), sine(r)) : ratio(sine(r), cosine(r));
}

}  // namespace quoll::math
