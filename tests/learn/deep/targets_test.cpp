// Targets against scalar formulas in double, and distributions by hand.

#include "quoll/learn/deep/targets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "quoll/base/random.hpp"

namespace quoll {
namespace {

std::vector<float> random_numbers(std::size_t n, Rng& rng) {
  std::vector<float> x(n);
  for (float& value : x) value = static_cast<float>(4.0 * rng.uniform() - 2.0);
  return x;
}

TEST(Distribution, MeansByHand) {
  const Distribution mean(Returns::mean, 1, 0, 0), quantile(Returns::quantile, 4, 0, 0);
  const Distribution categorical(Returns::categorical, 3, -1, 1);
  EXPECT_EQ(mean.mean(std::vector<float>{7}), 7.0F);
  EXPECT_EQ(quantile.mean(std::vector<float>{1, 2, 3, 6}), 3.0F);
  // Probabilities 1/4, 1/4, 1/2 of -1, 0, 1.
  EXPECT_NEAR(categorical.mean(std::vector<float>{0, 0, std::log(2.0F)}), 0.25F, 1e-6F);
}

// Atoms -1, 0, 1, 2 with probability 1/4 each.
TEST(Distribution, ProjectionKeepsTheMass) {
  const Distribution d(Returns::categorical, 4, -1, 2);
  const std::vector<float> even(4, 0.0F);
  std::vector<float> out(4);
  const auto expect = [&](float reward, float carry, std::vector<float> shares) {
    d.target(even, reward, carry, out);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(out[i], shares[i], 1e-6F) << reward << carry;
    EXPECT_NEAR(std::accumulate(out.begin(), out.end(), 0.0F), 1.0F, 1e-6F);
  };
  expect(0, 1, {0.25, 0.25, 0.25, 0.25});  // atoms fall on atoms
  expect(1, 1, {0, 0.25, 0.25, 0.5});      // what is above counts as the last
  expect(0, 0, {0, 1, 0, 0});              // an end: one atom
  expect(-1, 0, {1, 0, 0, 0});
  expect(2, 0, {0, 0, 0, 1});
  expect(0.25F, 0, {0, 0.75, 0.25, 0});
  expect(0, 0.5F, {0.125, 0.5, 0.375, 0});  // -1/2, 0, 1/2, 1
  expect(0, -1, {0.5, 0.25, 0.25, 0});      // the opponent's: 1, 0, -1, -2
}

TEST(Targets, AreTheFormulas) {
  Rng rng = stream(3, "targets");
  constexpr std::size_t actions = 4;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<float> next = random_numbers(actions, rng);
    const std::vector<float> online = random_numbers(actions, rng);
    const std::vector<float> here = random_numbers(actions, rng);
    const std::size_t legal = 1 + rng.below(actions), legal_here = 1 + rng.below(actions);
    const Action action = rng.below(static_cast<std::uint32_t>(legal_here));
    const auto reward = static_cast<float>(rng.uniform());
    const float carry = rng.below(4) == 0 ? 0.0F : rng.below(2) == 0 ? 0.9F : -0.9F;
    const Surroundings at{next.data(), online.data(), here.data(), legal, legal_here};
    const auto target = [&](bool double_q, bool munchausen) {
      DeepSettings how;
      how.double_q = double_q;
      how.munchausen = munchausen;
      float y = 0.0F;
      Targets(how, Distribution(Returns::mean, 1, 0, 0), actions)
          .find(at, action, reward, carry, {&y, 1});
      return double{y};
    };
    const auto best = [&](const std::vector<float>& q) {
      return std::max_element(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(legal)) -
             q.begin();
    };
    const double r = double{reward}, g = double{carry};
    EXPECT_NEAR(target(false, false), r + g * next[static_cast<std::size_t>(best(next))], 1e-6);
    EXPECT_NEAR(target(true, false), r + g * next[static_cast<std::size_t>(best(online))], 1e-6);
    const auto log_policy = [](const std::vector<float>& q, std::size_t count, std::size_t a) {
      const double most =
          double{*std::max_element(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(count))};
      double sum = 0.0;
      for (std::size_t b = 0; b < count; ++b) sum += std::exp((double{q[b]} - most) / 0.03);
      return (double{q[a]} - most) / 0.03 - std::log(sum);
    };
    const auto soft = [&](const std::vector<float>& chooses) {
      double y = r + 0.9 * std::max(0.03 * log_policy(here, legal_here, action), -1.0);
      for (std::size_t b = 0; b < legal; ++b) {
        const double log_share = log_policy(chooses, legal, b);
        y += g * std::exp(log_share) * (double{next[b]} - 0.03 * log_share);
      }
      return y;
    };
    EXPECT_NEAR(target(false, true), soft(next), 1e-5);
    EXPECT_NEAR(target(true, true), soft(online), 1e-5);
  }
}

TEST(Targets, OfDistributionsAreThoseOfTheBestAction) {
  DeepSettings how;
  how.returns = Returns::quantile;
  Targets targets(how, Distribution(Returns::quantile, 2, 0, 0), 3);
  const std::vector<float> next = {0, 1, 5, -3, 2, 2};  // means 0.5, 1, 2
  std::vector<float> y(2);
  targets.find({next.data(), nullptr, nullptr, 3, 3}, 0, 1.0F, 0.5F, y);
  EXPECT_EQ(y, (std::vector<float>{2, 2}));
  targets.find({next.data(), nullptr, nullptr, 2, 3}, 0, 1.0F, 0.5F, y);
  EXPECT_EQ(y, (std::vector<float>{3.5F, -0.5F}));
}

}  // namespace
}  // namespace quoll
