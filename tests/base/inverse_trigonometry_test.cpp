#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "quoll/base/math.hpp"
#include "quoll/base/random.hpp"
#include "tests/base/ulps.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double pi = 3.141592653589793;

class InverseTrigonometry : public UlpsTest {
 protected:
  void TearDown() override { RecordProperty("worst", std::to_string(static_cast<double>(worst))); }
  void note(double found, long double expected) {
    worst = std::max(worst, error_in_ulps(found, expected));
  }
  long double worst = 0;
};

double any(Rng& rng) {
  while (true) {
    const double x = std::bit_cast<double>(rng.next());
    if (std::isfinite(x)) return x;
  }
}

TEST_F(InverseTrigonometry, TanIsWithinTwoUlps) {
  Rng rng = stream(1, "tan");
  const auto check = [&](double x) { note(math::tan(x), tanl(x)); };
  for (int i = 0; i < 600'000; ++i) check((rng.uniform() - 0.5) * 8);
  for (int i = 0; i < 300'000; ++i) check((rng.uniform() - 0.5) * 0x1p21);
  for (int i = 0; i < 100'000; ++i) check(1e-6 * (rng.uniform() - 0.5));
  for (int k = -2000; k <= 2000; ++k) {  // where quadrants meet, and the poles
    const double x = k * (pi / 4);
    for (const double y : {x, std::nextafter(x, 1e9), std::nextafter(x, -1e9)}) check(y);
  }
  EXPECT_LT(worst, 2);
  EXPECT_GT(worst, 0.4);
}

// Next to the multiples of pi/2, where most digits of the reduced angle come from far down in pi.
TEST_F(InverseTrigonometry, NothingIsLostNearZerosAndPoles) {
  for (int k = 1; k < 667'000; k += k < 1000 ? 1 : 7) {
    const auto x = static_cast<double>(static_cast<long double>(k) * 1.5707963267948966192313L);
    for (const double y : {x, std::nextafter(x, 1e9), std::nextafter(x, 0.0)}) {
      note(math::tan(y), tanl(y));
      note(math::sin(y), sinl(y));
      note(math::cos(y), cosl(y));
    }
  }
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);
}

TEST_F(InverseTrigonometry, AtanIsWithinOneUlp) {
  Rng rng = stream(2, "atan");
  const auto check = [&](double x) { note(math::atan(x), atanl(x)); };
  for (int i = 0; i < 600'000; ++i) check((rng.uniform() - 0.5) * 4);
  for (int i = 0; i < 300'000; ++i) check((rng.uniform() - 0.5) * 200);
  for (int i = 0; i < 300'000; ++i) check(any(rng));
  for (int k = -160; k <= 160; ++k) {  // where the nearest angle changes
    for (const double x : {k / 16.0, 16.0 / k}) {
      for (const double y : {x, std::nextafter(x, 1e9), std::nextafter(x, -1e9)}) check(y);
    }
  }
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);
}

TEST_F(InverseTrigonometry, AsinIsWithinOneUlp) {
  Rng rng = stream(3, "asin");
  const auto check = [&](double x) { note(math::asin(x), asinl(x)); };
  for (int i = 0; i < 600'000; ++i) check(2 * rng.uniform() - 1);
  for (int i = 0; i < 200'000; ++i) check(1 - 1e-3 * rng.uniform() * rng.uniform());
  for (int i = 0; i < 200'000; ++i) check(1e-6 * (rng.uniform() - 0.5));
  for (int i = 1; i < 1000; ++i) check(1 - i * 0x1p-53);
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);
}

TEST_F(InverseTrigonometry, Atan2IsWithinOneUlp) {
  Rng rng = stream(4, "atan2");
  const auto check = [&](double y, double x) { note(math::atan2(y, x), atan2l(y, x)); };
  for (int i = 0; i < 600'000; ++i) {
    const double y = 2 * rng.uniform() - 1, x = 2 * rng.uniform() - 1;
    check(y, x);
    check(y * 1e-7, x);
    check(y, x * 1e-7);
  }
  for (int i = 0; i < 300'000; ++i) {
    const double y = any(rng), x = any(rng);
    check(y, x);
  }
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);
}

TEST(InverseTrigonometryEdges, AsInC) {
  EXPECT_EQ(math::atan(infinity), pi / 2);
  EXPECT_EQ(math::atan(-largest), -pi / 2);
  EXPECT_EQ(math::atan(smallest), smallest);
  EXPECT_EQ(math::atan(1), pi / 4);
  EXPECT_TRUE(std::isnan(math::atan(nan)));
  EXPECT_EQ(math::asin(1), pi / 2);
  EXPECT_EQ(math::asin(-1), -pi / 2);
  EXPECT_TRUE(std::isnan(math::asin(std::nextafter(1.0, 2.0))));
  EXPECT_TRUE(std::isnan(math::asin(nan)));
  EXPECT_TRUE(std::isnan(math::tan(infinity)));
  EXPECT_EQ(math::tan(0.0), 0.0);
  for (const double zero : {0.0, -0.0}) {
    EXPECT_TRUE(std::signbit(math::atan(zero)) == std::signbit(zero));
    EXPECT_TRUE(std::signbit(math::asin(zero)) == std::signbit(zero));
    EXPECT_TRUE(std::signbit(math::tan(zero)) == std::signbit(zero));
  }
  for (const double y : {0.0, -0.0, 1.0, -1.0, smallest, largest, infinity, -infinity, nan}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, smallest, largest, infinity, -infinity, nan}) {
      const double found = math::atan2(y, x), expected = static_cast<double>(atan2l(y, x));
      EXPECT_EQ(std::isnan(found), std::isnan(expected)) << y << " " << x;
      if (std::isnan(found)) continue;
      EXPECT_EQ(found, expected) << y << " " << x;
      EXPECT_EQ(std::signbit(found), std::signbit(expected)) << y << " " << x;
    }
  }
}

// The same bits on every machine: a sum of the bit patterns, fixed when the functions were written.
TEST(InverseTrigonometryBits, StayTheSame) {
  Rng rng = stream(5, "bits");
  std::uint64_t sum = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::tan(100 * (x - 0.5))));
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::atan(10 * (x - 0.5))));
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::asin(2 * x - 1)));
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::atan2(y - 0.5, x - 0.5)));
  }
  EXPECT_EQ(sum, 792003016074952702u);
}

}  // namespace
}  // namespace quoll
