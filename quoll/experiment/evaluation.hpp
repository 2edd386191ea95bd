#pragma once
// Greedy episodes of the final policy with their own random numbers, and honest statistics over
// seeds.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "quoll/act/policy.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

/// The uniform policy of a world, whatever it is made of.
UniformPolicy uniform_policy_of(const World& world);

/// What playing a policy gave. Where two players move in turn the policy plays both, and returns
/// are those of the one who moved first.
struct Played {
  std::uint64_t episodes = 0;
  double mean = 0.0;  ///< undiscounted return per episode
  double mean_discounted = 0.0;
  double mean_steps = 0.0;
  double ended = 0.0;    ///< share of episodes that reached an end before the cut
  double unknown = 0.0;  ///< share of episodes that stopped where the policy knows no action
};

/// The steps after which an episode of an evaluation is cut off, if nobody says: the world's own
/// limit, else enough to come once to every state.
std::uint64_t usual_cut(const World& world);

/// Plays `episodes` episodes from the world's own starts with the stream "evaluation" of `seed`,
/// each cut off after `episode_steps`. A state the policy knows nothing about ends the episode, and
/// is counted. Policies that draw take the stream "behaviour". Before each episode `keep_going` is
/// asked, if given; after a no the episodes so far are all.
Played play(const World& world, const Policy& policy, std::uint64_t episodes, std::uint64_t seed,
            double discount, std::uint64_t episode_steps,
            const std::function<bool()>& keep_going = {});

/// Over per-seed means: mean, median, interquartile mean, smallest, and the 95 % bootstrap interval
/// of the mean (2,000 resamples, fixed stream). Agarwal et al. 2021 ("Deep RL at the edge of the
/// statistical precipice"). The interval is absent for fewer than 2 seeds.
struct Statistics {
  double mean = 0.0, median = 0.0, iqm = 0.0, minimum = 0.0;
  std::optional<double> lower, upper;
};
Statistics statistics(std::span<const double> values);

/// The value at a share in [0, 1] of an ascending list that is not empty, linear between
/// neighbours.
double quantile(std::span<const double> sorted, double share);

}  // namespace quoll
