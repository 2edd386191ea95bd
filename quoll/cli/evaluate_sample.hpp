#pragma once
// What a policy earned in played episodes, with an interval for the mean.

#include <optional>
#include <string>

#include "quoll/base/json.hpp"
#include "quoll/experiment/evaluation.hpp"

namespace quoll::cli {

/// Which episodes to play.
struct Plays {
  std::uint64_t episodes = 0, seed = 1;
  double discount = 1.0;
  std::uint64_t episode_steps = 0;  ///< episodes are cut off after so many
};

/// Played episodes and an interval for their mean.
struct Sampled {
  Played played;
  Statistics statistics;
};

/// Plays in blocks with random numbers of their own; the interval is the bootstrap over blocks.
Sampled sample(const World& world, const Policy& policy, const Plays& plays);

/// The member "evaluation" of a JSON object; null without one.
void write_sampled(JsonWriter& json, const std::optional<Sampled>& sampled);
/// A line when episodes stopped in states that the policy knows nothing about, else nothing.
std::string unknown_text(const Played& played);
/// A line or two for people.
std::string sampled_text(const Sampled& sampled);

}  // namespace quoll::cli
