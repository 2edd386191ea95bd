#include "quoll/base/ziggurat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace quoll {
namespace {

double below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

// How many of the draws lie below each of 200 places, against the distribution: five standard
// deviations each, so a false alarm is below 2e-4 for all; the seed is fixed.
TEST(Ziggurat, IsTheNormalDistribution) {
  constexpr std::size_t n = 4'000'000;
  Rng dice = stream(1, "ziggurat");
  std::vector<double> draws(n);
  for (double& x : draws) x = Ziggurat::normal().draw(dice);
  std::sort(draws.begin(), draws.end());
  for (double x = -5.0; x <= 5.0; x += 0.05) {
    const double p = below(x);
    const auto found = std::lower_bound(draws.begin(), draws.end(), x) - draws.begin();
    const double deviation = std::sqrt(static_cast<double>(n) * p * (1.0 - p));
    EXPECT_NEAR(static_cast<double>(found), static_cast<double>(n) * p, 5.0 * deviation + 3.0) << x;
  }
  EXPECT_GT(draws.back(), 4.5);
  EXPECT_LT(draws.front(), -4.5);
}

// Neighbouring draws have nothing to do with each other, nor their sizes.
TEST(Ziggurat, DrawsAreIndependent) {
  constexpr int n = 1'000'000;
  Rng dice = stream(2, "ziggurat");
  double products = 0.0, squares = 0.0, before = Ziggurat::normal().draw(dice);
  for (int i = 0; i < n; ++i) {
    const double x = Ziggurat::normal().draw(dice);
    products += x * before;
    squares += (x * x - 1.0) * (before * before - 1.0);
    before = x;
  }
  EXPECT_NEAR(products / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 0.0, 5.0 * 2.0 / std::sqrt(n));
}

TEST(Ziggurat, NearlyAlwaysTakesOneDraw) {
  constexpr std::uint64_t n = 100'000;
  Rng dice = stream(3, "ziggurat");
  const std::uint64_t begin = dice.state;
  for (std::uint64_t i = 0; i < n; ++i) Ziggurat::normal().draw(dice);
  std::uint64_t draws = 0;
  for (Rng counted{begin}; counted.state != dice.state; ++draws) counted.next();
  EXPECT_GT(draws, n);
  EXPECT_LT(draws, n + n / 40);
}

}  // namespace
}  // namespace quoll
