#pragma once
// What experience proves of a world with noise: an interval for each probability, and from them
// bounds on values that hold for every world the intervals allow. Interval MDPs: Givan, Leach, Dean
// 2000; for learning: Strehl, Littman 2008; Ashok, Kretinsky, Weininger 2019.

#include <cstdint>
#include <vector>

#include "quoll/learn/tabular/counted_model.hpp"
#include "quoll/learn/value_range.hpp"

namespace quoll {

/// The smallest and the largest q with n kl(share, q) <= level n, kl that of two coins (Chernoff
/// 1952); rounded outward. share in [0, 1], level >= 0.
std::pair<double, double> kl_interval(double share, double level);

/// The states that may follow each pair, as a world lists them beforehand; the_end for each end.
struct ListedSuccessors {
  std::vector<std::uint64_t> begin;  ///< per pair, and the end; empty = nothing is listed
  std::vector<State> next;
};

class IntervalModel {
 public:
  /// Intervals that all hold together with probability 1 - failure. Without a list every state may
  /// follow every pair. With `noisy_rewards` half of the failure goes to the mean rewards, for
  /// which `square_sum` per pair is the sum of squared rewards (Maurer, Pontil 2009, empirical
  /// Bernstein); else a reward is taken to depend on state, action and successor only.
  IntervalModel(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                const ListedSuccessors& listed, const RewardRange& rewards, double discount,
                double failure, bool noisy_rewards, const std::vector<double>& square_sum);

  /// upper <- min(upper, what the best allowed world gives), sweep after sweep: every one is an
  /// upper bound if the first is. Ends when nothing falls by more than `least`.
  void lower_upper_bound(std::vector<double>& upper, double least) const;
  /// lower <- the most that a policy is sure of in the worst allowed world, upwards from `lowest`
  /// everywhere; and the action that earns it.
  void raise_lower_bound(std::vector<double>& lower, std::vector<Action>& policy, double lowest,
                         double least) const;

 private:
  struct Edge {
    State next = the_end;
    double low = 0.0, high = 1.0;    // probability
    double least = 0.0, most = 0.0;  // reward
  };

  void add_row(const CountedModel& model, std::uint64_t pair, const ListedSuccessors& listed,
               double level);
  double expected(std::uint64_t pair, const std::vector<double>& value, double extreme,
                  bool best) const;

  const std::vector<std::uint64_t>& begin_;
  RewardRange rewards_;
  double discount_;
  std::vector<std::uint64_t> row_;  // per pair: its first edge, and the end
  std::vector<Edge> edges_;
  std::vector<double> slack_;  // per pair: of its mean reward
  bool listed_;
};

}  // namespace quoll
