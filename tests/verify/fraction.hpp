#pragma once
// Exact arithmetic for the models of these tests: fractions of 128-bit integers. Their equations
// have whole coefficients below 2^5 and at most five unknowns, so that nothing grows beyond 2^30.

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace quoll::test {

class Fraction {
 public:
  using Integer = __int128;

  Fraction(Integer top = 0, Integer bottom = 1) : top_(top), bottom_(bottom) {
    Integer a = top < 0 ? -top : top;
    Integer b = bottom < 0 ? -bottom : bottom;
    while (b != 0) {
      const Integer rest = a % b;
      a = b;
      b = rest;
    }
    if (bottom < 0) a = -a;
    top_ /= a;
    bottom_ /= a;
  }

  bool operator<(const Fraction& o) const { return top_ * o.bottom_ < o.top_ * bottom_; }

  /// Whether this is at most the double, whatever its size: a fraction that is not 0 is at least
  /// 2^-30 here, which settles the smaller ones.
  bool at_most(double x) const {
    if (std::isinf(x)) return x > 0.0;
    if (std::fabs(x) < 0x1p-31) return top_ < 0 || (top_ == 0 && x >= 0.0);
    int exponent = 0;
    const double part = std::frexp(x, &exponent);  // x = part * 2^exponent
    if (exponent > 40) return x > 0.0;
    const auto mantissa = static_cast<Integer>(std::ldexp(part, 53));
    const int shift = 53 - exponent;  // x = mantissa / 2^shift
    if (shift < 0) return top_ <= mantissa * bottom_ * (Integer{1} << -shift);
    return top_ * (Integer{1} << shift) <= mantissa * bottom_;
  }
  bool at_least(double x) const { return Fraction(-top_, bottom_).at_most(-x); }

 private:
  Integer top_, bottom_;
};

/// The solution of a system of linear equations, one row of coefficients and right side each; empty
/// if there is not exactly one. Elimination without fractions (Bareiss 1968).
inline std::vector<Fraction> solved(std::vector<std::vector<Fraction::Integer>> rows) {
  const std::size_t n = rows.size();
  Fraction::Integer last = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && rows[pivot][k] == 0) ++pivot;
    if (pivot == n) return {};
    std::swap(rows[k], rows[pivot]);
    const std::vector<Fraction::Integer>& own = rows[k];
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Fraction::Integer factor = rows[i][k];
      for (std::size_t j = 0; j <= n; ++j) {
        rows[i][j] = (own[k] * rows[i][j] - factor * own[j]) / last;
      }
    }
    last = own[k];
  }
  std::vector<Fraction> answer;
  for (std::size_t k = 0; k < n; ++k) answer.emplace_back(rows[k][n], rows[k][k]);
  return answer;
}

}  // namespace quoll::test
