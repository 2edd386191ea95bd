#include "quoll/experiment/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quoll {

UniformPolicy uniform_policy_of(const World& world) {
  if (world.mdp) {
    std::vector<Action> counts(world.mdp->states());
    for (State s = 0; s < counts.size(); ++s) {
      counts[s] = world.mdp->terminal(s) ? 0 : world.mdp->actions(s);
    }
    const Action most = *std::max_element(counts.begin(), counts.end());
    return UniformPolicy(std::move(counts), most);
  }
  const std::unique_ptr<Environment> environment = world.make({});
  const Spaces spaces = environment->spaces();
  std::vector<Action> counts(spaces.states);
  for (State s = 0; s < spaces.states; ++s) counts[s] = environment->actions(s);
  return UniformPolicy(std::move(counts), spaces.actions);
}

std::uint64_t usual_cut(const World& world) {
  return world.episode_steps > 0 ? world.episode_steps
                                 : std::max<std::uint64_t>(2000, world.traits.states);
}

Played play(const World& world, const Policy& policy, std::uint64_t episodes, std::uint64_t seed,
            double discount, std::uint64_t episode_steps, const std::function<bool()>& keep_going) {
  Played played;
  const std::uint64_t streams_seed = stream(seed, "evaluation").next();
  const std::unique_ptr<Environment> environment =
      world.make({1, streams_seed, episode_steps, nullptr});
  State state = 0, next = 0;
  Action action = 0;
  Feedback feedback;
  const Spaces spaces = environment->spaces();
  std::vector<float> observation(spaces.observation), seen(observation.size());
  Experience now{{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, observation, seen};
  Rng behaviour = stream(seed, "behaviour");
  const std::uint8_t restart = 1;
  std::uint64_t steps = 0, ended = 0, unknown = 0;
  double sum = 0.0, discounted_sum = 0.0;
  for (; played.episodes < episodes; ++played.episodes) {
    if (keep_going && !keep_going()) break;
    environment->restart({&restart, 1}, now);
    double side = 1.0, factor = 1.0;  // of the reward, as the player who moved first sees it
    bool over = world.mdp && world.mdp->terminal(state), known = true;
    ended += over;
    for (std::uint64_t t = 0; t < episode_steps && !over; ++t) {
      policy.act(now, {&action, 1}, {&behaviour, 1});
      if (action == no_action) {
        known = false;
        break;
      }
      environment->step(now);
      ++steps;
      sum += side * feedback.reward;
      discounted_sum += factor * feedback.reward;
      factor *= feedback.turn_passes ? -discount : discount;
      side = feedback.turn_passes ? -side : side;
      state = next;
      observation = seen;
      over = feedback.terminated || feedback.truncated;
      ended += feedback.terminated;
    }
    unknown += !known;
  }
  if (played.episodes == 0) return played;
  const auto count = static_cast<double>(played.episodes);
  played.mean = sum / count;
  played.mean_discounted = discounted_sum / count;
  played.mean_steps = static_cast<double>(steps) / count;
  played.ended = static_cast<double>(ended) / count;
  played.unknown = static_cast<double>(unknown) / count;
  return played;
}

namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double quantile(std::span<const double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Statistics statistics(std::span<const double> values) {
  Statistics result;
  if (values.empty()) return result;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t quarter = sorted.size() / 4;
  result.mean = mean_of(sorted);
  result.median = quantile(sorted, 0.5);
  result.iqm = mean_of(std::span(sorted).subspan(quarter, sorted.size() - 2 * quarter));
  result.minimum = sorted.front();
  if (sorted.size() < 2) return result;
  constexpr std::size_t resamples = 2000;
  Rng rng = stream(1, "bootstrap");
  std::vector<double> means(resamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      sum += sorted[rng.below(static_cast<std::uint32_t>(sorted.size()))];
    }
    mean = sum / static_cast<double>(sorted.size());
  }
  std::sort(means.begin(), means.end());
  result.lower = quantile(means, 0.025);
  result.upper = quantile(means, 0.975);
  return result;
}

}  // namespace quoll
