#include "quoll/learn/tabular/optimistic_values.hpp"

#include <algorithm>
#include <cmath>

namespace quoll {
namespace {

// The row that the greedy policy uses in a state.
struct Row {
  double reward = 0.0;  // with the bonus
  std::uint32_t begin = 0, end = 0;
};

class Iteration {
 public:
  Iteration(const CountedModel& model, const std::vector<std::uint64_t>& begin,
            const Optimism& optimism, std::vector<double>& value, std::vector<double>& pair_value)
      : model_(model),
        begin_(begin),
        optimism_(optimism),
        value_(value),
        pair_value_(pair_value),
        rows_(value.size()) {}

  // One sweep over all pairs; returns the largest change, and packs the greedy rows.
  double improve() {
    next_.clear();
    share_.clear();
    double largest = 0.0;
    for (State s = 0; s < value_.size(); ++s) {
      if (begin_[s] == begin_[s + 1]) continue;
      std::uint64_t best = begin_[s];
      for (std::uint64_t pair = begin_[s]; pair < begin_[s + 1]; ++pair) {
        pair_value_[pair] = backup(pair);
        if (pair_value_[pair] > pair_value_[best]) best = pair;
      }
      largest = std::max(largest, std::fabs(pair_value_[best] - value_[s]));
      value_[s] = pair_value_[best];
      pack(s, best);
    }
    return largest;
  }

  // Sweeps over the greedy rows until they change by less than `least`.
  void evaluate(double least) {
    constexpr int most_sweeps = 10'000;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      double largest = 0.0;
      for (State s = 0; s < value_.size(); ++s) {
        const Row& row = rows_[s];
        if (row.begin == row.end) continue;
        double sum = row.reward;
        for (std::uint32_t i = row.begin; i < row.end; ++i) sum += share_[i] * value_[next_[i]];
        sum = std::min(sum, optimism_.most);
        largest = std::max(largest, std::fabs(sum - value_[s]));
        value_[s] = sum;
      }
      if (largest < least) return;
    }
  }

 private:
  double backup(std::uint64_t pair) const {
    const std::uint32_t n = model_.tried(pair);
    if (n < optimism_.known_after || n == 0) return optimism_.most;
    double mean = 0.0, square = 0.0;
    model_.each(pair, [&](const CountedModel::Outcome& seen) {
      const double after = seen.mean_reward() +
                           (seen.next == the_end ? 0.0 : optimism_.discount * value_[seen.next]);
      mean += seen.count * after;
      square += seen.count * (after * after);
    });
    mean /= n;
    const double variance = std::max(0.0, square / n - mean * mean);
    return std::min(optimism_.most, mean + bonus(variance, n));
  }
  double bonus(double variance, std::uint32_t n) const {
    return std::sqrt(optimism_.variance * variance / n) + optimism_.range_roots / n;
  }

  void pack(State s, std::uint64_t pair) {
    Row& row = rows_[s];
    row.begin = row.end = static_cast<std::uint32_t>(next_.size());
    const std::uint32_t n = model_.tried(pair);
    if (n < optimism_.known_after || n == 0) return;
    double following = 0.0;
    model_.each(pair, [&](const CountedModel::Outcome& seen) {
      if (seen.next == the_end) return;
      next_.push_back(seen.next);
      share_.push_back(optimism_.discount * seen.count / n);
      following += share_.back() * value_[seen.next];
    });
    row.end = static_cast<std::uint32_t>(next_.size());
    // The bonus stays as it is while the policy is evaluated; a value at the most stays there.
    row.reward = pair_value_[pair] - following;
    if (pair_value_[pair] >= optimism_.most) row.end = row.begin;
  }

  const CountedModel& model_;
  const std::vector<std::uint64_t>& begin_;
  const Optimism& optimism_;
  std::vector<double>& value_;
  std::vector<double>& pair_value_;
  std::vector<Row> rows_;
  std::vector<State> next_;
  std::vector<double> share_;
};

}  // namespace

void improve_optimistic_values(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                               const Optimism& optimism, std::vector<double>& value,
                               std::vector<double>& pair_value) {
  constexpr int most_rounds = 1000;
  Iteration iteration(model, begin, optimism, value, pair_value);
  for (int round = 0; round < most_rounds; ++round) {
    if (iteration.improve() < optimism.precision) return;
    iteration.evaluate(0.1 * optimism.precision);
  }
}

}  // namespace quoll
