#include "quoll/learn/interval_model.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/math.hpp"

namespace quoll {
namespace {

// More than rounding in kl() and in the sums of a row can come to.
constexpr double rounding = 1e-12;

double kl(double p, double q) {
  double sum = 0.0;
  if (p > 0.0) sum += p * math::log(p / q);
  if (p < 1.0) sum += (1.0 - p) * math::log((1.0 - p) / (1.0 - q));
  return sum;
}

// The end of [inside, outside] up to which kl(p, .) <= level, seen from outside.
double boundary(double p, double inside, double outside, double level) {
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (inside + outside);
    (kl(p, middle) <= level ? inside : outside) = middle;
  }
  return outside;
}

}  // namespace

std::pair<double, double> kl_interval(double share, double level) {
  level = level * (1.0 + rounding) + rounding;
  const double low = share <= 0.0 ? 0.0 : boundary(share, share, 0.0, level);
  const double high = share >= 1.0 ? 1.0 : boundary(share, share, 1.0, level);
  return {low, high};
}

IntervalModel::IntervalModel(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                             const ListedSuccessors& listed, const RewardRange& rewards,
                             double discount, double failure, bool noisy_rewards,
                             const std::vector<double>& square_sum)
    : begin_(begin),
      rewards_(rewards),
      discount_(discount),
      slack_(begin.back(), 0.0),
      listed_(!listed.begin.empty()) {
  const double pairs = static_cast<double>(begin.back());
  const double states = static_cast<double>(begin.size());  // the end is one more
  const double intervals = listed_ ? static_cast<double>(listed.next.size()) : pairs * states;
  const double share = noisy_rewards ? 0.5 * failure : failure;
  // Two sides of each interval.
  const double level = math::log(2.0 * intervals / share);
  // Two sides of each mean, and its variance, which both use.
  const double reward_level = math::log(3.0 * pairs / share);
  row_.push_back(0);
  for (std::uint64_t pair = 0; pair < begin.back(); ++pair) {
    add_row(model, pair, listed, level);
    const double n = model.tried(pair);
    if (!noisy_rewards || n == 0.0) continue;
    double sum = 0.0;
    model.each(pair, [&](const CountedModel::Outcome& seen) { sum += seen.reward_sum; });
    const double variance =
        n > 1.0 ? std::max(0.0, (square_sum[pair] - sum * sum / n) / (n - 1.0)) : 0.0;
    slack_[pair] = n > 1.0 ? std::sqrt(2.0 * variance * reward_level / n) +
                                 7.0 * rewards.span() * reward_level / (3.0 * (n - 1.0))
                           : rewards.span();
  }
}

void IntervalModel::add_row(const CountedModel& model, std::uint64_t pair,
                            const ListedSuccessors& listed, double level) {
  const double n = model.tried(pair);
  if (n > 0.0) {
    model.each(pair, [&](const CountedModel::Outcome& seen) {
      const auto [low, high] = kl_interval(seen.count / n, level / n);
      edges_.push_back({seen.next, low, high, seen.mean_reward(), seen.mean_reward()});
    });
    // Never seen: 0 <= p <= 1 - exp(-level / n).
    const double unseen = std::min(1.0, (1.0 - math::exp(-level / n)) * (1.0 + rounding));
    const std::size_t seen = edges_.size();
    std::vector<bool> counted(seen - row_.back(), false);
    for (std::uint64_t i = listed_ ? listed.begin[pair] : 0; listed_ && i < listed.begin[pair + 1];
         ++i) {
      const State next = listed.next[i];
      // A listed end stands for one end seen at most: they look alike but for their rewards.
      bool known = false;
      for (std::size_t e = row_.back(); e < seen && !known; ++e) {
        if (edges_[e].next != next || counted[e - row_.back()]) continue;
        known = counted[e - row_.back()] = true;
      }
      const auto& range = next == the_end ? rewards_.last : rewards_.running;
      if (!known) edges_.push_back({next, 0.0, unseen, range.first, range.second});
    }
  }
  row_.push_back(edges_.size());
}

// sum of probability * (reward + discount * value), with the probabilities that make it largest or
// smallest. `extreme` = what anything not in the row can be worth at best or at worst.
double IntervalModel::expected(std::uint64_t pair, const std::vector<double>& value, double extreme,
                               bool best) const {
  const std::uint64_t first = row_[pair], last = row_[pair + 1];
  if (first == last) return extreme;
  struct Worth {
    double worth, room;
  };
  thread_local std::vector<Worth> order;
  order.clear();
  double sum = 0.0, spare = 1.0;
  for (std::uint64_t i = first; i < last; ++i) {
    const Edge& edge = edges_[i];
    const double worth = (best ? edge.most : edge.least) +
                         (edge.next == the_end ? 0.0 : discount_ * value[edge.next]);
    sum += edge.low * worth;
    spare -= edge.low;
    order.push_back({worth, edge.high - edge.low});
  }
  if (!listed_) order.push_back({extreme, 1.0});
  std::sort(order.begin(), order.end(), [best](const Worth& a, const Worth& b) {
    return best ? a.worth > b.worth : a.worth < b.worth;
  });
  for (const Worth& next : order) {
    if (spare <= 0.0) break;
    const double given = std::min(spare, next.room);
    sum += given * next.worth;
    spare -= given;
  }
  if (spare > 0.0) sum += spare * extreme;
  return sum + (best ? slack_[pair] : -slack_[pair]);
}

void IntervalModel::lower_upper_bound(std::vector<double>& upper, double least) const {
  constexpr int most_sweeps = 100'000;
  const auto most_of_all = [&] {
    const double top = *std::max_element(upper.begin(), upper.end());
    return std::max(rewards_.last.second, rewards_.running.second + discount_ * top);
  };
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double extreme = most_of_all();
    double largest = 0.0;
    for (State s = 0; s + 1 < begin_.size(); ++s) {
      if (begin_[s] == begin_[s + 1]) continue;
      double best = -HUGE_VAL;
      for (std::uint64_t pair = begin_[s]; pair < begin_[s + 1]; ++pair) {
        best = std::max(best, expected(pair, upper, extreme, true));
      }
      best += rounding * std::fabs(best);
      largest = std::max(largest, upper[s] - best);
      upper[s] = std::min(upper[s], best);
    }
    if (largest <= least) return;
  }
}

void IntervalModel::raise_lower_bound(std::vector<double>& lower, std::vector<Action>& policy,
                                      double lowest, double least) const {
  constexpr int most_sweeps = 100'000;
  lower.assign(begin_.size() - 1, lowest);
  policy.assign(begin_.size() - 1, no_action);
  for (State s = 0; s + 1 < begin_.size(); ++s) {
    if (begin_[s] == begin_[s + 1]) lower[s] = 0.0;
  }
  const double floor =
      std::min(rewards_.last.first, rewards_.running.first + discount_ * std::min(lowest, 0.0));
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double largest = 0.0;
    for (State s = 0; s + 1 < begin_.size(); ++s) {
      if (begin_[s] == begin_[s + 1]) continue;
      double best = -HUGE_VAL;
      Action action = 0;
      for (std::uint64_t pair = begin_[s]; pair < begin_[s + 1]; ++pair) {
        const double sure = expected(pair, lower, floor, false);
        if (sure > best) action = static_cast<Action>(pair - begin_[s]);
        best = std::max(best, sure);
      }
      best -= rounding * std::fabs(best);
      // An action is taken over only with the bound it proves.
      if (best > lower[s] || policy[s] == no_action) policy[s] = action;
      largest = std::max(largest, best - lower[s]);
      lower[s] = std::max(lower[s], best);
    }
    if (largest <= least) return;
  }
}

}  // namespace quoll
