// quoll distil RUN|WORLD: a network that is fitted to a table of Q, and judged.

#include "quoll/cli/distil.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/judged_run.hpp"
#include "quoll/cli/learn_files.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/learn/deep/distil.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll::cli {
namespace {

constexpr std::uint64_t most_updates = 20'000;  // where nobody says

struct DistilOptions {
  WorldOption world;  // or a run
  OutputOption output;
  GivenSettings given;
  std::string steps, share;

  bool of_run() const { return run_file(world.name).ends_with(".quoll"); }
};

// What of the settings of learning a fit has.
std::vector<Setting> settings_of_fit(RunSettings& settings) {
  constexpr std::string_view names[] = {
      "layout", "hidden",    "activation",    "layer_norm",        "initial_weights",
      "inputs", "optimiser", "learning_rate", "optimiser_epsilon", "gradient_decay",
      "loss",   "batch",     "discount",      "clip_gradient",     "seed",
      "seeds"};
  std::vector<Setting> list;
  for (const Setting& setting : settings_of(settings)) {
    if (std::find(std::begin(names), std::end(names), setting.name) != std::end(names)) {
      list.push_back(setting);
    }
  }
  return list;
}

Result<Lesson> table_of_run(const std::string& file, const std::string& given_discount) {
  const Result<Run> run = Run::load(file, false);
  if (!run) return run.error();
  const auto refuse = [&](std::string why) { return Error{file, 0, 0, std::move(why), ""}; };
  if (const std::string reason = unsound(*run); !reason.empty()) return refuse(reason);
  if (run->entry().traits.networks) {
    return refuse(run->settings().learn.method +
                  " learned a network; a table is distilled, of methods that keep one");
  }
  if (const std::string reason = no_table(*run); !reason.empty()) return refuse(reason);
  if (!given_discount.empty()) {
    return Error{"--discount", 0, 0, "a run has its own", ""};
  }
  const Training& first = run->trainings().front();
  Lesson lesson{run->world(), run->source(), run->discount(), first.learner().estimates(), ""};
  lesson.origin = fmt::format("the table of {}, seed {}, {}", rule_words(run->entry()),
                              first.seed(), counted(first.learner().progress().steps, "step"));
  const std::vector<std::uint32_t>& visits = lesson.table.visits;
  if (std::all_of(visits.begin(), visits.end(), [](std::uint32_t n) { return n == 0; })) {
    return refuse("nothing was learned yet: its table has no visited pair");
  }
  return lesson;
}

// Q* of every move, solved here. A value that does not exist is not taught.
Result<Lesson> solved_table(const DistilOptions& options, double discount) {
  const Result<WorldSource> source = options.world.source();
  if (!source) return source.error();
  const Result<World> world = options.world.open(options.given);
  if (!world) return world.error();
  if (!world->mdp) {
    return Error{"distil", 0, 0,
                 "the model of " + world->name +
                     " is not known, so there is no exact table; learn one with -o FOLDER, and "
                     "distil that folder",
                 ""};
  }
  const Mdp& mdp = *world->mdp;
  SolveSettings settings;
  settings.discount = discount > 0.0 ? discount : world->discount;
  settings.width = 1e-9;
  settings.keep_going = [](const SolveProgress&) { return !interrupted(); };
  const Result<Solution> exact = solve(mdp, settings);
  if (!exact) return exact.error();
  Lesson lesson{*world, *source, exact->discount, {}, "Q* by " + exact->method};
  std::vector<double> value(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    const double lower = exact->lower[s], upper = exact->upper[s];
    value[s] = lower == upper ? lower : lower + (upper - lower) / 2;
  }
  lesson.table.row_begin = mdp.arrays().choice_begin;
  lesson.table.single_precision = false;
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const double q = q_star(mdp, value, c, exact->discount);
      const bool taught = std::isfinite(q) && !mdp.terminal(s);
      lesson.table.q.push_back(taught ? q : 0.0);
      lesson.table.visits.push_back(taught ? 1 : 0);
    }
  }
  return lesson;
}

struct Fit {
  RunSettings settings;
  double share = 1.0;
};

Result<Fit> fit_of(const DistilOptions& options) {
  Fit fit;
  RunSettings& settings = fit.settings;
  if (const Result<void> fits = options.given.check_discount(); !fits) return fits.error();
  const Result<void> applied = options.given.apply(settings_of_fit(settings));
  if (!applied) return applied.error();
  settings.evaluation_episodes = 0;
  settings.force = true;  // the table stands
  settings.steps = most_updates;
  settings.learn.until_stable = options.steps.empty();
  if (!options.steps.empty()) {
    const auto steps = parse_count(options.steps);
    if (!steps || *steps == 0) {
      return Error{"--steps", 0, 0,
                   "a whole number of at least 1 expected, not '" + options.steps + "'", ""};
    }
    settings.steps = *steps;
  }
  if (settings.learn.deep.learning_rate == "auto") {
    settings.learn.deep.learning_rate = fmt::format("0.003:0:{}", settings.steps);
  }
  if (!options.share.empty()) {
    const auto share = parse_number(options.share);
    if (!share || !(*share > 0.0 && *share <= 1.0)) {
      return Error{"--share", 0, 0, "a number in (0, 1] expected, not '" + options.share + "'", ""};
    }
    fit.share = *share;
  }
  return fit;
}

void advance(Run& run, const RunSettings& limits, bool quiet, RunFiles& files) {
  ProgressDisplay display(quiet, "updates");
  const std::uint64_t total = limits.steps * run.trainings().size();
  const auto keep_going = [&](const RunProgress& now) {
    display.show(now.steps, total, now.seconds, "");
    return !interrupted();
  };
  const Sink sink = [&](const Record& record) { files.record(record); };
  run.advance(limits, 0.0, keep_going, files.has_folder() ? sink : Sink());
}

// The goal is missed where the network does not agree and nobody said how many updates.
Exit exit_status(const Run& run) {
  const bool wanted = run.settings().learn.until_stable;
  for (const Training& training : run.trainings()) {
    const Stop stop = training.stop();
    if (stop != (wanted ? Stop::stable : Stop::steps)) return goal_missed;
  }
  return done;
}

Exit distil(const DistilOptions& options) {
  Result<Fit> fit = fit_of(options);
  if (!fit) return fail(fit.error());
  catch_interrupts();
  RunSettings& settings = fit->settings;
  const double discount = settings.learn.discount;
  const Result<Lesson> lesson =
      options.of_run() ? table_of_run(run_file(options.world.name), discount > 0.0 ? "given" : "")
                       : solved_table(options, discount);
  if (!lesson) return fail(lesson.error());
  settings.learn.discount = lesson->discount;
  settings.learn.deep.reward_scale = scale_of(lesson->table);
  Result<Run> run = Run::distil(settings, lesson->source, lesson->world, lesson->table, fit->share);
  if (!run) return fail(run.error());
  RunFiles files("", options.output.file, "");
  const Result<void> prepared = files.prepare(*run);
  if (!prepared) return fail(prepared.error());
  advance(*run, settings, options.output.quiet, files);
  const Result<Distilled> judged = judge_distilled(*run, *lesson);
  if (!judged) return fail(judged.error());
  const Result<void> written = files.write_folder(*run);
  if (!written) return fail(written.error());
  const Result<void> kept = files.write_result(*run, judged->result);
  if (!kept) return fail(kept.error());
  if (!print(options.output.json ? distilled_json(*judged) : distilled_text(*judged))) {
    return user_error;
  }
  return exit_status(*run);
}

}  // namespace

void declare_distil(Options& options) {
  auto given = std::make_shared<DistilOptions>();
  RunSettings defaults;
  options.word("run", given->world.name,
               "a saved run with a table, a file or folder; or a world, which is solved");
  options.option("--with", &given->world.with, "KEY=VALUE",
                 "a parameter of the world; may be repeated");
  given->given.declare_flags(options, settings_of_fit(defaults));
  options.option(
      "--steps", &given->steps, "whole number",
      "updates; without it until every greedy action is right and the mean error of Q is "
      "at most 2 % of the largest value, at most 20000");
  options.option("--share", &given->share, "number in (0, 1]",
                 "of the states, drawn by the seed, is taught; the others are judged apart [1]");
  options.flag("--json", &given->output.json, "print one JSON object on stdout");
  options.flag("--quiet", &given->output.quiet, "no progress on stderr");
  options.option("-o,--output", &given->output.file, "FOLDER",
                 "a folder for the network as a run, as learn writes it");
  options.run([given] { return distil(*given); });
}

}  // namespace quoll::cli
