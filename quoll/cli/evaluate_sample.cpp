#include "quoll/cli/evaluate_sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"

namespace quoll::cli {

Sampled sample(const World& world, const Policy& policy, const Plays& plays) {
  const std::uint64_t blocks = std::min<std::uint64_t>(plays.episodes, 1000);
  Sampled sampled;
  std::vector<double> means;
  for (std::uint64_t i = 0; i < blocks && !(i > 0 && interrupted()); ++i) {
    const std::uint64_t count = plays.episodes / blocks + (i < plays.episodes % blocks ? 1 : 0);
    const std::uint64_t seed = stream(plays.seed, "evaluated part", i).next();
    const Played part = play(world, policy, count, seed, plays.discount, plays.episode_steps);
    const auto weight = static_cast<double>(count);
    sampled.played.episodes += count;
    sampled.played.mean += weight * part.mean;
    sampled.played.mean_discounted += weight * part.mean_discounted;
    sampled.played.mean_steps += weight * part.mean_steps;
    sampled.played.ended += weight * part.ended;
    sampled.played.unknown += weight * part.unknown;
    means.push_back(part.mean);
  }
  const auto all = static_cast<double>(sampled.played.episodes);
  sampled.played.mean /= all;
  sampled.played.mean_discounted /= all;
  sampled.played.mean_steps /= all;
  sampled.played.ended /= all;
  sampled.played.unknown /= all;
  sampled.statistics = statistics(means);
  return sampled;
}

std::string unknown_text(const Played& played) {
  if (played.unknown == 0.0) return {};
  return fmt::format(
      "{:.0f} % of these episodes stopped where nothing was learned: the mean is of unfinished "
      "episodes\n",
      std::max(1.0, 100 * played.unknown));
}

void write_sampled(JsonWriter& json, const std::optional<Sampled>& sampled) {
  if (!sampled) {
    json.null_member("evaluation");
    return;
  }
  json.key("evaluation").begin_object();
  json.member("episodes", sampled->played.episodes).member("mean", sampled->played.mean);
  for (const auto& [key, bound] : {std::pair{"lower", sampled->statistics.lower},
                                   std::pair{"upper", sampled->statistics.upper}}) {
    if (bound)
      json.member(key, *bound);
    else
      json.null_member(key);
  }
  json.member("mean_discounted", sampled->played.mean_discounted);
  json.member("mean_steps", sampled->played.mean_steps);
  json.member("ended", sampled->played.ended);
  json.member("unknown", sampled->played.unknown).end_object();
}

std::string sampled_text(const Sampled& sampled) {
  const Played& played = sampled.played;
  std::string text = fmt::format("{} episodes: mean return {}", grouped(played.episodes),
                                 number_text(played.mean));
  if (sampled.statistics.lower) {
    text += fmt::format(" (95 % interval [{}, {}])", number_text(*sampled.statistics.lower),
                        number_text(*sampled.statistics.upper));
  }
  text += fmt::format(", discounted {}, {:.0f} % reach an end, {} steps on average\n",
                      number_text(played.mean_discounted), 100 * played.ended,
                      number_text(played.mean_steps));
  return text + unknown_text(played);
}

}  // namespace quoll::cli
