#include "quoll/experiment/settings.hpp"

#include <cmath>

#include "quoll/base/text.hpp"

namespace quoll {

void RunSettings::describe(Describer& d) {
  learn.describe(d);
  d("seeds", seeds, 1, 1e6, "how many seeds to run, from --seed on");
  d.choice("certify", certify, certify_names,
           "certified: the states asked about, where episodes begin or all");
  d.choice("successors", successors, successors_names,
           "certified: any state may follow a move, or only those that the world lists");
  d("confidence", confidence, 0.0, 1.0 - 1e-12,
    "certified: in noisy worlds, of all checks together");
  d("force", force, "learn although values without discount are not defined");
  d("evaluation_episodes", evaluation_episodes, 0, 1e9,
    "greedy episodes played at the end for the mean return");
}

void RunSettings::describe_limits(Describer& d) {
  d("steps", steps, "stop after so many steps in all; 0 = no limit");
  d("episodes", episodes, "stop after so many episodes in all; 0 = no limit");
  d("time", time, "stop after so much time, such as 10s, 2m or 500ms");
  d("until", until,
    "stop when a goal is reached: stable, certified:EPS or certified:EPS%, with ,model from the "
    "model, or return:R, the mean of the last 100 training episodes");
}

void RunSettings::persist(Archive& archive) {
  archive("learn", learn);
  archive("certified", certified);
  archive("by_model", by_model);
  archive("certify", certify);
  archive("successors", successors);
  archive("confidence", confidence);
  if (certify > CertifyScope::all || successors > Successors::listed ||
      !(confidence >= 0.0 && confidence < 1.0)) {
    archive.fail("an unknown choice for what is certified");
  }
  archive("seeds", seeds);
  archive("force", force);
  archive("evaluation_episodes", evaluation_episodes);
}

Result<void> take_certified(std::string_view until, RunSettings& settings) {
  constexpr std::string_view word = "certified:", model = ",model";
  std::string_view gap = until.substr(word.size());
  settings.by_model = gap.size() >= model.size() && gap.substr(gap.size() - model.size()) == model;
  if (settings.by_model) gap.remove_suffix(model.size());
  settings.certified = gap;
  const bool share = !gap.empty() && gap.back() == '%';
  if (share) gap.remove_suffix(1);
  const auto number = parse_number(gap);
  if (number && *number >= 0.0 && std::isfinite(*number)) return {};
  return Error{"--until", 0, 0,
               "a gap of at least 0 such as certified:0.1, certified:5% or certified:0.1,model "
               "expected, not '" +
                   std::string(until) + "'",
               ""};
}

namespace {
constexpr std::string_view return_word = "return:";
}

std::optional<double> RunSettings::mean_return() const {
  if (!until.starts_with(return_word)) return std::nullopt;
  return parse_number(std::string_view(until).substr(return_word.size()));
}

Result<void> check_until(std::string_view until) {
  if (until.empty() || until == "stable") return {};
  if (!until.starts_with(return_word)) {
    return Error{"--until", 0, 0,
                 "stable, return:R, certified:EPS or certified:EPS,model expected, not '" +
                     std::string(until) + "'",
                 nearest(std::string(until),
                         std::vector<std::string>{"stable", "certified:0.01", "return:100"})};
  }
  const auto number = parse_number(until.substr(return_word.size()));
  if (number && std::isfinite(*number)) return {};
  return Error{"--until", 0, 0,
               "a mean return such as return:475 expected, not '" + std::string(until) + "'", ""};
}

CertifyGoal certify_goal(const RunSettings& settings) {
  CertifyGoal goal;
  std::string_view gap = settings.certified;
  goal.relative = !gap.empty() && gap.back() == '%';
  if (goal.relative) gap.remove_suffix(1);
  goal.gap = parse_number(gap).value_or(0.0) * (goal.relative ? 0.01 : 1.0);
  goal.everywhere = settings.certify == CertifyScope::all;
  goal.listed = settings.successors == Successors::listed;
  goal.confidence = settings.confidence;
  return goal;
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
