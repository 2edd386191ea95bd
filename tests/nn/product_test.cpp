#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "quoll/nn/arithmetic.hpp"
#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

// A product of m x k and k x n numbers with its results in double precision, and the sums of the
// terms' sizes: beginning with zeros, with the bias and with `before`, one after the other.
struct Naive {
  std::size_t m, n, k;
  std::vector<float> a, b, bias, before;
  std::vector<double> exact, sizes;

  Naive(std::size_t rows, std::size_t columns, std::size_t depth, std::uint64_t seed)
      : m(rows),
        n(columns),
        k(depth),
        a(random_floats(m * k, seed)),
        b(random_floats(k * n, seed + 1)),
        bias(random_floats(n, seed + 2)),
        before(random_floats(m * n, seed + 3)),
        exact(3 * m * n),
        sizes(3 * m * n) {
    for (int from = 0; from < 3; ++from) {
      for (std::size_t i = 0; i < m * n; ++i) {
        const float x = from == 0 ? 0.0f : from == 1 ? bias[i % n] : before[i];
        exact[from * m * n + i] = x;
        sizes[from * m * n + i] = std::fabs(x);
      }
    }
    for (std::size_t at = 0; at < 3 * m * n; ++at) {
      const std::size_t i = at / n % m, j = at % n;
      for (std::size_t l = 0; l < k; ++l) {
        const float x = a[i * k + l], y = b[l * n + j];
        exact[at] += double{x} * y;
        sizes[at] += std::fabs(double{x} * y);
      }
    }
  }
};

constexpr float untouched = 12345.0f;

std::vector<float> compute(const Naive& naive, bool across, int from, bool relu) {
  const std::size_t m = naive.m, n = naive.n, k = naive.k, c_row = n + vector_width;
  std::vector<float> turned(m * k), c(m * c_row, untouched);
  for (std::size_t i = 0; i < m * k; ++i) turned[i % k * m + i / k] = naive.a[i];
  for (std::size_t i = 0; i < m && from == 2; ++i) {
    std::memcpy(&c[i * c_row], &naive.before[i * n], n * sizeof(float));
  }
  arithmetic().product({.m = m,
                        .n = n,
                        .k = k,
                        .a = across ? turned.data() : naive.a.data(),
                        .a_row = across ? 1 : k,
                        .a_column = across ? m : 1,
                        .b = naive.b.data(),
                        .b_row = n,
                        .bias = from == 1 ? naive.bias.data() : nullptr,
                        .add = from == 2,
                        .relu = relu,
                        .c = c.data(),
                        .c_row = c_row});
  return c;
}

// Every result within the bound of a sum of k + 1 floats, nothing written beside C; both ways to
// read A give the same bits.
bool holds(const Naive& naive, int from, bool relu) {
  const std::size_t m = naive.m, n = naive.n, c_row = n + vector_width;
  const std::vector<float> plain = compute(naive, false, from, relu);
  const std::vector<float> across = compute(naive, true, from, relu);
  if (std::memcmp(plain.data(), across.data(), plain.size() * sizeof(float)) != 0) return false;
  const double unit = (static_cast<double>(naive.k) + 1.0) * 0x1p-24;
  for (std::size_t i = 0; i < m * c_row; ++i) {
    const std::size_t j = i % c_row;
    if (j >= n) {
      if (plain[i] != untouched) return false;
      continue;
    }
    const std::size_t at = (static_cast<std::size_t>(from) * m + i / c_row) * n + j;
    const double exact = relu ? std::max(naive.exact[at], 0.0) : naive.exact[at];
    if (!(std::fabs(plain[i] - exact) <= unit * naive.sizes[at])) return false;
  }
  return true;
}

void check_all(std::size_t m, std::size_t n, std::size_t k) {
  const Naive naive(m, n, k, m * 1000 + k);
  on_every_target([&] {
    for (const int from : {0, 1, 2}) {
      ASSERT_TRUE(holds(naive, from, false) && holds(naive, from, true))
          << m << " x " << n << " x " << k << ", beginning " << from;
    }
  });
}

TEST(Product, EveryShapeUpToFortyAgreesWithDoublePrecision) {
  for (std::size_t m = 1; m <= 40 && !HasFatalFailure(); ++m) {
    for (std::size_t k = 1; k <= 40 && !HasFatalFailure(); ++k) {
      for (const std::size_t n : {16, 32, 48}) check_all(m, n, k);
    }
  }
}

TEST(Product, EveryNumberOfColumnsAndBlocksOfK) {
  for (const std::size_t n : {16, 32, 48, 64, 80, 96, 112, 128, 144, 256}) {
    for (const std::size_t m : {1, 7, 13, 33}) check_all(m, n, 21);
  }
  for (const std::size_t k : {383, 384, 385, 767, 768, 769, 1000}) check_all(9, 48, k);
}

TEST(Product, AddsOneKAfterTheOtherWithTheRoundingOfItsClass) {
  const std::size_t k = 900;
  const Naive naive(11, 80, k, 1);
  on_every_target([&] {
    const std::vector<float> c = compute(naive, false, 1, false);
    for (std::size_t i = 0; i < 11; ++i) {
      for (std::size_t j = 0; j < 80; ++j) {
        float sum = naive.bias[j];
        for (std::size_t l = 0; l < k; ++l) {
          const float x = naive.a[i * k + l], y = naive.b[l * 80 + j];
          sum = arithmetic().fused ? std::fma(x, y, sum) : sum + x * y;
        }
        ASSERT_EQ(c[i * (80 + vector_width) + j], sum) << i << ", " << j;
      }
    }
  });
}

TEST(Product, FusedTargetsGiveTheSameBits) {
  for (const std::size_t k : {1, 30, 400}) {
    for (const std::size_t n : {16, 80, 144}) {
      const Naive naive(27, n, k, k);
      same_bits_where_fused([&] { return compute(naive, k == 30, 1, true); });
    }
  }
}

TEST(Product, WithoutTermsGivesTheBiasAndWithoutRowsNothing) {
  on_every_target([] {
    const std::vector<float> bias = random_floats(16, 5);
    std::vector<float> c(32, untouched);
    Product nothing{.m = 2, .n = 16, .k = 0, .a = bias.data(), .b = bias.data()};
    nothing.bias = bias.data();
    nothing.c = c.data();
    nothing.c_row = 16;
    arithmetic().product(nothing);
    EXPECT_EQ(std::vector(c.begin(), c.begin() + 16), bias);
    EXPECT_EQ(std::vector(c.begin() + 16, c.end()), bias);
    nothing.m = 0;
    nothing.bias = nullptr;
    arithmetic().product(nothing);
    EXPECT_EQ(c[0], bias[0]);
  });
}

TEST(Product, WhatIsNoNumberPassesTheRectifier) {
  on_every_target([] {
    const float a = std::nanf("");
    const std::vector<float> b(16, 1.0f);
    std::vector<float> c(16);
    arithmetic().product({.m = 1,
                          .n = 16,
                          .k = 1,
                          .a = &a,
                          .a_row = 1,
                          .b = b.data(),
                          .b_row = 16,
                          .relu = true,
                          .c = c.data(),
                          .c_row = 16});
    for (const float x : c) EXPECT_TRUE(std::isnan(x));
  });
}

TEST(Arithmetic, NamesItsTargetsAndRefusesOthers) {
  const std::string_view before = arithmetic().target;
  EXPECT_EQ(arithmetics().front(), before) << "the best one is taken";
  EXPECT_FALSE(use_arithmetic("abacus"));
  EXPECT_EQ(arithmetic().target, before);
  on_every_target([] { EXPECT_TRUE(arithmetic().product != nullptr); });
}

}  // namespace
}  // namespace quoll::nn
