// quoll evaluate WORLD --policy FILE|uniform: what a policy is worth, state by state.

#include "quoll/solve/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/evaluate_sample.hpp"
#include "quoll/cli/exact.hpp"
#include "quoll/cli/explored.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/experiment/evaluation.hpp"

namespace quoll::cli {
namespace {

/// What can be asked of an evaluation.
struct EvaluationSettings {
  double discount = 0.0;
  double tolerance = 1e-9;
  std::uint64_t episodes = 0;
  std::uint64_t seed = 1;
  std::uint64_t episode_steps = 0;

  void describe(Describer& d) {
    d("discount", discount, 0, 1, "discount factor of the future; 0 = the world's own");
    d("tolerance", tolerance, 0, 1e300,
      "largest upper - lower over all states; if not given, also 1e-11 of the largest value will "
      "do");
    d("episodes", episodes, 0, 1e9, "also play so many episodes");
    d("seed", seed, "which random numbers the episodes take");
    d("episode_steps", episode_steps,
      "steps after which an episode is cut off; 0 = the world's limit, or 2,000 or one per state");
  }
};

struct EvaluateOptions {
  WorldOption world;
  ExploreOption explore;
  OutputOption output;
  GivenSettings given;
  std::string policy;
};

struct Evaluated {
  const World& world;
  const Mdp& mdp;
  std::string policy;
  std::vector<Action> actions;  ///< empty for the uniform policy
  double discount = 1.0;
  double tolerance = 0.0;  ///< the width the answer is held to
  Evaluation value;
  double seconds = 0.0;
  std::optional<Sampled> sampled;

  Interval start() const { return start_value(mdp, value.lower, value.upper); }
  Action action(State s) const { return actions.empty() ? no_action : actions[s]; }
  double width() const {
    double largest = 0.0;
    for (State s = 0; s < mdp.states(); ++s) {
      if (value.lower[s] != value.upper[s]) {
        largest = std::max(largest, value.upper[s] - value.lower[s]);
      }
    }
    return largest;
  }
};

/// The steps after which an episode is cut off, if nobody says.
std::uint64_t cut_of(const World& world, const EvaluationSettings& asked) {
  if (asked.episode_steps > 0) return asked.episode_steps;
  return usual_cut(world);
}

std::string evaluate_json(const Evaluated& of, bool all) {
  JsonWriter json(JsonStyle::pretty);
  json.begin_object();
  json.member("world", of.world.name).member("policy", of.policy);
  json.member("states", of.mdp.states()).member("discount", of.discount);
  json.member("seconds", of.seconds);
  write_interval(json, "start", of.start());
  json.member("width", of.width()).member("converged", of.value.converged);
  json.rows("values", of.mdp.states(), all, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", of.mdp.state_name(s));
    json.member("lower", of.value.lower[s]).member("upper", of.value.upper[s]);
    write_action(json, "action", of.mdp, s, of.action(s));
    json.end_object();
  });
  write_sampled(json, of.sampled);
  json.end_object();
  return json.text() + "\n";
}

/// V of the policy per state, as an interval where its bounds differ in print.
std::string value_lines(const Evaluated& of, bool all) {
  constexpr std::uint64_t few_states = 20;
  const std::uint64_t shown = all ? of.mdp.states() : std::min(few_states, of.mdp.states());
  bool interval = false;
  for (State s = 0; s < shown; ++s) {
    interval = interval || number_text(of.value.lower[s]) != number_text(of.value.upper[s]);
  }
  using Align = TextTable::Align;
  std::vector<TextTable::Column> columns{{"state"}, {interval ? "V from" : "V", Align::point}};
  if (interval) columns.push_back({"to", Align::point});
  columns.push_back({"move"});
  TextTable table(std::move(columns));
  for (State s = 0; s < shown; ++s) {
    std::vector<std::string> row{of.mdp.state_name(s), number_text(of.value.lower[s])};
    if (interval) row.push_back(number_text(of.value.upper[s]));
    const Action a = of.action(s);
    row.push_back(of.mdp.terminal(s)   ? "(end)"
                  : of.actions.empty() ? "any"
                  : a == no_action     ? "(none known)"
                                       : of.mdp.action_name(of.mdp.choice_begin(s) + a));
    table.row(std::move(row));
  }
  std::string text = table.text();
  if (shown < of.mdp.states()) {
    text += fmt::format("... and {} more states (use --json --all or -o FILE)\n",
                        grouped(of.mdp.states() - shown));
  }
  return text;
}

/// Why the answer is not as close as asked.
std::string missed(const Evaluated& of) {
  if (std::isfinite(of.value.gap)) {
    return fmt::format("not as close as asked: --tolerance is {}\n", number_text(of.tolerance));
  }
  State s = 0;
  while (s < of.mdp.states() &&
         !(of.value.lower[s] == -INFINITY && of.value.upper[s] == INFINITY)) {
    ++s;
  }
  const std::string from = s < of.mdp.states() ? " from " + of.mdp.state_name(s) : "";
  if (interrupted()) return "not decided: stopped before anything was certain\n";
  return "not decided: the value" + from +
         " could not be bounded on both sides: episodes may never end and gain and lose on the "
         "way, or end "
         "after too many moves to tell; a discount below 1 makes the values finite\n";
}

std::string evaluate_text(const Evaluated& of, bool all) {
  std::string text =
      fmt::format("evaluate {}   policy {}, {} states, discount {}\n\n", of.world.name, of.policy,
                  grouped(of.mdp.states()), shortest(of.discount));
  text += value_lines(of, all) + "\n";
  const Interval start = of.start();
  text += "start value ";
  if (number_text(start.lower) == number_text(start.upper))
    text += number_text(start.lower);
  else
    text += fmt::format("in [{}, {}]", number_text(start.lower), number_text(start.upper));
  text += fmt::format(", every interval at most {} wide\n", number_text(of.width()));
  std::uint64_t unknown = 0;
  for (State s = 0; s < of.actions.size(); ++s) {
    unknown += !of.mdp.terminal(s) && of.actions[s] == no_action;
  }
  if (unknown > 0) {
    text += fmt::format("{} states have no action in this policy: anything may happen there\n",
                        grouped(unknown));
  } else if (!of.value.converged) {
    text += missed(of);
  }
  return of.sampled ? text + sampled_text(*of.sampled) : text;
}

Result<Evaluated> evaluated(const EvaluateOptions& options, const EvaluationSettings& asked,
                            const World& world) {
  const Mdp& mdp = *world.mdp;
  Evaluated of{world, mdp, options.policy, {}, world.discount, 0.0, {}, 0.0, {}};
  if (asked.discount > 0.0) of.discount = asked.discount;
  if (options.policy != "uniform") {
    Result<std::vector<Action>> actions = read_policy(options.policy, world);
    if (!actions) return actions.error();
    of.actions = std::move(*actions);
  }
  const auto begun = std::chrono::steady_clock::now();
  ProgressDisplay display(options.output.quiet, "sweeps");
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  const KeepGoing keep_going = [&](const SolveProgress& now) {
    if (now.sweeps > 0) {
      display.show(now.sweeps, 0, seconds(), "gap " + number_text(now.gap));
    } else {
      display.show(now.backups, mdp.states(), seconds(), "states eliminated");
    }
    return !interrupted();
  };
  Result<Evaluation> value =
      options.policy == "uniform"
          ? quoll::evaluate(mdp, uniform_policy(mdp), of.discount, asked.tolerance, keep_going)
          : quoll::evaluate(mdp, std::span<const Action>(of.actions), of.discount, asked.tolerance,
                            keep_going);
  if (!value) return value.error();
  of.value = std::move(*value);
  const bool given =
      asked_for(options.given, "tolerance") || asked.tolerance != EvaluationSettings().tolerance;
  of.tolerance = wanted_width(asked.tolerance, given, 1e-11, of.value.lower, of.value.upper);
  of.value.converged = of.value.gap <= of.tolerance;
  of.seconds = seconds();
  if (asked.episodes > 0) {
    const Plays plays{asked.episodes, asked.seed, of.discount, cut_of(world, asked)};
    of.sampled = of.actions.empty() ? sample(world, uniform_policy_of(world), plays)
                                    : sample(world, TablePolicy(of.actions), plays);
  }
  return of;
}

/// A world without a model: what the policy earned in episodes.
Exit evaluate_by_playing(const EvaluateOptions& options, const EvaluationSettings& asked,
                         const World& world) {
  constexpr std::uint64_t standard_episodes = 100;
  Result<std::unique_ptr<Policy>> policy =
      options.policy == "uniform"
          ? std::unique_ptr<Policy>(std::make_unique<UniformPolicy>(uniform_policy_of(world)))
          : read_acting(options.policy, world);
  if (!policy) return fail(policy.error());
  const Plays plays{asked.episodes > 0 ? asked.episodes : standard_episodes, asked.seed,
                    asked.discount > 0.0 ? asked.discount : world.discount, cut_of(world, asked)};
  const Sampled sampled = sample(world, **policy, plays);
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", world.name).member("policy", options.policy);
  json.null_member("states").member("discount", plays.discount).null_member("start");
  json.null_member("values");
  write_sampled(json, sampled);
  json.end_object();
  if (!options.output.file.empty()) {
    const Result<void> written =
        write_output(options.output.file, json.text() + "\n", {options.world.name, options.policy});
    if (!written) return fail(written.error());
  }
  const std::string text = fmt::format("evaluate {}   policy {}, no model: played, discount {}\n\n",
                                       world.name, options.policy, shortest(plays.discount)) +
                           sampled_text(sampled);
  return print(options.output.json ? json.text() + "\n" : text) ? done : user_error;
}

Exit evaluate(const EvaluateOptions& options) {
  EvaluationSettings asked;
  const Result<void> applied = options.given.apply(settings_of(asked));
  if (!applied) return fail(applied.error());
  Result<World> world = options.world.open(options.given);
  if (options.explore.given()) {
    const Result<WorldSource> source = options.world.source();
    if (!source) return fail(source.error());
    world = options.explore.with_model(std::move(world), *source, options.output.quiet);
  }
  if (!world) return fail(world.error());
  if (options.policy.empty()) {
    return fail(
        {"--policy", 0, 0, "uniform or a file that ends in .csv, .json or .quoll expected", ""});
  }
  catch_interrupts();
  if (!world->mdp) return evaluate_by_playing(options, asked, *world);
  const Result<Evaluated> of = evaluated(options, asked, *world);
  if (!of) return fail(of.error());
  if (!options.output.file.empty()) {
    const Result<void> written = write_output(options.output.file, evaluate_json(*of, true),
                                              {options.world.name, options.policy});
    if (!written) return fail(written.error());
  }
  const bool all = options.output.all;
  if (!print(options.output.json ? evaluate_json(*of, all) : evaluate_text(*of, all))) {
    return user_error;
  }
  return of->value.converged ? done : goal_missed;
}

}  // namespace

void declare_evaluate(Options& options) {
  auto given = std::make_shared<EvaluateOptions>();
  EvaluationSettings defaults;
  given->world.declare(options);
  given->explore.declare(options, false);
  options.option("--policy", &given->policy, "FILE|uniform",
                 "the policy: a .csv, .json or .quoll file, or uniform");
  given->given.declare_flags(options, settings_of(defaults));
  given->output.declare(options, "also write the JSON object, complete, to a file");
  options.run([given] { return evaluate(*given); });
}

}  // namespace quoll::cli
