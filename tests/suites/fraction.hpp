#pragma once
// Fractions of 128-bit whole numbers for tests, which shall need nothing to be installed. A number
// that grows too large leaves the flag `overflown` behind, and what was computed says nothing.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace quoll::test {

class Fraction {
 public:
  static inline bool overflown = false;

  Fraction(std::int64_t whole = 0) : p_(whole) {}
  Fraction(std::int64_t p, std::int64_t q) : p_(q < 0 ? -p : p), q_(q < 0 ? -q : q) { reduce(); }

  friend Fraction operator+(const Fraction& a, const Fraction& b) {
    const Wide common = gcd(a.q_, b.q_);
    return {sum(product(a.p_, b.q_ / common), product(b.p_, a.q_ / common)),
            product(a.q_, b.q_ / common), 0};
  }
  friend Fraction operator-(const Fraction& a) {
    Fraction result = a;
    result.p_ = -result.p_;
    return result;
  }
  friend Fraction operator-(const Fraction& a, const Fraction& b) { return a + -b; }
  friend Fraction operator*(const Fraction& a, const Fraction& b) {
    const Wide left = std::max<Wide>(gcd(a.p_, b.q_), 1),
               right = std::max<Wide>(gcd(b.p_, a.q_), 1);
    return {product(a.p_ / left, b.p_ / right), product(a.q_ / right, b.q_ / left), 0};
  }
  friend Fraction operator/(const Fraction& a, const Fraction& b) {
    Fraction turned;
    turned.p_ = b.p_ < 0 ? -b.q_ : b.q_;
    turned.q_ = b.p_ < 0 ? -b.p_ : b.p_;
    return a * turned;
  }
  friend bool operator<(const Fraction& a, const Fraction& b) { return (a - b).p_ < 0; }
  friend bool operator==(const Fraction& a, const Fraction& b) {
    return a.p_ == b.p_ && a.q_ == b.q_;
  }

  int sign() const { return p_ < 0 ? -1 : p_ > 0 ? 1 : 0; }
  /// The largest double that is not above.
  double below() const { return p_ < 0 ? -outward(-p_, q_) : inward(p_, q_); }
  /// The smallest double that is not below.
  double above() const { return p_ < 0 ? -inward(-p_, q_) : outward(p_, q_); }

 private:
  using Wide = __int128;

  Fraction(Wide p, Wide q, int) : p_(p), q_(q) { reduce(); }

  static int bits(Wide x) {
    const auto size = static_cast<unsigned __int128>(x < 0 ? -x : x);
    const auto high = static_cast<std::uint64_t>(size >> 64);
    const auto low = static_cast<std::uint64_t>(size);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
  }
  static Wide gcd(Wide a, Wide b) {
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b != 0) {
      const bool small = bits(a) <= 64;
      const Wide rest =
          small ? static_cast<Wide>(static_cast<std::uint64_t>(a) % static_cast<std::uint64_t>(b))
                : a % b;
      a = b;
      b = rest;
      if (small && bits(b) > 64) break;  // cannot happen
    }
    return a;
  }
  static Wide product(Wide a, Wide b) {
    if (bits(a) + bits(b) <= 124) return a * b;
    overflown = true;
    return 1;
  }
  static Wide sum(Wide a, Wide b) {
    if (bits(a) <= 125 && bits(b) <= 125) return a + b;
    overflown = true;
    return 1;
  }
  void reduce() {
    const Wide common = gcd(p_, q_);
    if (common <= 1) return;
    p_ /= common;
    q_ /= common;
  }

  // p / q with 53 bits, the rest cut off; `exact` = there was no rest. p >= 0.
  static double cut(Wide p, Wide q, bool& exact) {
    Wide whole = p / q, rest = p % q;
    int exponent = 0;
    for (; bits(whole) > 53; whole /= 2, ++exponent) exact = exact && whole % 2 == 0;
    exact = exact && (exponent == 0 || rest == 0);
    if (exponent == 0) {
      for (; rest != 0 && bits(whole) < 53; --exponent) {
        rest *= 2;
        whole = 2 * whole + rest / q;
        rest %= q;
      }
      exact = rest == 0;
    }
    return std::ldexp(static_cast<double>(whole), exponent);
  }
  static double inward(Wide p, Wide q) {
    bool exact = true;
    return cut(p, q, exact);
  }
  static double outward(Wide p, Wide q) {
    bool exact = true;
    const double size = cut(p, q, exact);
    return exact ? size : std::nextafter(size, HUGE_VAL);
  }

  Wide p_ = 0, q_ = 1;
};

}  // namespace quoll::test
