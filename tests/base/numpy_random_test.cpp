#include "quoll/base/numpy_random.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quoll {
namespace {

// NumPy 1.24: g = default_rng(seed); g.random(), then five times g.integers(13), g.random().
TEST(NumpyRandom, IsNumPysGenerator) {
  struct Row {
    std::uint64_t seed;
    double first;
    std::vector<std::uint32_t> whole;
    std::vector<double> real;
  };
  const Row rows[] = {
      {0,
       0x1.461fd79fb3850p-1,
       {6, 3, 2, 10, 12},
       {0x1.4fa7b529d9bd0p-5, 0x1.0ec9ed84d0bc0p-6, 0x1.d354b2f34c803p-1, 0x1.3698f6e301db6p-1,
        0x1.165603cf43b8fp-1}},
      {1,
       0x1.060d7be6f245cp-1,
       {9, 12, 3, 4, 3},
       {0x1.273d27b04760cp-3, 0x1.e5b5615da558dp-1, 0x1.b17c7d1779e1cp-2, 0x1.a7c8a2668bdcdp-1,
        0x1.1964580549a3fp-1}},
      {42,
       0x1.8c43f79a2db24p-1,
       {8, 5, 2, 1, 9},
       {0x1.b79a2584ddb42p-1, 0x1.650d6c1c2c011p-1, 0x1.f384c5db0d8eap-1, 0x1.85b41a5f78b48p-1,
        0x1.066070b41b168p-3}},
      {(std::uint64_t{1} << 40) + 7,
       0x1.a8dd3c4069bc4p-1,
       {7, 3, 11, 9, 8},
       {0x1.3af6a07822d64p-3, 0x1.5958a8eb02697p-1, 0x1.f5c15bc460c2ep-2, 0x1.f8971956448c0p-7,
        0x1.11ca13959250cp-3}},
  };
  for (const Row& row : rows) {
    NumpyRandom random(row.seed);
    EXPECT_EQ(random.random(), row.first) << row.seed;
    for (int i = 0; i < 5; ++i) {
      EXPECT_EQ(random.integers(13), row.whole[i]) << row.seed << " " << i;
      EXPECT_EQ(random.random(), row.real[i]) << row.seed << " " << i;
    }
  }
}

// The same with integers(3_000_000_000), seed 42: nearly every third number is drawn again.
TEST(NumpyRandom, DrawsAgainWhatWouldNotBeFair) {
  NumpyRandom random(42);
  for (const std::uint32_t expected : {267752861u, 2321868145u, 1963714555u, 1316635318u,
                                       2575793759u, 282532043u, 1579436936u, 2926867054u}) {
    EXPECT_EQ(random.integers(3'000'000'000u), expected);
  }
}

TEST(NumpyRandom, DrawsNothingForOnePossibility) {
  NumpyRandom random(7);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(random.integers(1), 0u);
  EXPECT_EQ(random.random(), 0x1.400c8353e3ca9p-1);
}

TEST(NumpyRandom, GoesOnWhereItWasSaved) {
  NumpyRandom random(3);
  random.integers(5);  // half a word is kept
  Archive out;
  out("random", random);
  NumpyRandom again(4);
  Archive in{std::span<const std::byte>(out.bytes())};
  in("random", again);
  ASSERT_TRUE(in.good() && in.at_end());
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(again.integers(1000), random.integers(1000));
    EXPECT_EQ(again.random(), random.random());
  }
}

}  // namespace
}  // namespace quoll
