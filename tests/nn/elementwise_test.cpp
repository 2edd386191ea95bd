#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "quoll/nn/arithmetic.hpp"
#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

// The distance between neighbouring floats at `value`.
double float_ulp(double value) {
  if (std::fabs(value) < 0x1p-126) return 0x1p-149;
  return std::scalbn(1.0, std::ilogb(value) - 23);
}

double exact(Activation kind, double x) {
  switch (kind) {
    case Activation::none:
      return x;
    case Activation::relu:
      return x > 0.0 ? x : 0.0;
    case Activation::elu:
      return x > 0.0 ? x : std::expm1(x);
    case Activation::leaky_relu:
      return x > 0.0 ? x : double{0.01f} * x;
    case Activation::tanh:
      break;
  }
  return std::tanh(x);
}

// Both signs, sizes from 1e-30 to 1e4 and at the ends of floats.
std::vector<float> arguments() {
  std::vector<float> values{0.0f,  -0.0f,  1e-45f, -1e-45f, 3.4e38f,  -3.4e38f,  87.0f,  -87.0f,
                            88.8f, -88.8f, 104.0f, -104.0f, INFINITY, -INFINITY, 1e-38f, -1e-38f};
  for (double x = 1e-30; x < 1e4; x *= 1.0005) {
    values.push_back(static_cast<float>(x));
    values.push_back(static_cast<float>(-x));
  }
  values.resize(padded(values.size()), 0.5f);
  return values;
}

// Measured: elu 0.8, tanh 2.2 (fused and not).
TEST(Activation, WithinAFewUlpsOfTheExactFunction) {
  const std::vector<float> x = arguments();
  on_every_target([&] {
    for (const Activation kind : {Activation::none, Activation::relu, Activation::elu,
                                  Activation::tanh, Activation::leaky_relu}) {
      std::vector<float> y = x;
      arithmetic().activate(kind, y.data(), y.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double expected = exact(kind, double{x[i]});
        if (double{y[i]} == expected) continue;
        worst = std::max(worst, std::fabs(y[i] - expected) / float_ulp(expected));
      }
      const double bound[] = {0.0, 0.0, 1.0, 2.5, 0.5};
      EXPECT_LE(worst, bound[static_cast<std::size_t>(kind)])
          << activation_names[static_cast<std::size_t>(kind)];
    }
  });
}

TEST(Arithmetic, ExponentialsWithinAnUlp) {
  std::vector<float> x;
  for (float value = 0.0f; value > -87.0f; value -= 0.0013f) x.push_back(value);
  x.resize(padded(x.size()), -86.9f);
  on_every_target([&] {
    std::vector<float> y = x;
    arithmetic().exponentials(y.data(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double expected = std::exp(double{x[i]});
      EXPECT_LE(std::fabs(y[i] - expected), float_ulp(expected)) << x[i];
    }
    std::vector<float> ends(vector_width, -87.5f);
    ends[0] = 0.0f;
    ends[1] = -INFINITY;
    ends[2] = std::nanf("");
    ends[3] = -3.4e38f;
    arithmetic().exponentials(ends.data(), ends.size());
    EXPECT_EQ(ends[0], 1.0f);
    EXPECT_EQ(ends[1], 0.0f);
    EXPECT_TRUE(std::isnan(ends[2]));
    EXPECT_EQ(ends[3], 0.0f);
    EXPECT_EQ(ends[4], 0.0f);
  });
}

TEST(Activation, WhatIsNoNumberStaysSo) {
  on_every_target([] {
    for (const Activation kind : {Activation::none, Activation::relu, Activation::elu,
                                  Activation::tanh, Activation::leaky_relu}) {
      std::vector<float> y(16, std::nanf(""));
      arithmetic().activate(kind, y.data(), y.size());
      for (const float one : y) EXPECT_TRUE(std::isnan(one));
    }
  });
}

TEST(Activation, SlopeIsTheDerivativeToldFromTheOutput) {
  const std::vector<float> x = random_floats(160, 3), g = random_floats(160, 4);
  on_every_target([&] {
    for (const Activation kind : {Activation::none, Activation::relu, Activation::elu,
                                  Activation::tanh, Activation::leaky_relu}) {
      std::vector<float> y(x), gradient(g);
      for (float& one : y) one *= 3.0f;
      arithmetic().activate(kind, y.data(), y.size());
      arithmetic().slope(kind, y.data(), gradient.data(), gradient.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double at = 3.0 * x[i], h = 1e-6;
        const double derivative = (exact(kind, at + h) - exact(kind, at - h)) / (2 * h);
        EXPECT_NEAR(gradient[i], derivative * g[i], 1e-6) << at;
      }
    }
  });
}

TEST(Arithmetic, TransposesAndAddsUpColumns) {
  const std::size_t rows = 16, columns = 48, row = 64;
  const std::vector<float> x = random_floats(rows * row, 7);
  on_every_target([&] {
    std::vector<float> turned(columns * 32, -1.0f), sums(columns);
    arithmetic().transpose(x.data(), rows, columns, row, turned.data(), 32);
    arithmetic().column_sums(x.data(), rows, columns, row, sums.data());
    for (std::size_t j = 0; j < columns; ++j) {
      float sum = 0.0f;
      for (std::size_t i = 0; i < 32; ++i) {
        EXPECT_EQ(turned[j * 32 + i], i < rows ? x[i * row + j] : -1.0f);
        if (i < rows) sum += x[i * row + j];
      }
      EXPECT_EQ(sums[j], sum) << "one row after the other";
    }
  });
}

// Layer normalisation of `columns` numbers and its derivatives, in double precision.
struct Normalised {
  std::vector<double> y, by_x, by_gain, by_shift;

  Normalised(const Rows& shape, double epsilon, const std::vector<float>& x,
             const std::vector<float>& gain, const std::vector<float>& shift,
             const std::vector<float>& by_y)
      : y(x.size()), by_x(x.size()), by_gain(shape.row), by_shift(shape.row) {
    const auto n = static_cast<double>(shape.columns);
    for (std::size_t i = 0; i < shape.rows; ++i) {
      const std::size_t at = i * shape.row;
      double mean = 0.0, variance = 0.0;
      for (std::size_t j = 0; j < shape.columns; ++j) mean += x[at + j] / n;
      for (std::size_t j = 0; j < shape.columns; ++j) {
        variance += (x[at + j] - mean) * (x[at + j] - mean) / n;
      }
      const double scale = 1.0 / std::sqrt(variance + epsilon);
      const auto z = [&](std::size_t j) { return (x[at + j] - mean) * scale; };
      for (std::size_t j = 0; j < shape.columns; ++j) {
        y[at + j] = z(j) * gain[j] + shift[j];
        by_gain[j] += by_y[at + j] * z(j);
        by_shift[j] += by_y[at + j];
        // dz_l / dx_j = scale (delta_lj - 1/n - z_l z_j / n), term by term.
        for (std::size_t l = 0; l < shape.columns; ++l) {
          const double delta = l == j ? 1.0 : 0.0;
          by_x[at + j] += by_y[at + l] * gain[l] * scale * (delta - 1.0 / n - z(l) * z(j) / n);
        }
      }
    }
  }
};

TEST(Arithmetic, NormalisesRowsAndPassesGradientsBack) {
  for (const std::size_t columns : {1, 5, 16, 17, 40, 96}) {
    // More rows than are looked at together, and some over.
    const Rows shape{37, columns, padded(columns)};
    const float epsilon = 1e-3f;
    std::vector<float> x = random_floats(shape.rows * shape.row, columns),
                       by_y = random_floats(x.size(), 2);
    std::vector<float> gain = random_floats(shape.row, 3), shift = random_floats(shape.row, 4);
    for (std::size_t j = columns; j < shape.row; ++j) {
      gain[j] = shift[j] = 0.0f;
      for (std::size_t i = 0; i < shape.rows; ++i) {
        x[i * shape.row + j] = by_y[i * shape.row + j] = 0.0f;
      }
    }
    const Normalised naive(shape, double{epsilon}, x, gain, shift, by_y);
    same_bits_where_fused([&] {
      std::vector<float> z = x, y(x.size()), scales(shape.rows), g = by_y, by_gain(shape.row, 9.0f);
      std::vector<float> by_shift(shape.row, 9.0f);
      arithmetic().normalise(shape, epsilon, z.data(), gain.data(), shift.data(), true, y.data(),
                             scales.data());
      const std::vector<float> above = y;
      z = x;
      arithmetic().normalise(shape, epsilon, z.data(), gain.data(), shift.data(), false, y.data(),
                             scales.data());
      for (std::size_t i = 0; i < y.size(); ++i) EXPECT_EQ(above[i], std::max(y[i], 0.0f));
      arithmetic().normalise_back(shape, z.data(), scales.data(), gain.data(), g.data(),
                                  by_gain.data(), by_shift.data());
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(y[i], naive.y[i], 2e-6);
        EXPECT_NEAR(g[i], naive.by_x[i], 1e-5 * scales[i / shape.row]);
        if (i % shape.row >= columns) {
          EXPECT_EQ(y[i], 0.0f);
          EXPECT_EQ(g[i], 0.0f);
        }
      }
      for (std::size_t j = 0; j < shape.row; ++j) {
        EXPECT_NEAR(by_gain[j], naive.by_gain[j], 1e-5);
        EXPECT_NEAR(by_shift[j], naive.by_shift[j], 1e-5);
      }
      y.insert(y.end(), g.begin(), g.end());
      y.insert(y.end(), by_gain.begin(), by_gain.end());
      return y;
    });
  }
}

TEST(Arithmetic, FindsWhatIsNotZero) {
  on_every_target([] {
    for (const std::size_t n : {1, 15, 16, 40, 67}) {
      std::vector<float> x(n);
      x[0] = 1.0f, x[n - 1] = std::nanf(""), x[n / 2] = -0.5f, x[n / 3] = n > 3 ? -0.0f : 1.0f;
      std::vector<std::uint32_t> expected;
      for (std::size_t i = 0; i < n; ++i) {
        if (x[i] != 0.0f) expected.push_back(static_cast<std::uint32_t>(i));
      }
      const std::size_t count = expected.size();
      std::vector<std::uint32_t> found(count);
      ASSERT_EQ(arithmetic().find_spots(x.data(), n, found.data(), count), count);
      EXPECT_EQ(found, expected);
      EXPECT_EQ(arithmetic().find_spots(x.data(), n, found.data(), count - 1), count);
    }
  });
}

TEST(Arithmetic, SumsScalesAndBlends) {
  const std::vector<float> x = random_floats(10000, 8), other = random_floats(10000, 9);
  double squares = 0.0;
  for (const float one : x) squares += double{one} * one;
  same_bits_where_fused([&] {
    const double found = arithmetic().sum_of_squares(x.data(), x.size());
    EXPECT_NEAR(found, squares, 1e-6 * squares);
    std::vector<float> scaled = x, blended = x;
    arithmetic().scale(scaled.data(), x.size(), 0.3f);
    arithmetic().blend(blended.data(), other.data(), x.size(), 0.25f);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_EQ(scaled[i], x[i] * 0.3f);
      EXPECT_NEAR(blended[i], 0.75 * x[i] + 0.25 * other[i], 2e-7);
    }
    blended.push_back(static_cast<float>(found));
    return blended;
  });
}

TEST(Arithmetic, AWholeBlendIsACopyAndNoneLeavesAll) {
  const std::vector<float> x{1.0f, 2.0f, 3.0f, 4.0f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5.0f};
  on_every_target([&] {
    std::vector<float> to(16, 8.0f);
    arithmetic().blend(to.data(), x.data(), 16, 0.0f);
    EXPECT_EQ(to, std::vector<float>(16, 8.0f));
    arithmetic().blend(to.data(), x.data(), 16, 1.0f);
    EXPECT_EQ(to, x);
  });
}

TEST(Activation, FusedTargetsGiveTheSameBits) {
  const std::vector<float> x = arguments();
  for (const Activation kind : {Activation::relu, Activation::elu, Activation::tanh}) {
    same_bits_where_fused([&] {
      std::vector<float> y = x, g = x;
      arithmetic().activate(kind, y.data(), y.size());
      for (float& one : g) one = std::isfinite(one) ? one : 1.0f;
      arithmetic().slope(kind, y.data(), g.data(), g.size());
      std::vector<float> both = y;
      both.insert(both.end(), g.begin(), g.end());
      return both;
    });
  }
}

}  // namespace
}  // namespace quoll::nn
