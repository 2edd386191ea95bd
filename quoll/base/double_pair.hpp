#pragma once
// Numbers carried as unevaluated sums high + low where one double is not enough (Dekker 1971, "A
// floating-point technique for extending the available precision", Numerische Mathematik 18).

namespace quoll::math {

/// high + low, |low| at most half an ulp of high.
struct Pair {
  double high;
  double low;
};

/// a + b exactly; Knuth's TwoSum.
inline Pair sum(double a, double b) {
  const double high = a + b;
  const double part = high - a;
  return {high, (a - (high - part)) + (b - part)};
}

/// a b exactly (Veltkamp's splitting and Dekker's product), for |a|, |b| < 2^990 and without
/// underflow.
inline Pair product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double a_scaled = splitter * a;
  const double a_head = a_scaled - (a_scaled - a);
  const double a_tail = a - a_head;
  const double b_scaled = splitter * b;
  const double b_head = b_scaled - (b_scaled - b);
  const double b_tail = b - b_head;
  const double high = a * b;
  const double low =
      ((a_head * b_head - high) + a_head * b_tail + a_tail * b_head) + a_tail * b_tail;
  return {high, low};
}

}  // namespace quoll::math
