#pragma once
// What a learner may know of values before its first step: the least and the most that any policy
// can earn, from the rewards a world declares. Nothing here looks at what leads where.

#include <optional>
#include <string_view>
#include <utility>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

/// Smallest and largest reward of the steps that go on, and of those that end an episode. A kind
/// that does not occur has first > second.
struct RewardRange {
  std::pair<double, double> running, last;

  double low() const { return std::min(running.first, last.first); }
  double high() const { return std::max(running.second, last.second); }
  double span() const { return high() - low(); }
};

/// As the world declares it, or as `given` ("LOW,HIGH") says; none where neither does. Where two
/// players move in turn what one loses the other gains. Error: two numbers expected.
Result<std::optional<RewardRange>> reward_range(const World& world, std::string_view given);

/// Bounds on every value at this discount: the value of k running rewards and a last one lies
/// between their two extremes, running / (1 - discount) and last. Infinite where unbounded.
std::pair<double, double> value_range(const RewardRange& rewards, double discount);

/// What methods that hope for the most need: a most, and one player. Error: says how to give it.
Result<void> finite_value_range(const World& world, const std::optional<RewardRange>& rewards,
                                double discount, std::string_view method,
                                std::string_view place = "--method");

}  // namespace quoll
