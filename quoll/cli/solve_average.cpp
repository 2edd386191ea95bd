// quoll solve WORLD --average: the best average reward per step over endless time.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/cli/solve_task.hpp"
#include "quoll/solve/average_reward.hpp"

namespace quoll::cli {
namespace {

constexpr std::string_view method = average_method;

struct AverageAnswer {
  const SolveTask& task;
  AverageSolution solution;
  double seconds;

  Interval start() const { return start_value(task.mdp, solution.lower, solution.upper); }
  // Around 0, what rounding leaves of it is shown as 0.
  std::string text(Interval gain) const {
    const auto [low, high] = task.mdp.reward_bounds();
    const double noise = 1e-12 * std::max(std::fabs(low), std::fabs(high));
    if (std::fabs(gain.lower) <= noise && std::fabs(gain.upper) <= noise) return "0";
    return interval_text(gain);
  }
  bool multichain() const { return solution.structure == ChainStructure::multichain; }
};

std::string_view structure_name(ChainStructure structure) {
  switch (structure) {
    case ChainStructure::unichain:
      return "unichain";
    case ChainStructure::communicating:
      return "communicating";
    case ChainStructure::weakly_communicating:
      return "weakly communicating";
    case ChainStructure::multichain:
      return "multichain";
  }
  return "";
}

std::string average_json(const AverageAnswer& answer, bool all) {
  const Mdp& mdp = answer.task.mdp;
  const AverageSolution& solution = answer.solution;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  write_task(json, answer.task, std::nullopt, method);
  json.member("structure", structure_name(solution.structure)).member("sweeps", solution.sweeps);
  json.member("seconds", answer.seconds).member("seconds_load", answer.task.seconds_load);
  write_interval(json, "gain", answer.start());
  json.member("gap", solution.gap).member("converged", solution.converged);
  json.rows("classes", solution.classes.size(), all, [&](std::uint64_t i) {
    const StayingClass& one = solution.classes[i];
    json.begin_object().member("class", i).member("states", one.states);
    json.member("first", mdp.state_name(one.first)).member("ends", one.ends);
    json.member("lower", one.lower).member("upper", one.upper).member("stays", one.stays);
    json.end_object();
  });
  json.rows("values", mdp.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", mdp.state_name(s));
    json.member("lower", solution.lower[s]).member("upper", solution.upper[s]);
    json.member("bias", solution.bias[s]).key("class");
    if (solution.part[s] == no_component) {
      json.null();
    } else {
      json.value(solution.part[s]);
    }
    write_action(json, "action", mdp, s, solution.policy[s]);
    json.end_object();
  });
  json.end_object();
  return json.text() + "\n";
}

std::string move_name(const Mdp& mdp, State s, Action a) {
  return a == no_action ? "(end)" : mdp.action_name(mdp.choice_begin(s) + a);
}

// State, gain and class where they differ, bias, move.
std::string state_table(const AverageAnswer& answer, bool all) {
  const Mdp& mdp = answer.task.mdp;
  const AverageSolution& solution = answer.solution;
  const std::uint64_t shown = all ? mdp.states() : std::min(few_states, mdp.states());
  const bool many = answer.multichain();
  using Align = TextTable::Align;
  std::vector<TextTable::Column> columns{{"state"}};
  if (many) {
    columns.push_back({"gain", Align::point});
    columns.push_back({"class", Align::right});
  }
  columns.push_back({"bias", Align::point});
  columns.push_back({"best move"});
  TextTable table(std::move(columns));
  for (State s = 0; s < shown; ++s) {
    std::vector<std::string> row{mdp.state_name(s)};
    const double doubt = 10.0 * solution.gap;  // what is smaller than it is noise around 0
    if (many) {
      row.push_back(answer.text({solution.lower[s], solution.upper[s]}));
      const std::uint32_t k = solution.part[s];
      row.push_back(k == no_component ? "-" : std::to_string(k));
    }
    const double bias = solution.bias[s];
    row.push_back(std::isnan(bias) ? "-" : number_text(std::fabs(bias) <= doubt ? 0.0 : bias));
    row.push_back(move_name(mdp, s, solution.policy[s]));
    table.row(std::move(row));
  }
  std::string text = table.text();
  if (shown < mdp.states()) {
    text += fmt::format("... and {} more states (use --json --all or -o FILE)\n",
                        grouped(mdp.states() - shown));
  }
  return text + "\n";
}

// "A, B and 3 more".
std::string members(const AverageAnswer& answer, std::uint32_t k) {
  constexpr std::uint64_t named = 5;
  const StayingClass& one = answer.solution.classes[k];
  std::string text;
  std::uint64_t count = 0;
  for (State s = one.first; s < answer.task.mdp.states() && count < named; ++s) {
    if (answer.solution.part[s] != k) continue;
    text += (count == 0 ? "" : ", ") + answer.task.mdp.state_name(s);
    ++count;
  }
  if (one.states > count) text += fmt::format(" and {} more", grouped(one.states - count));
  return text;
}

std::string class_lines(const AverageAnswer& answer, bool all) {
  const auto& classes = answer.solution.classes;
  const std::size_t shown =
      all ? classes.size() : std::min<std::size_t>(few_states, classes.size());
  std::string text =
      fmt::format("multichain: {} classes in which one can stay for ever\n", classes.size());
  for (std::uint32_t k = 0; k < shown; ++k) {
    text += fmt::format("  class {}: {}{}: gain {}{}\n", k, classes[k].ends ? "the ends, " : "",
                        members(answer, k), answer.text({classes[k].lower, classes[k].upper}),
                        classes[k].stays ? "" : ", left by the best policy");
  }
  if (shown < classes.size()) text += fmt::format("  ... and {} more\n", classes.size() - shown);
  if (classes.back().ends) {
    text +=
        "what is earned before an end does not count in endless time; without --average it does\n";
  }
  return text;
}

std::string structure_text(const AverageAnswer& answer, bool all) {
  const AverageSolution& solution = answer.solution;
  switch (solution.structure) {
    case ChainStructure::unichain:
      return solution.classes[0].ends
                 ? "every policy comes to an end, where nothing is earned for ever: the average is "
                   "0, the bias is the reward until then\n"
                 : "unichain: every policy ends up in one class, the gain is that of every start\n";
    case ChainStructure::communicating:
      return "communicating: one can go from each state to each, the gain is that of every start\n";
    case ChainStructure::weakly_communicating:
      return "weakly communicating: one class to stay in, the gain is that of every start\n";
    case ChainStructure::multichain:
      break;
  }
  return class_lines(answer, all);
}

std::string average_text(const AverageAnswer& answer, bool all) {
  const SolveTask& task = answer.task;
  const AverageSolution& solution = answer.solution;
  std::string text =
      fmt::format("solve {}   {}, average over endless time, {}, method {}\n\n", task.world.name,
                  sizes_text(task.mdp), task.minimise ? "least cost" : "largest reward", method);
  const auto grid = grid_page(task.mdp, solution.bias, solution.policy, stdout_style(), all);
  text += grid ? *grid : state_table(answer, all);
  text += "gain " + answer.text(answer.start()) + " per step";
  text += solution.converged ? ", certified: this policy loses no more than "
                             : ", not as close as asked: this policy may lose up to ";
  text += number_text(solution.gap);
  if (!solution.converged) text += fmt::format(" (--tolerance {})", number_text(task.tolerance));
  text += "\n" + structure_text(answer, all);
  return text + fmt::format("{} sweep{} in {} (loaded in {})\n", grouped(solution.sweeps),
                            solution.sweeps == 1 ? "" : "s", time_text(answer.seconds),
                            time_text(task.seconds_load));
}

}  // namespace

Exit solve_average(const SolveTask& task) {
  if (const Result<void> fits = check_method(task, "--average", method); !fits) {
    return fail(fits.error());
  }
  if (task.discount > 0.0) {
    return fail({"--discount", 0, 0, "an average over endless time has no discount", ""});
  }
  SolveSettings settings;
  settings.width = task.tolerance;
  settings.maximise = !task.minimise;
  settings.threads = task.threads;
  ProgressDisplay display(task.output.quiet, "sweeps");
  settings.keep_going = show_sweeps(display, 0, true);
  const Stopwatch work;
  Result<AverageSolution> solution = quoll::solve_average(task.mdp, settings);
  const double seconds = work.seconds();
  release_interrupts();
  if (!solution) return fail(solution.error());
  solution->converged =
      solution->completed && solution->gap <= wanted_width(task.tolerance, task.tolerance_given,
                                                           1e-12, solution->lower, solution->upper);
  const AverageAnswer answer{task, std::move(*solution), seconds};
  if (!task.output.file.empty()) {
    const Result<void> written =
        write_output(task.output.file, average_json(answer, true), {task.input});
    if (!written) return fail(written.error());
  }
  const bool all = task.output.all;
  if (!print(task.output.json ? average_json(answer, all) : average_text(answer, all))) {
    return user_error;
  }
  return answer.solution.converged ? done : goal_missed;
}

}  // namespace quoll::cli
