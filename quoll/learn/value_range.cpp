#include "quoll/learn/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void widen(std::pair<double, double>& range, double reward) {
  range.first = std::min(range.first, reward);
  range.second = std::max(range.second, reward);
}

RewardRange of_model(const Mdp& mdp) {
  RewardRange range{{infinity, -infinity}, {infinity, -infinity}};
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        auto& kind = mdp.terminal(mdp.next(o)) ? range.last : range.running;
        widen(kind, mdp.reward(c, o));
        if (mdp.alternating()) widen(kind, -mdp.reward(c, o));
      }
    }
  }
  return range;
}

}  // namespace

Result<std::optional<RewardRange>> reward_range(const World& world, std::string_view given) {
  if (!given.empty()) {
    const std::vector<std::string_view> parts = split(given, ',');
    const auto low = parse_number(parts[0]);
    const auto high = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
    if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low <= *high) {
      return std::optional(RewardRange{{*low, *high}, {*low, *high}});
    }
    return Error{
        "--reward-range", 0, 0,
        "two numbers LOW,HIGH expected, LOW at most HIGH, not '" + std::string(given) + "'", ""};
  }
  if (world.mdp) return std::optional(of_model(*world.mdp));
  const auto& all = world.traits.reward_bounds;
  if (!all) return std::optional<RewardRange>();
  return std::optional(RewardRange{world.traits.running_rewards.value_or(*all), *all});
}

std::pair<double, double> value_range(const RewardRange& rewards, double discount) {
  // r / (1 - discount); at discount 1 no end of gains, and of losses.
  const auto for_ever = [&](double r) {
    if (discount < 1.0) return r / (1.0 - discount);
    return r > 0.0 ? infinity : r < 0.0 ? -infinity : 0.0;
  };
  double low = rewards.last.first, high = rewards.last.second;
  if (rewards.running.first <= rewards.running.second) {
    low = std::min(low, for_ever(rewards.running.first));
    high = std::max(high, for_ever(rewards.running.second));
  }
  return {low, high};
}

Result<void> finite_value_range(const World& world, const std::optional<RewardRange>& rewards,
                                double discount, std::string_view method, std::string_view place) {
  const std::string name(method);
  if (world.traits.players > 1) {
    return Error{std::string(place), 0, 0,
                 name + " is for worlds of one player; two move in " + world.name, ""};
  }
  if (!rewards) {
    return Error{"--reward-range", 0, 0,
                 name + " needs to know the smallest and largest reward, and " + world.name +
                     " does not declare them: LOW,HIGH expected",
                 ""};
  }
  if (std::isfinite(value_range(*rewards, discount).second)) return {};
  return Error{"--discount", 0, 0,
               name +
                   " needs a largest value, and at discount 1 rewards on the way have none: a "
                   "discount below 1 expected",
               ""};
}

}  // namespace quoll
