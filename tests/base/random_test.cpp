#include "quoll/base/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

namespace quoll {
namespace {

// The first outputs of SplitMix64 with seed 0, from the reference program splitmix64.c of
// Sebastiano Vigna (prng.di.unimi.it), whose state is a multiple of the golden ratio.
TEST(Random, IsSplitMix64) {
  Rng rng{0};
  EXPECT_EQ(rng.next(), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(rng.next(), 0x6e789e6aa1b965f4ULL);
  EXPECT_EQ(rng.next(), 0x06c45d188009454fULL);
  EXPECT_EQ(Rng{0}.peek(1), 0xe220a8397b1dcdafULL);
}

TEST(Random, ADrawCanBeRepeatedAndSkipped) {
  Rng rng = stream(7, "world", 3);
  std::vector<std::uint64_t> draws;
  for (int i = 0; i < 10; ++i) draws.push_back(rng.next());
  Rng skipped = stream(7, "world", 3);
  EXPECT_EQ(skipped.peek(10), draws[9]);
  skipped.skip(6);
  EXPECT_EQ(skipped.next(), draws[6]);
}

TEST(Random, StreamsOfSeedsPurposesAndLanesDiffer) {
  std::set<std::uint64_t> keys;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto* purpose : {"behaviour", "world", "evaluation", "", "a", "b"}) {
      for (std::uint64_t lane = 0; lane < 20; ++lane)
        keys.insert(stream(seed, purpose, lane).state);
    }
  }
  EXPECT_EQ(keys.size(), 20u * 6u * 20u);
}

// Neighbouring streams share no draws and agree in half of their bits. For 64 x 10,000 bits the
// number of equal ones has standard deviation 400; six of them for 4 pairs: false alarm below 1e-8.
TEST(Random, StreamsAreIndependent) {
  const std::array<std::array<Rng, 2>, 4> pairs{{
      {stream(1, "world", 0), stream(1, "world", 1)},
      {stream(1, "world", 0), stream(2, "world", 0)},
      {stream(1, "world", 0), stream(1, "behaviour", 0)},
      {stream(0, "", 0), stream(0, "", 1)},
  }};
  for (auto [a, b] : pairs) {
    int equal_bits = 0;
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 10'000; ++i) {
      const std::uint64_t x = a.next();
      const std::uint64_t y = b.next();
      equal_bits += 64 - std::popcount(x ^ y);
      seen.insert(x);
      seen.insert(y);
    }
    EXPECT_NEAR(equal_bits, 320'000, 2'400);
    EXPECT_EQ(seen.size(), 20'000u);
  }
}

// Pearson's chi-square with k = n - 1 degrees of freedom exceeds k + 2 sqrt(k x) + 2 x with
// probability at most e^-x (Laurent, Massart 2000, lemma 1). With x = 16 and five values of n:
// false alarm below 1e-6.
TEST(Random, BelowIsUniform) {
  for (const std::uint32_t n : {2u, 5u, 7u, 64u, 1000u}) {
    Rng rng = stream(11, "below", n);
    std::vector<int> counts(n);
    const int draws = 200'000;
    for (int i = 0; i < draws; ++i) {
      const std::uint32_t value = rng.below(n);
      ASSERT_LT(value, n);
      ++counts[value];
    }
    const double expected = static_cast<double>(draws) / n;
    double chi_square = 0;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    const double k = n - 1;
    EXPECT_LT(chi_square, k + 2 * std::sqrt(16 * k) + 2 * 16) << n;
  }
}

TEST(Random, EdgesOfTheRanges) {
  EXPECT_EQ(scale(0, 7), 0u);
  EXPECT_EQ(scale(0xffffffffu, 7), 6u);
  EXPECT_EQ(scale(0x80000000u, 2), 1u);
  EXPECT_EQ(scale(0x7fffffffu, 2), 0u);
  EXPECT_EQ(scale(0xffffffffu, 1), 0u);
  EXPECT_EQ(unit(0), 0);
  EXPECT_EQ(unit(~std::uint64_t{0}), 1 - 0x1p-53);
}

// The mean of 100,000 uniform numbers has standard deviation 1/sqrt(12 x 100,000) = 0.00091; five
// of them: false alarm below 1e-6.
TEST(Random, UniformHasItsMean) {
  Rng rng = stream(5, "uniform");
  double total = 0;
  for (int i = 0; i < 100'000; ++i) total += rng.uniform();
  EXPECT_NEAR(total / 100'000, 0.5, 0.0046);
}

TEST(Random, StreamsAreFixedForEver) {
  // Computed by a separate program in Python from the definition; saved runs depend on them.
  EXPECT_EQ(stream(1, "behaviour", 0).state, 0x6389630bca16d6e6ULL);
  EXPECT_EQ(stream(1, "world", 2).state, 0x1674fb4192b0ad55ULL);
}

}  // namespace
}  // namespace quoll
