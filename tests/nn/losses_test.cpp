#include "quoll/nn/losses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

TEST(Loss, ValuesAndSlopesByHand) {
  EXPECT_EQ(loss(LossKind::squared, 3.0f).value, 9.0);
  EXPECT_EQ(loss(LossKind::squared, -3.0f).slope, -6.0f);
  EXPECT_EQ(loss(LossKind::half_squared, -3.0f).value, 4.5);
  EXPECT_EQ(loss(LossKind::half_squared, -3.0f).slope, -3.0f);
  EXPECT_EQ(loss(LossKind::huber, 0.5f).value, 0.125);
  EXPECT_EQ(loss(LossKind::huber, 0.5f).slope, 0.5f);
  EXPECT_EQ(loss(LossKind::huber, -3.0f).value, 2.5);
  EXPECT_EQ(loss(LossKind::huber, -3.0f).slope, -1.0f);
  EXPECT_EQ(loss(LossKind::huber, 1.0f).value, 0.5) << "both pieces meet";
}

TEST(Loss, WhatIsNoNumberHasNoSlope) {
  for (const LossKind kind : {LossKind::squared, LossKind::half_squared, LossKind::huber}) {
    EXPECT_TRUE(std::isnan(loss(kind, std::nanf("")).slope));
    EXPECT_TRUE(std::isnan(loss(kind, std::nanf("")).value));
  }
}

TEST(Loss, SlopesAgreeWithFiniteDifferences) {
  for (const LossKind kind : {LossKind::squared, LossKind::half_squared, LossKind::huber}) {
    for (float e = -2.53125f; e < 2.5f; e += 0.1875f) {
      const float h = 1.0f / 1024.0f;
      const double difference = (loss(kind, e + h).value - loss(kind, e - h).value) / (2.0 * h);
      EXPECT_NEAR(loss(kind, e).slope, difference, 1e-3);
    }
  }
}

// -sum p log softmax(x) with the largest logit taken out.
double entropy_of(const std::vector<float>& logits, const std::vector<float>& target,
                  std::size_t moved = 0, double by = 0.0) {
  double sum = 0.0, loss = 0.0;
  const auto x = [&](std::size_t i) { return double{logits[i]} + (i == moved ? by : 0.0); };
  for (std::size_t i = 0; i < logits.size(); ++i) sum += std::exp(x(i) - logits[0]);
  for (std::size_t i = 0; i < logits.size(); ++i) {
    loss -= double{target[i]} * (x(i) - logits[0] - std::log(sum));
  }
  return loss;
}

TEST(CrossEntropy, ByHandAndByFiniteDifferences) {
  std::vector<float> gradient(2);
  const std::vector<float> even{0.0f, 0.0f}, all{1.0f, 0.0f};
  EXPECT_NEAR(cross_entropy(even, all, 2.0f, gradient), std::log(2.0), 1e-15);
  EXPECT_EQ(gradient, (std::vector<float>{-1.0f, 1.0f}));

  const std::vector<float> logits = random_floats(51, 1);
  std::vector<float> target = random_floats(51, 2);
  float sum = 0.0f;
  for (float& p : target) sum += p = std::fabs(p);
  for (float& p : target) p /= sum;
  gradient.resize(51);
  EXPECT_NEAR(cross_entropy(logits, target, 0.5f, gradient), entropy_of(logits, target), 1e-7);
  for (std::size_t i = 0; i < 51; ++i) {
    const double h = 1e-5;
    const double difference =
        (entropy_of(logits, target, i, h) - entropy_of(logits, target, i, -h));
    EXPECT_NEAR(gradient[i], 0.5 * difference / (2 * h), 1e-7);
  }
}

TEST(CrossEntropy, FarLogitsNeitherOverflowNorLoseTheLoss) {
  std::vector<float> gradient(2), p(2);
  const std::vector<float> far{1000.0f, -1000.0f}, other{0.0f, 1.0f};
  EXPECT_EQ(cross_entropy(far, other, 1.0f, gradient), 2000.0);
  EXPECT_EQ(gradient, (std::vector<float>{1.0f, -1.0f}));
  softmax(far, p);
  EXPECT_EQ(p, (std::vector<float>{1.0f, 0.0f}));
}

double quantile_loss(const std::vector<double>& quantiles, const std::vector<float>& targets) {
  double sum = 0.0;
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double tau = (static_cast<double>(i) + 0.5) / static_cast<double>(quantiles.size());
    for (const float target : targets) {
      const double u = target - quantiles[i], size = std::fabs(u);
      const double huber = size <= 1.0 ? u * u / 2 : size - 0.5;
      sum += std::fabs(tau - (u < 0 ? 1.0 : 0.0)) * huber / static_cast<double>(targets.size());
    }
  }
  return sum;
}

TEST(QuantileHuber, ByHandAndByFiniteDifferences) {
  std::vector<float> gradient(1);
  // tau = 1/2: half the Huber losses of 0 - (-3) and 0 - 0.5, the mean of the two.
  EXPECT_EQ(
      quantile_huber(std::vector<float>{0.0f}, std::vector<float>{-3.0f, 0.5f}, 1.0f, gradient),
      (2.5 / 2 + 0.125 / 2) / 2);
  EXPECT_EQ(gradient[0], (1.0f / 2 - 0.5f / 2) / 2);

  std::vector<float> quantiles = random_floats(7, 5), targets = random_floats(9, 6);
  for (float& one : targets) one *= 3.0f;
  gradient.resize(7);
  std::vector<double> at(quantiles.begin(), quantiles.end());
  EXPECT_NEAR(quantile_huber(quantiles, targets, 2.0f, gradient), quantile_loss(at, targets), 1e-6);
  for (std::size_t i = 0; i < 7; ++i) {
    const double here = at[i], h = 1e-6;
    at[i] = here + h;
    const double above = quantile_loss(at, targets);
    at[i] = here - h;
    EXPECT_NEAR(gradient[i], 2.0 * (above - quantile_loss(at, targets)) / (2 * h), 1e-6);
    at[i] = here;
  }
}

// Steps down the gradient find the quantiles of an even distribution so wide that the rounded part
// of the loss hardly counts.
TEST(QuantileHuber, FindsKnownQuantiles) {
  std::vector<float> targets, quantiles(5), gradient(5);
  for (int i = 0; i < 1000; ++i) targets.push_back(static_cast<float>(i) - 499.5f);
  for (int step = 0; step < 4000; ++step) {
    quantile_huber(quantiles, targets, 1.0f, gradient);
    for (std::size_t i = 0; i < 5; ++i) quantiles[i] -= 5.0f * gradient[i];
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(quantiles[i], -400.0 + 200.0 * static_cast<double>(i), 1.0);
  }
}

}  // namespace
}  // namespace quoll::nn
