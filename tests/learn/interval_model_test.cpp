// How often the intervals miss, exactly: the chances of all counts that leave the truth outside,
// summed. Each test also narrows them, to see that it would notice.

#include "quoll/learn/interval_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quoll {
namespace {

using Interval = std::pair<double, double>;

// The chance of each count of heads in n draws.
std::vector<double> binomial(int n, double p) {
  std::vector<double> chance{1.0};
  for (int draw = 0; draw < n; ++draw) {
    chance.push_back(0.0);
    for (std::size_t k = chance.size(); k-- > 0;) {
      chance[k] = chance[k] * (1.0 - p) + (k > 0 ? chance[k - 1] * p : 0.0);
    }
  }
  return chance;
}

// The largest chance over p = 1/200 .. 199/200 that p is not in the interval of the count drawn,
// each side cut to `kept` of its length.
double worst_miss(const std::vector<Interval>& of_count, double kept) {
  const int n = static_cast<int>(of_count.size()) - 1;
  double worst = 0.0;
  for (int i = 1; i < 200; ++i) {
    const double p = i / 200.0;
    const std::vector<double> chance = binomial(n, p);
    double miss = 0.0;
    for (int k = 0; k <= n; ++k) {
      const auto [low, high] = of_count[k];
      const double share = double(k) / n;
      if (p < share - kept * (share - low) || p > share + kept * (high - share)) miss += chance[k];
    }
    worst = std::max(worst, miss);
  }
  return worst;
}

TEST(KlInterval, MissesAsSeldomAsItSays) {
  for (const double delta : {0.5, 0.1, 0.05, 0.01}) {
    const double level = std::log(2.0 / delta);  // a half for each side
    for (int n = 1; n <= 60; ++n) {
      std::vector<Interval> of_count;
      for (int k = 0; k <= n; ++k) of_count.push_back(kl_interval(double(k) / n, level / n));
      EXPECT_LE(worst_miss(of_count, 1.0), delta) << n;
      if (delta < 0.5) {
        EXPECT_GT(worst_miss(of_count, 0.7), delta) << n;
      }
    }
  }
}

// One state that is its own successor at discount 0, whose reward is 1 (k times of n) or 0: bounds
// of its value are those of the mean reward, of which half of the failure is.
Interval reward_interval(int n, int k, double delta) {
  CountedModel model(1);
  for (int i = 0; i < n; ++i) model.observe(0, 0, i < k ? 1.0 : 0.0);
  const std::vector<std::uint64_t> begin{0, 1};
  const RewardRange rewards{{0.0, 1.0}, {HUGE_VAL, -HUGE_VAL}};
  const std::vector<double> square_sum{double(k)};
  const IntervalModel intervals(model, begin, {{0, 1}, {0}}, rewards, 0.0, 2.0 * delta, true,
                                square_sum);
  std::vector<double> lower, upper{1e9};
  std::vector<Action> policy;
  intervals.lower_upper_bound(upper, 1e-12);
  intervals.raise_lower_bound(lower, policy, -1e9, 1e-12);
  return {lower[0], upper[0]};
}

TEST(RewardInterval, IsTheEmpiricalBernsteinBound) {
  // Variance 400 * 0.6 / 999; ln(3 / delta) = 4: two sides and the variance.
  const double delta = 3.0 * std::exp(-4.0);
  const double half = std::sqrt(2.0 * (240.0 / 999.0) * 4.0 / 1000.0) + 7.0 * 4.0 / (3.0 * 999.0);
  const auto [low, high] = reward_interval(1000, 400, delta);
  EXPECT_NEAR(low, 0.4 - half, 1e-9);
  EXPECT_NEAR(high, 0.4 + half, 1e-9);
  // Once is no variance: the whole range.
  EXPECT_NEAR(reward_interval(1, 0, delta).second, 1.0, 1e-9);
}

// Far less often than it says: for a coin three tenths of its length would nearly do.
TEST(RewardInterval, MissesAsSeldomAsItSays) {
  for (const double delta : {0.5, 0.1, 0.05}) {
    double narrowed = 0.0;
    for (int n = 2; n <= 60; ++n) {
      std::vector<Interval> of_count;
      for (int k = 0; k <= n; ++k) of_count.push_back(reward_interval(n, k, delta));
      EXPECT_LE(worst_miss(of_count, 1.0), delta) << n;
      narrowed = std::max(narrowed, worst_miss(of_count, 0.25));
    }
    EXPECT_GT(narrowed, delta);
  }
}

}  // namespace
}  // namespace quoll
