#pragma once
// What the tests of functions on doubles measure with: the C library's long double functions, 64
// bits of precision, error below 2 of their own ulps, that is below 0.001 ulp of a double. Where
// long double is double the bounds cannot be tested.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quoll {

/// The distance between neighbouring doubles at `value`.
inline long double ulp(long double value) {
  const long double size = fabsl(value);
  if (size < 0x1p-1022L) return 0x1p-1074L;
  return scalbnl(1.0L, ilogbl(size) - 52);
}

/// 0 for an infinite value where the exact one is no double's.
inline long double error_in_ulps(double found, long double expected) {
  constexpr auto largest = static_cast<long double>(std::numeric_limits<double>::max());
  if (fabsl(expected) > largest && std::isinf(found)) return 0;
  return fabsl(found - expected) / ulp(expected);
}

/// Tests against long double, skipped where it is no wider.
class UlpsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "no wider reference";
  }
};

}  // namespace quoll
