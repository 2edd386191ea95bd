#pragma once
// Sums and products rounded outward, so that bounds stay true and exact results stay exact. The
// error of one operation is found with error-free transforms: TwoSum (Knuth, TAOCP 2, 4.2.2) and
// TwoProduct by splitting (Dekker 1971). Only + - * /; no change of the rounding mode, no fused
// multiply-add.

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace quoll {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double half_ulp = 0x1p-53;  ///< largest relative error of one operation

/// The next double above x; infinity stays.
inline double next_up(double x) {
  if (x == 0.0) return std::numeric_limits<double>::denorm_min();
  if (!(x < infinity)) return x;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(x > 0.0 ? bits + 1 : bits - 1);
}
inline double next_down(double x) {
  return -next_up(-x);
}

/// Exact a + b - sum for sum = fl(a + b); not a number if sum overflowed.
inline double sum_error(double a, double b, double sum) {
  const double b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part);
}

/// Exact a * b - product for product = fl(a * b) when nothing over- or underflows.
inline double product_error(double a, double b, double product) {
  constexpr double splitter = 0x1p27 + 1.0;
  const double ca = splitter * a;
  const double a_high = ca - (ca - a);
  const double a_low = a - a_high;
  const double cb = splitter * b;
  const double b_high = cb - (cb - b);
  const double b_low = b - b_high;
  return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

/// An upper bound on a + b. Infinite operands stay what they are; -infinity wins over +infinity.
inline double add_up(double a, double b) {
  const double sum = a + b;
  if (std::isinf(a) || std::isinf(b)) return sum != sum ? -infinity : sum;
  return sum_error(a, b, sum) <= 0.0 ? sum : next_up(sum);
}
inline double add_down(double a, double b) {
  return -add_up(-a, -b);
}

/// An upper bound on a * b, for |a| <= 1.
inline double scale_up(double a, double b) {
  if (a == 1.0 || b == 0.0 || std::isinf(b)) return a == 0.0 ? 0.0 : a * b;
  const double product = a * b;
  const double size = std::fabs(b);
  if (!(std::fabs(product) > 1e-280) || !(size < 1e290)) return next_up(product);
  return product_error(a, b, product) <= 0.0 ? product : next_up(product);
}
inline double scale_down(double a, double b) {
  return -scale_up(a, -b);
}

/// Whether a double is meant exactly: it has at most 32 significant bits, as integers and short
/// binary fractions do. Others, like 0.1 or 1/3, stand for any number that rounds to them.
inline bool meant_exactly(double x) {
  return (std::bit_cast<std::uint64_t>(x) & ((std::uint64_t{1} << 21) - 1)) == 0;
}

/// The numbers a stored one may stand for.
struct Meant {
  double lower;
  double upper;

  explicit Meant(double x)
      : lower(meant_exactly(x) ? x : next_down(x)), upper(meant_exactly(x) ? x : next_up(x)) {}
};

/// A discount in (0, 1] as the numbers it may stand for; below 1 stays below 1.
struct Discount : Meant {
  explicit Discount(double discount) : Meant(discount), value(discount) {
    if (discount < 1.0 && upper >= 1.0) upper = discount;
  }
  double value;
  bool none() const { return value == 1.0; }
};

/// Bounds on reward + discount * value.
inline double backup_up(double reward, const Discount& discount, double value) {
  const double tail = scale_up(value >= 0.0 ? discount.upper : discount.lower, value);
  return add_up(Meant(reward).upper, tail);
}
inline double backup_down(double reward, const Discount& discount, double value) {
  const double tail = scale_down(value >= 0.0 ? discount.lower : discount.upper, value);
  return add_down(Meant(reward).lower, tail);
}

}  // namespace quoll
