#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "quoll/base/math.hpp"
#include "quoll/base/random.hpp"
#include "tests/base/ulps.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double pi = std::numbers::pi;

/// The largest errors of both functions over what `draw` gives.
template <class Draw>
std::pair<long double, long double> worst(int count, Draw draw) {
  long double sine = 0, cosine = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw(i);
    sine = std::max(sine, error_in_ulps(math::sin(x), sinl(x)));
    cosine = std::max(cosine, error_in_ulps(math::cos(x), cosl(x)));
  }
  return {sine, cosine};
}

class TrigonometryTest : public UlpsTest {};

TEST_F(TrigonometryTest, IsWithinOneUlp) {
  Rng rng = stream(1, "angle");
  const auto [sine, cosine] = worst(600'000, [&](int) { return (rng.uniform() - 0.5) * 0x1p21; });
  EXPECT_LT(sine, 1);
  EXPECT_LT(cosine, 1);
  EXPECT_GT(std::max(sine, cosine), 0.5);  // a measurement that nothing comes near would be broken
  const auto [near_sine, near_cosine] =
      worst(600'000, [&](int) { return (rng.uniform() - 0.5) * 16; });
  EXPECT_LT(near_sine, 1);
  EXPECT_LT(near_cosine, 1);
}

TEST_F(TrigonometryTest, SmallAnglesKeepTheirBits) {
  Rng rng = stream(2, "angle");
  const auto [sine, cosine] =
      worst(200'000, [&](int i) { return std::ldexp(rng.uniform() + 0.5, -(i % 1070)); });
  EXPECT_LT(sine, 1);
  EXPECT_LT(cosine, 1);
}

// Where the reduction changes quadrant, and where a result is nearly 0.
TEST_F(TrigonometryTest, NearMultiplesOfAQuarterTurn) {
  const auto [sine, cosine] = worst(400'000, [](int i) {
    const double x = (i / 4 - 50'000) * (pi / 4);
    return i % 4 == 0   ? x
           : i % 4 == 1 ? std::nextafter(x, infinity)
           : i % 4 == 2 ? std::nextafter(x, -infinity)
                        : x + 1e-9;
  });
  EXPECT_LT(sine, 1);
  EXPECT_LT(cosine, 1);
}

// Beyond 2^20 the angle is taken modulo the double nearest 2 pi, 2.4e-16 below it: the error grows
// with the turns, and no further.
TEST_F(TrigonometryTest, LargeAnglesLoseWhatIsSaid) {
  Rng rng = stream(3, "angle");
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::ldexp(rng.uniform() + 1.0, 20 + i % 30);
    const double turns = x / (2 * pi);
    EXPECT_NEAR(math::sin(x), static_cast<double>(sinl(x)), 2.5e-16 * (turns + 4));
    EXPECT_NEAR(math::cos(x), static_cast<double>(cosl(x)), 2.5e-16 * (turns + 4));
  }
  EXPECT_LE(std::fabs(math::sin(1e300)), 1.0);
}

TEST(Trigonometry, ExactCases) {
  EXPECT_EQ(math::sin(0.0), 0.0);
  EXPECT_FALSE(std::signbit(math::sin(0.0)));
  EXPECT_TRUE(std::signbit(math::sin(-0.0)));
  EXPECT_EQ(math::cos(0.0), 1.0);
  EXPECT_EQ(math::cos(-0.0), 1.0);
  EXPECT_EQ(math::sin(smallest), smallest);
  EXPECT_EQ(math::cos(smallest), 1.0);
  EXPECT_EQ(math::sin(1e-9), 1e-9);
  EXPECT_EQ(math::cos(1e-9), 1.0);
  // The double nearest pi/2 is 6.1232339957367658e-17 below it, that nearest pi twice as much.
  EXPECT_EQ(math::sin(pi / 2), 1.0);
  EXPECT_EQ(math::cos(pi / 2), 6.123233995736766e-17);
  EXPECT_EQ(math::sin(pi), 1.2246467991473532e-16);
  EXPECT_EQ(math::cos(pi), -1.0);
  EXPECT_DOUBLE_EQ(math::sin(pi / 6), 0.5);
  EXPECT_DOUBLE_EQ(math::cos(pi / 3), 0.5);
  EXPECT_DOUBLE_EQ(math::sin(1.0), 0.8414709848078965);
  EXPECT_DOUBLE_EQ(math::cos(1.0), 0.5403023058681398);
  for (const double x : {nan, infinity, -infinity}) {
    EXPECT_TRUE(std::isnan(math::sin(x)));
    EXPECT_TRUE(std::isnan(math::cos(x)));
  }
}

TEST(Trigonometry, IsOddAndEven) {
  Rng rng = stream(4, "angle");
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::ldexp(rng.uniform(), i % 40);
    EXPECT_EQ(math::sin(-x), -math::sin(x));
    EXPECT_EQ(math::cos(-x), math::cos(x));
    EXPECT_NEAR(math::sin(x) * math::sin(x) + math::cos(x) * math::cos(x), 1.0, 4e-16);
  }
}

}  // namespace
}  // namespace quoll
