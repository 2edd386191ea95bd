#include "quoll/base/math.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "quoll/base/double_pair.hpp"

// The numbers are carried as pairs high + low where one double is not enough.
//
//   log x = k ln 2 + log m,  x = 2^k m,  m in [sqrt(1/2), sqrt 2)
//   log m = 2 atanh s = 2 s + s (2/3 s^2 + 2/5 s^4 + ...),  s = (m - 1) / (m + 1),  s^2 < 0.0295
//   e^x   = 2^k e^r,  k = round(x / ln 2),  |r| < 0.3467,  e^r by its Taylor series
//   x^y   = e^(y log x), the product of the two pairs
//
// ln 2 is cut into a head of 32 bits, so that k ln2_head is exact, and a tail.

namespace quoll::math {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ln2_head = 0x1.62e42feep-1;
constexpr double ln2_tail = 0x1.a39ef35793c76p-33;
constexpr double inverse_ln2 = 0x1.71547652b82fep+0;

/// 2/25, 2/23, ..., 2/3: the terms left out are below 2^-64 of the first.
constexpr auto log_terms = [] {
  std::array<double, 12> terms{};
  for (int i = 0; i < 12; ++i) terms[i] = 2.0 / (25 - 2 * i);
  return terms;
}();

/// 1/14!, 1/13!, ..., 1/2!, each rounded once since 14! is a double; what is left out is below
/// 2^-60.
constexpr auto exp_terms = [] {
  std::array<double, 13> terms{};
  double factorial = 1;
  for (int n = 2; n <= 14; ++n) {
    factorial *= n;
    terms[14 - n] = 1 / factorial;
  }
  return terms;
}();

/// 2^k for -1022 <= k <= 1023.
double power_of_two(int k) {
  return std::bit_cast<double>(std::uint64_t(1023 + k) << 52);
}

/// log x for finite x > 0, relative error below 2^-58.
Pair log_pair(double x) {
  int k = 0;
  if (x < 0x1p-1022) {  // subnormal: give it a normal exponent first
    x *= 0x1p54;
    k = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (m >= 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    k += 1;
  }

  const double numerator = m - 1;  // exact
  const Pair denominator = sum(m, 1);
  const double s = numerator / denominator.high;
  const Pair back = product(s, denominator.high);
  const double s_low =
      (((numerator - back.high) - back.low) - s * denominator.low) / denominator.high;

  const double z = s * s;
  double series = 0;
  for (const double term : log_terms) series = (series + term) * z;

  const Pair total = sum(k * ln2_head, 2 * s);
  const double low = total.low + (k * ln2_tail + (2 * s_low + s * series));
  return sum(total.high, low);
}

/// e^(high + low), for |high| < 1000.
double exp_pair(Pair x) {
  const double quotient = x.high * inverse_ln2;
  const int k = static_cast<int>(quotient < 0 ? quotient - 0.5 : quotient + 0.5);
  const double head = x.high - k * ln2_head;  // exact
  const Pair r = sum(head, x.low - k * ln2_tail);

  double series = 0;
  for (const double term : exp_terms) series = series * r.high + term;
  series *= r.high * r.high;
  const Pair start = sum(1, r.high);
  const double value = start.high + (start.low + (r.low + series));
  // Two steps, since 2^k itself may lie outside a double; only the last one can round.
  const int half = k / 2;
  return value * power_of_two(half) * power_of_two(k - half);
}

}  // namespace

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.79) return infinity;
  if (x < -745.2) return 0;
  return exp_pair({x, 0});
}

double log(double x) {
  if (std::isnan(x) || x < 0) return nan;
  if (x == 0) return -infinity;
  if (x == infinity) return infinity;
  return log_pair(x).high;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y) || x < 0) return nan;
  if (x == 0 || x == infinity) return (x == 0) == (y > 0) ? 0 : infinity;
  // |log x| is at least 2^-53 beside 1, so that such exponents lead out of every range.
  if (std::fabs(y) > 0x1p70) return (x > 1) == (y > 0) ? infinity : 0;
  const Pair logarithm = log_pair(x);
  const Pair raised = product(y, logarithm.high);
  const Pair exponent = sum(raised.high, raised.low + y * logarithm.low);
  if (exponent.high > 709.79) return infinity;
  if (exponent.high < -745.2) return 0;
  return exp_pair(exponent);
}

}  // namespace quoll::math
