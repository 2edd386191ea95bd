#include "quoll/cli/solve_task.hpp"

#include <fmt/format.h>

#include "quoll/base/text.hpp"
#include "quoll/report/grid_text.hpp"
#include "quoll/report/progress.hpp"

namespace quoll::cli {

Exit solve_task(const SolveTask& task, std::uint64_t horizon, bool average) {
  if (average && horizon > 0) {
    return fail({"--horizon", 0, 0, "--average asks for endless time: give one of the two", ""});
  }
  const std::string flag = average ? "--average" : "--horizon";
  if (!task.proof.empty()) {
    return fail({std::string(task.proof), 0, 0, "cannot be had with " + flag, ""});
  }
  const std::string& file = task.output.file;
  if (file.ends_with(".csv") || file.ends_with(".yaml")) {
    return fail({"-o", 0, 0,
                 "with " + flag + " a name that ends in .json expected, not '" + file + "'", ""});
  }
  return average ? solve_average(task) : solve_horizon(task, horizon);
}

std::string time_text(double seconds) {
  return seconds < 1.0 ? fmt::format("{:.3g} ms", 1000 * seconds) : duration_text(seconds);
}

std::string interval_text(const Interval& interval) {
  if (interval.lower == interval.upper) return number_text(interval.lower);
  if (number_text(interval.lower) != number_text(interval.upper)) {
    return fmt::format("in [{}, {}]", number_text(interval.lower), number_text(interval.upper));
  }
  return number_text(interval.lower);
}

std::optional<std::string> grid_page(const Mdp& mdp, std::span<const double> value,
                                     std::span<const Action> policy, const TerminalStyle& style,
                                     bool all) {
  if (!mdp.layout() || mdp.states() <= few_states || all) return std::nullopt;
  const Result<std::string> grid = grid_policy_text({&mdp, value, policy, {}, ""}, style);
  if (!grid) return std::nullopt;
  return *grid + "\n";
}

std::string sizes_text(const Mdp& mdp) {
  return fmt::format(
      "{} states, {} choices, {}", grouped(mdp.states()), grouped(mdp.choices()),
      mdp.deterministic() ? "deterministic" : grouped(mdp.outcomes()) + " transitions");
}

Result<void> check_method(const SolveTask& task, std::string_view flag, std::string_view only) {
  if (task.method == "auto" || task.method == only) return {};
  return Error{"--method", 0, 0,
               fmt::format("{} is solved by {}, not by '{}'", flag, only, task.method),
               std::string(only)};
}

void write_task(JsonWriter& json, const SolveTask& task, std::optional<double> discount,
                std::string_view method) {
  json.member("world", task.world.name).member("states", task.mdp.states());
  json.member("choices", task.mdp.choices()).member("transitions", task.mdp.outcomes());
  if (discount) json.member("discount", *discount);
  json.member("objective", task.minimise ? "minimise" : "maximise").member("method", method);
}

std::function<bool(const SolveProgress&)> show_sweeps(ProgressDisplay& display, std::uint64_t total,
                                                      bool with_gap) {
  return [&display, total, with_gap, watch = Stopwatch()](const SolveProgress& now) {
    const std::string extra = with_gap ? "gap " + number_text(now.gap) : "";
    display.show(now.sweeps, total, watch.seconds(), extra);
    return !interrupted();
  };
}

}  // namespace quoll::cli
