#include "quoll/experiment/settings.hpp"

#include <cmath>

#include "quoll/base/text.hpp"

namespace quoll {

void RunSettings::describe(Describer& d) {
  learn.describe(d);
  d("seeds", seeds, 1, 1e6, "how many seeds to run, from --seed on");
  d("force", force, "learn although values without discount are not defined");
  d("evaluation_episodes", evaluation_episodes, 0, 1e9,
    "greedy episodes played at the end for the mean return");
}

void RunSettings::describe_limits(Describer& d) {
  d("steps", steps, "stop after so many steps in all; 0 = no limit");
  d("episodes", episodes, "stop after so many episodes in all; 0 = no limit");
  d("time", time, "stop after so much time, such as 10s, 2m or 500ms");
  d("until", until, "stop when a goal is reached: stable");
}

void RunSettings::persist(Archive& archive) {
  archive("learn", learn);
  archive("seeds", seeds);
  archive("force", force);
  archive("evaluation_episodes", evaluation_episodes);
}

Result<double> parse_duration(std::string_view text, std::string_view place) {
  const std::string_view word = trim(text);
  const std::size_t digits = word.find_first_not_of("0123456789.");
  const std::string_view unit = digits == std::string_view::npos ? "s" : word.substr(digits);
  const double scale = unit == "ms"  ? 1e-3
                       : unit == "s" ? 1
                       : unit == "m" ? 60
                       : unit == "h" ? 3600
                                     : 0;
  const auto number = parse_number(word.substr(0, digits));
  if (!number || !(*number > 0.0) || !std::isfinite(*number) || scale == 0.0) {
    return Error{
        std::string(place), 0, 0,
        "a duration such as 10s, 2m, 1h or 500ms expected, not '" + std::string(text) + "'", ""};
  }
  return *number * scale;
}

}  // namespace quoll
