#include "quoll/experiment/heat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quoll/experiment/evaluation.hpp"

namespace quoll {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void summarise(EntrantResult& entrant, std::uint64_t cap_steps) {
  std::erase_if(entrant.heats, [](const Heat& heat) { return heat.end == HeatEnd::interrupted; });
  std::sort(entrant.heats.begin(), entrant.heats.end(),
            [](const Heat& one, const Heat& other) { return one.seed < other.seed; });
  std::vector<double> steps, seconds, each, bytes;
  entrant.failures = 0;
  for (const Heat& heat : entrant.heats) {
    const double cost = heat.steps > 0 ? heat.seconds / static_cast<double>(heat.steps) : nothing;
    const double most = static_cast<double>(cap_steps);
    entrant.failures += !heat.good();
    steps.push_back(heat.good() ? static_cast<double>(heat.steps) : most);
    seconds.push_back(heat.good() ? heat.seconds : std::max(heat.seconds, cost * most));
    each.push_back(cost);
    bytes.push_back(static_cast<double>(heat.bytes));
  }
  entrant.steps = quartiles(steps);
  entrant.seconds = quartiles(seconds);
  entrant.step_seconds = quartiles(each).median;
  entrant.bytes = bytes.empty() ? 0 : static_cast<std::uint64_t>(quartiles(bytes).median);
}

}  // namespace

Quartiles quartiles(std::span<const double> values) {
  std::vector<double> sorted;
  for (const double value : values) {
    if (!std::isnan(value)) sorted.push_back(value);
  }
  if (sorted.empty()) return {nothing, nothing, nothing};
  std::sort(sorted.begin(), sorted.end());
  return {quantile(sorted, 0.25), quantile(sorted, 0.5), quantile(sorted, 0.75)};
}

bool retired(std::span<const Heat> heats) {
  return heats.size() >= trial_seeds &&
         std::none_of(heats.begin(), heats.end(), [](const Heat& heat) { return heat.good(); });
}

void summarise(RaceResult& race) {
  for (EntrantResult& entrant : race.entrants) summarise(entrant, race.cap_steps);
  for (EntrantResult& entrant : race.entrants) {
    const EntrantResult& yardstick = race.entrants.front();
    entrant.fewer_steps = yardstick.steps.median / entrant.steps.median;
    entrant.fewer_seconds = yardstick.seconds.median / entrant.seconds.median;
  }
}

double geometric_mean(std::span<const double> values) {
  if (values.empty()) return nothing;
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace quoll
