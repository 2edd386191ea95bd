#include "quoll/base/math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "quoll/base/random.hpp"
#include "tests/base/ulps.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

class MathTest : public UlpsTest {};

/// A double with uniformly random bits, positive and finite: every exponent is equally likely.
double any_positive(Rng& rng) {
  while (true) {
    const double value = std::bit_cast<double>(rng.next() >> 1);
    if (std::isfinite(value) && value > 0) return value;
  }
}

TEST_F(MathTest, ExpIsWithinOneUlp) {
  Rng rng = stream(1, "exp");
  long double worst = 0;
  const auto check = [&](double x) {
    worst = std::max(worst, error_in_ulps(math::exp(x), expl(x)));
  };
  for (int i = 0; i < 600'000; ++i) check((rng.uniform() - 0.5) * 1500);
  for (int i = 0; i < 300'000; ++i) check((rng.uniform() - 0.5) * 4);
  for (int i = 0; i < 100'000; ++i) check(-708 - 37 * rng.uniform());  // subnormal results
  for (int i = 0; i < 100'000; ++i) {
    const double size = any_positive(rng);
    if (size < 700) check(i % 2 == 0 ? size : -size);
  }
  // Multiples of ln 2 / 2, where the reduction changes from one k to the next.
  for (int k = -2140; k <= 2040; ++k) {
    const double x = k * 0.34657359027997264;
    for (const double y : {x, std::nextafter(x, 1e9), std::nextafter(x, -1e9)}) check(y);
  }
  RecordProperty("worst", std::to_string(static_cast<double>(worst)));
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);  // a bound that nothing comes near would show a broken measurement
}

TEST_F(MathTest, LogIsWithinOneUlp) {
  Rng rng = stream(2, "log");
  long double worst = 0;
  const auto check = [&](double x) {
    worst = std::max(worst, error_in_ulps(math::log(x), logl(x)));
  };
  for (int i = 0; i < 500'000; ++i) check(any_positive(rng));
  for (int i = 0; i < 300'000; ++i) check(0.5 + 1.5 * rng.uniform());
  for (int i = 0; i < 100'000; ++i) check(smallest * (1 + rng.below(1'000'000)));
  for (int i = 0; i < 100'000; ++i) check(1 + (rng.uniform() - 0.5) * 1e-9);
  for (int n = 1; n < 100'000; ++n) check(n);
  for (const double x : {smallest, 0x1p-1022, std::nextafter(0x1p-1022, 0.0), largest,
                         std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0), std::sqrt(2.0),
                         std::nextafter(std::sqrt(2.0), 0.0), std::sqrt(0.5)}) {
    check(x);
  }
  RecordProperty("worst", std::to_string(static_cast<double>(worst)));
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.4);
}

TEST_F(MathTest, PowKeepsItsBound) {
  Rng rng = stream(3, "pow");
  long double worst = 0;  // as a share of the promised bound
  long double in_ulps = 0;
  const auto check = [&](double x, double y) {
    const long double expected = powl(x, y);
    const double found = math::pow(x, y);
    const long double bound = 2 + fabsl(y * logl(x));  // ulps; an ulp is at most 2^-52 of the value
    const long double error = error_in_ulps(found, expected);
    in_ulps = std::max(in_ulps, error);
    worst = std::max(worst, error / bound);
  };
  for (int i = 0; i < 500'000; ++i) {
    const double x = any_positive(rng);
    const double range = 745 / std::fabs(std::log(x));
    check(x, (2 * rng.uniform() - 1) * range);
  }
  for (int i = 0; i < 300'000; ++i) {
    const double x = 3 * rng.uniform();
    if (x > 0) check(x, 20 * rng.uniform() - 10);
  }
  // 1/N^w, the step sizes; and discounts to large powers.
  for (int i = 0; i < 100'000; ++i) {
    const double visits = 1 + rng.below(1'000'000);
    check(visits, -rng.uniform());
    const double discount = 1 - 1e-6 * rng.uniform();
    check(discount, rng.below(100'000'000));
  }
  RecordProperty("worst_share", std::to_string(static_cast<double>(worst)));
  RecordProperty("worst_ulps", std::to_string(static_cast<double>(in_ulps)));
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.1);
}

TEST(MathEdges, Exp) {
  EXPECT_EQ(math::exp(0), 1);
  EXPECT_EQ(math::exp(-0.0), 1);
  EXPECT_EQ(math::exp(smallest), 1);
  EXPECT_EQ(math::exp(infinity), infinity);
  EXPECT_EQ(math::exp(-infinity), 0);
  EXPECT_TRUE(std::isnan(math::exp(nan)));
  EXPECT_EQ(math::exp(709.8), infinity);
  EXPECT_EQ(math::exp(largest), infinity);
  // ln(largest double) = 709.782712893383973096...; its neighbours on both sides.
  EXPECT_LT(math::exp(709.782712893383), infinity);
  EXPECT_EQ(math::exp(709.782712893385), infinity);
  // ln(2^-1075) = -745.1332191019411...: half of the smallest double.
  EXPECT_EQ(math::exp(-745.13), smallest);
  EXPECT_EQ(math::exp(-745.14), 0);
  EXPECT_EQ(math::exp(-746), 0);
  EXPECT_EQ(math::exp(-largest), 0);
}

TEST(MathEdges, Log) {
  EXPECT_EQ(math::log(1), 0);
  EXPECT_EQ(math::log(0), -infinity);
  EXPECT_EQ(math::log(-0.0), -infinity);
  EXPECT_EQ(math::log(infinity), infinity);
  EXPECT_TRUE(std::isnan(math::log(-1)));
  EXPECT_TRUE(std::isnan(math::log(-infinity)));
  EXPECT_TRUE(std::isnan(math::log(nan)));
}

TEST(MathEdges, Pow) {
  EXPECT_EQ(math::pow(0, 2), 0);
  EXPECT_EQ(math::pow(0, -2), infinity);
  EXPECT_EQ(math::pow(0, 0), 1);
  EXPECT_EQ(math::pow(5, 0), 1);
  EXPECT_EQ(math::pow(1, 1e300), 1);
  EXPECT_EQ(math::pow(1, infinity), 1);
  EXPECT_EQ(math::pow(infinity, 0.5), infinity);
  EXPECT_EQ(math::pow(infinity, -0.5), 0);
  EXPECT_EQ(math::pow(0.5, infinity), 0);
  EXPECT_EQ(math::pow(0.5, -infinity), infinity);
  EXPECT_EQ(math::pow(2, infinity), infinity);
  EXPECT_EQ(math::pow(2, 1e30), infinity);
  EXPECT_EQ(math::pow(2, -1e30), 0);
  EXPECT_TRUE(std::isnan(math::pow(-2, 2)));
  EXPECT_TRUE(std::isnan(math::pow(nan, 2)));
  EXPECT_TRUE(std::isnan(math::pow(2, nan)));
}

TEST(MathEdges, PowersThatAreDoublesAreExact) {
  for (int n = -1074; n <= 1023; ++n) EXPECT_EQ(math::pow(2, n), std::ldexp(1.0, n)) << n;
  double power = 1;
  for (int n = 0; n <= 15; ++n, power *= 10) EXPECT_EQ(math::pow(10, n), power) << n;
  EXPECT_EQ(math::pow(0.25, 0.5), 0.5);
  EXPECT_EQ(math::pow(81, 0.25), 3);
}

// The same bits on every machine: sums of the bit patterns, fixed when the functions were written.
TEST(MathBits, StayTheSame) {
  Rng rng = stream(4, "bits");
  std::uint64_t sum = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::exp(40 * (x - 0.5))));
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::log(100 * x + 1e-3)));
    sum = mix(sum ^ std::bit_cast<std::uint64_t>(math::pow(10 * x + 1e-3, 8 * y - 4)));
  }
  EXPECT_EQ(sum, 1737561682137368216u);
}

}  // namespace
}  // namespace quoll
