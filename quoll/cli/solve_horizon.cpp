// quoll solve WORLD --horizon N: the best in N steps.

#include <fmt/format.h>

#include "quoll/base/text.hpp"
#include "quoll/cli/solve_task.hpp"
#include "quoll/solve/finite_horizon.hpp"

namespace quoll::cli {
namespace {

constexpr std::string_view method = "backward-induction";

struct HorizonAnswer {
  const SolveTask& task;
  std::uint64_t steps;
  HorizonSolution solution;
  double seconds;

  Interval start() const { return start_value(task.mdp, solution.lower, solution.upper); }
  bool converged() const {
    return solution.steps == steps &&
           solution.gap <= wanted_width(task.tolerance, task.tolerance_given, 1e-12, solution.lower,
                                        solution.upper);
  }
};

std::string horizon_json(const HorizonAnswer& answer, bool all) {
  const Mdp& mdp = answer.task.mdp;
  const HorizonSolution& solution = answer.solution;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  write_task(json, answer.task, solution.discount, method);
  json.member("horizon", answer.steps).member("sweeps", solution.sweeps);
  json.member("seconds", answer.seconds).member("seconds_load", answer.task.seconds_load);
  write_interval(json, "start", answer.start());
  json.member("gap", solution.gap).member("converged", answer.converged());
  json.member("settled", solution.settled);
  json.rows("values", mdp.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", mdp.state_name(s));
    json.member("lower", solution.lower[s]).member("upper", solution.upper[s]);
    write_action(json, "action", mdp, s, solution.policy[s]);
    json.end_object();
  });
  json.rows("changes", solution.changes.size(), all, [&](std::uint64_t i) {
    const PolicyChange& change = solution.changes[i];
    json.begin_object().member("step", change.step);
    json.member("state", mdp.state_name(change.state));
    write_action(json, "action", mdp, change.state, change.action);
    json.end_object();
  });
  json.end_object();
  return json.text() + "\n";
}

std::string policy_text(const HorizonAnswer& answer) {
  const HorizonSolution& solution = answer.solution;
  if (solution.action_changes == 0) return "the policy is the same at every step\n";
  const std::string settled =
      solution.settled == answer.steps
          ? "the policy differs from step to step"
          : fmt::format("the policy is the same while {} or more steps are left, then differs",
                        grouped(solution.settled));
  return fmt::format("{}: {} change{} of a state's move, at {} of the steps; --json has them\n",
                     settled, grouped(solution.action_changes),
                     solution.action_changes == 1 ? "" : "s", grouped(solution.changing_steps));
}

std::string horizon_text(const HorizonAnswer& answer, bool all) {
  const SolveTask& task = answer.task;
  const HorizonSolution& solution = answer.solution;
  std::string text = fmt::format("solve {}   {}, discount {}, {}, {} step{}, method {}\n\n",
                                 task.world.name, sizes_text(task.mdp), shortest(solution.discount),
                                 task.minimise ? "least cost" : "largest reward",
                                 grouped(answer.steps), answer.steps == 1 ? "" : "s", method);
  const auto grid = grid_page(task.mdp, solution.lower, solution.policy, stdout_style(), all);
  if (grid) {
    text += *grid;
  } else {
    ValueTableView view;
    view.mdp = &task.mdp;
    view.lower = solution.lower;
    view.upper = solution.upper;
    view.title = "value";
    view.policy = solution.policy;
    view.states = all ? 0 : few_states;
    text += value_table(view) + "\n";
  }
  text += "start value " + interval_text(answer.start());
  if (solution.steps == answer.steps) {
    text += ", certified: no state of this policy loses more than " + number_text(solution.gap);
    if (!answer.converged()) text += fmt::format(" (--tolerance {})", number_text(task.tolerance));
    text += "\nabove: values and moves at the first step\n";
    text += policy_text(answer);
  } else {
    text += fmt::format(": stopped after {} of the steps\n", grouped(solution.steps));
  }
  return text + fmt::format("{} sweep{} in {} (loaded in {})\n", grouped(solution.sweeps),
                            solution.sweeps == 1 ? "" : "s", time_text(answer.seconds),
                            time_text(task.seconds_load));
}

}  // namespace

Exit solve_horizon(const SolveTask& task, std::uint64_t steps) {
  if (const Result<void> fits = check_method(task, "--horizon", method); !fits) {
    return fail(fits.error());
  }
  HorizonSettings settings;
  settings.steps = steps;
  if (task.discount > 0.0) settings.discount = task.discount;
  settings.maximise = !task.minimise;
  settings.threads = task.threads;
  settings.keep_policy = task.output.json || !task.output.file.empty();
  ProgressDisplay display(task.output.quiet);
  settings.keep_going = show_sweeps(display, steps, false);
  const Stopwatch work;
  Result<HorizonSolution> solution = quoll::solve_horizon(task.mdp, settings);
  const double seconds = work.seconds();
  if (!solution) return fail(solution.error());
  release_interrupts();
  const HorizonAnswer answer{task, steps, std::move(*solution), seconds};
  if (!task.output.file.empty()) {
    const Result<void> written =
        write_output(task.output.file, horizon_json(answer, true), {task.input});
    if (!written) return fail(written.error());
  }
  const bool all = task.output.all;
  if (!print(task.output.json ? horizon_json(answer, all) : horizon_text(answer, all))) {
    return user_error;
  }
  return answer.converged() ? done : goal_missed;
}

}  // namespace quoll::cli
