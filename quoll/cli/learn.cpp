// quoll learn WORLD: learn by experience.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/initial_rewards.hpp"
#include "quoll/cli/learn_certificate.hpp"
#include "quoll/cli/learn_explain.hpp"
#include "quoll/cli/learn_files.hpp"
#include "quoll/cli/learn_log.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/policy_file.hpp"
#include "quoll/cli/same_world.hpp"
#include "quoll/cli/verbs.hpp"

namespace quoll::cli {
namespace {

struct LearnOptions {
  WorldOption world;
  OutputOption output;
  GivenSettings how;     // what a resumed run takes from its file
  GivenSettings limits;  // what may be given anew
  unsigned threads = 0;
  bool explain = false;
  std::string save, resume, save_every, certificate;
  std::vector<std::string> logs;

  std::string resume_file() const { return resume.empty() ? "" : run_file(resume); }
};

// What a setting comes to in this world: 0, -1 and auto stand for something.
std::string resolved_text(RunSettings settings, const World& world, const std::string& key) {
  const std::vector<Setting> list = settings_of(settings);
  const Setting& setting = *find(list, key);
  const Result<LearnSetup> setup = resolve(settings.learn, world);
  if (!setup) return text_of(setting);
  if (setting.name == "discount") return shortest(setup->discount);
  if (setting.name == "episode_steps") return std::to_string(setup->episode_steps);
  if (setting.name == "tolerance") return shortest(setup->stable.tolerance);
  if (setting.name == "step_size") return setup->step_size.text();
  if (setting.name == "explore") return std::string(setup->exploration.name());
  if (setting.name == "epsilon" && settings.learn.epsilon == "auto") {
    return std::string((*find_learner(settings.learn))->traits.epsilon);
  }
  return text_of(setting);
}

// A resumed run takes its settings from the file: anything else given must agree.
Result<void> same_settings(const LearnOptions& options, const Run& run) {
  RunSettings saved = run.settings();
  std::vector<Setting> settings = settings_of(saved);
  const auto given = options.how.given();
  if (!given) return given.error();
  for (const auto& [key, text] : *given) {
    const Setting* setting = find(settings, key);
    if (!setting) return options.how.apply(settings);  // names the nearest
    std::string flag = "--" + key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    const std::string as_saved = text_of(*setting);
    const std::string before = resolved_text(saved, run.world(), key);
    const Result<void> assigned = assign(*setting, text, flag);
    if (!assigned) return assigned;
    if (text_of(*setting) != as_saved && resolved_text(saved, run.world(), key) != before) {
      return Error{
          flag, 0, 0,
          "the saved run has " + before + ", not " + text + "; a resumed run keeps its settings",
          ""};
    }
  }
  if (!options.how.config.empty()) {
    return Error{"--config", 0, 0, "a resumed run keeps its settings", ""};
  }
  return {};
}

// The world of the command line is the run's, however it is spelled; its parameters may be left
// out.
Result<void> same_world(const LearnOptions& options, const Result<World>& given, const Run& run) {
  const Result<WorldSource> source = options.world.source();
  if (!source) return source.error();
  const auto& with = source->parameters;
  const bool same_name = source->name == run.source().name;
  if (same_name && (with.empty() || with == run.source().parameters)) return {};
  return given ? check_same_world(run, options.resume_file(), *given) : given.error();
}

Result<Run> resume(const LearnOptions& options, const RunSettings& limits, bool watch) {
  const bool named = !options.world.name.empty();
  const Result<World> given = named ? options.world.open() : Error{};
  Result<Run> run = Run::load(options.resume_file(), watch, given ? &*given : nullptr);
  if (!run) return run;
  if (run->entry().traits.taught) {
    return Error{options.resume_file(), 0, 0,
                 "a distilled network learns from its table only; quoll distil makes another", ""};
  }
  Result<void> same = same_settings(options, *run);
  if (same && named) same = same_world(options, given, *run);
  if (!same) return same.error();
  const RunSettings& saved = run->settings();
  if (!limits.certified.empty() &&
      (limits.certified != saved.certified || limits.by_model != saved.by_model)) {
    return Error{"--until", 0, 0,
                 saved.certified.empty()
                     ? "the saved run did not watch for a certificate; a resumed run keeps its goal"
                     : "the saved run has certified:" + saved.certified +
                           (saved.by_model ? ",model" : "") + "; a resumed run keeps its goal",
                 ""};
  }
  return run;
}

// Seconds between two savings; 0 = only at the end.
Result<double> save_pause(const LearnOptions& options) {
  if (options.save_every.empty()) return 0.0;
  const Result<double> seconds = parse_duration(options.save_every, "--save-every");
  if (seconds && options.save.empty() && options.output.file.empty()) {
    return Error{"--save-every", 0, 0, "needs --save FILE or -o FOLDER", ""};
  }
  return seconds;
}

Result<RunSettings> limits_of(const LearnOptions& options) {
  RunSettings limits;
  Describer list;
  limits.describe_limits(list);
  const Result<void> applied = options.limits.apply(list.settings());
  if (!applied) return applied.error();
  const bool certified = limits.until.rfind("certified:", 0) == 0;
  if (certified) {
    const Result<void> taken = take_certified(limits.until, limits);
    if (!taken) return taken.error();
  } else if (const Result<void> goal = check_until(limits.until); !goal) {
    return goal.error();
  }
  if (!limits.time.empty()) {
    const Result<double> seconds = parse_duration(limits.time, "--time");
    if (!seconds) return seconds.error();
  }
  return limits;
}

// Whether nothing was said about how to learn: then the world decides. Where no table can, it does
// as long as no method was named.
Result<bool> leaves_it_open(const LearnOptions& options, const World& world) {
  constexpr std::string_view no_method[] = {
      "discount",     "seed",    "seeds",      "force",      "precision",          "episode_steps",
      "reward_range", "certify", "successors", "confidence", "evaluation_episodes"};
  const auto given = options.how.given();
  if (!given) return given.error();
  const bool tables = world.traits.states > 0;
  return options.how.config.empty() &&
         std::all_of(given->begin(), given->end(), [&](const auto& one) {
           return (!tables && one.first != "method" && one.first != "rule") ||
                  std::find(std::begin(no_method), std::end(no_method), one.first) !=
                      std::end(no_method);
         });
}

Result<Run> open_run(const LearnOptions& options, const RunSettings& limits) {
  const bool watch = !limits.has_limit() || limits.until == "stable";
  const Result<void> fits = options.how.check_discount();
  if (!fits) return fits.error();
  if (!options.resume.empty()) return resume(options, limits, watch);
  RunSettings settings;
  const Result<void> applied = options.how.apply(settings_of(settings));
  if (!applied) return applied.error();
  settings.learn.until_stable = watch;
  settings.certified = limits.certified;
  settings.by_model = limits.by_model;
  const Result<WorldSource> source = options.world.source();
  if (!source) return source.error();
  const Result<World> world = options.world.open(options.how);
  if (!world) return world.error();
  if (world->mdp && gives(source->parameters, "seeding")) {
    return Error{"--with seeding", 0, 0,
                 "has no effect on learning: a world with a model is learned from its tables, with "
                 "this program's random numbers",
                 ""};
  }
  const Result<bool> open = leaves_it_open(options, *world);
  if (!open) return open.error();
  if (*open) settings.learn.method = "auto";
  const Result<std::vector<double>> rewards =
      initial_rewards(settings.learn.initial_rewards, *world);
  if (!rewards) return rewards.error();
  return Run::start(settings, *source, *world, *rewards);
}

// Learns, saving every so often, until done or interrupted. The result of the last saving: a disk
// that is full for a while ends no run.
Result<void> advance(Run& run, const LearnOptions& options, const RunSettings& limits, double pause,
                     RunFiles& files) {
  const Sink sink = [&](const Record& record) { files.record(record); };
  ProgressDisplay display(options.output.quiet);
  const std::size_t seeds = run.trainings().size();
  const std::uint64_t steps =
      !limits.has_limit() && run.entry().traits.approximates ? default_steps : limits.steps;
  const std::uint64_t total = steps * seeds;
  std::uint64_t resumed = 0;
  for (const Training& training : run.trainings()) resumed += training.learner().progress().steps;
  const auto begun = std::chrono::steady_clock::now();
  const auto keep_going = [&](const RunProgress& now) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
    std::string extra = now.mean_return ? "return " + number_text(*now.mean_return) : std::string();
    if (seeds > 1) extra += fmt::format("  {} of {} seeds", now.finished, seeds);
    display.show(now.steps, total, seconds.count(), extra, resumed);
    return !interrupted();
  };
  for (;;) {
    const bool finished =
        run.advance(limits, pause, keep_going, files.has_folder() ? sink : Sink());
    Result<void> saved = files.save(run);
    if (finished || interrupted()) return saved;
    if (saved) saved = files.write_folder(run);
    if (saved) saved = files.write_curves(run);
    if (!saved) fail(saved.error());
  }
}

Exit exit_status(const Run& run, const RunSettings& limits) {
  for (const Training& training : run.trainings()) {
    const Stop stop = training.stop();
    if (stop == Stop::diverged || stop == Stop::budget || stop == Stop::interrupted) {
      return goal_missed;
    }
    if (limits.until == "stable" && stop != Stop::stable) return goal_missed;
    if (!limits.certified.empty() && stop != Stop::certified) return goal_missed;
    if (limits.mean_return() && stop != Stop::reached) return goal_missed;
  }
  return done;
}

// Prints the result, and writes it where it is wanted.
Exit tell(const Run& run, const LearnOptions& options, const RunSettings& limits, Learner* twin,
          const ComingUpdates* coming, const RunFiles& files) {
  const Result<StandardBeside> beside = standard_beside(run, twin);
  if (!beside) return fail(beside.error());
  const LearnStory story{options.output.all,
                         limits.until == "stable",
                         limits.mean_return().has_value(),
                         limits.has_limit(),
                         coming,
                         &*beside};
  const RunResult result =
      run.result(true, [before = interrupts()] { return interrupts() == before; });
  const std::string text = options.output.json ? learn_json(run, result, story)
                                               : learn_text(run, result, stdout_style(), story);
  if (!print(text)) return user_error;
  const Result<void> kept = files.write_result(run, result);
  if (!kept) return fail(kept.error());
  const Exit ended = result.cut_short > 0 ? goal_missed : done;
  if (options.certificate.empty()) return ended;
  const Result<void> written = write_experience(options.certificate, run, result);
  return written ? ended : fail(written.error());
}

// A log is all the experience there is: what steers or keeps a run has no effect on it.
Result<void> only_logs(const LearnOptions& options) {
  const auto refuse = [](std::string flag) {
    std::replace(flag.begin(), flag.end(), '_', '-');
    return Error{"--" + flag, 0, 0,
                 "has no effect with --from-data: the steps are those of the log", ""};
  };
  if (options.explain) return refuse("explain");
  for (const auto& [flag, text] : {std::pair{"save", &options.save},
                                   {"resume", &options.resume},
                                   {"save-every", &options.save_every},
                                   {"certificate", &options.certificate},
                                   {"config", &options.how.config}}) {
    if (!text->empty()) return refuse(flag);
  }
  constexpr std::string_view taken[] = {"discount", "reward_range", "successors", "confidence"};
  for (const GivenSettings* given : {&options.how, &options.limits}) {
    const auto pairs = given->given();
    if (!pairs) return pairs.error();
    for (const auto& [key, text] : *pairs) {
      if (std::find(std::begin(taken), std::end(taken), key) == std::end(taken)) {
        return refuse(key);
      }
    }
  }
  return {};
}

Exit learn(const LearnOptions& options) {
  if (!options.logs.empty()) {
    const Result<void> fits = only_logs(options);
    return fits ? learn_log(options.world, options.output, options.how, options.logs)
                : fail(fits.error());
  }
  const bool found =
      !options.resume.empty() && options.world.with.empty() && !options.world.aimed();
  if (options.world.name.empty() && !found) {  // a saved run knows its world
    return fail({"learn", 0, 0,
                 "WORLD expected: a built-in world (see 'quoll list worlds') or a file", ""});
  }
  const Result<RunSettings> limits = limits_of(options);
  if (!limits) return fail(limits.error());
  const Result<double> pause = save_pause(options);
  if (!pause) return fail(pause.error());
  Result<Run> run = open_run(options, *limits);
  if (!run) return fail(options.how.placed(run.error()));
  if (const Result<void> fits = run->allows(*limits); !fits) return fail(fits.error());
  run->set_threads(options.threads);
  if (!options.certificate.empty()) {
    const Result<void> writable = may_write_experience(*run);
    if (!writable) return fail(writable.error());
  }
  const Result<std::unique_ptr<Learner>> twin = first_twin(*run);
  if (!twin) return fail(twin.error());
  std::optional<ComingUpdates> coming;
  if (options.explain) {
    Result<ComingUpdates> made = coming_updates(*run, *limits, options.output.all);
    if (!made) return fail(made.error());
    coming = std::move(*made);
  }
  RunFiles files(options.save, options.output.file, options.resume_file());
  const Result<void> prepared = files.prepare(*run);
  if (!prepared) return fail(prepared.error());
  if (coming && !options.output.json && !print(updates_text(*run, *coming))) return user_error;
  catch_interrupts();
  const Result<void> saved = advance(*run, options, *limits, *pause, files);
  const Result<void> written = files.write_folder(*run);
  const Exit told = tell(*run, options, *limits, twin->get(), coming ? &*coming : nullptr, files);
  if (!saved) return fail(saved.error());
  if (!written) return fail(written.error());
  if (told != done) return told;
  return exit_status(*run, *limits);
}

}  // namespace

void declare_learn(Options& options) {
  auto given = std::make_shared<LearnOptions>();
  RunSettings defaults;
  Describer how, limits;
  defaults.describe(how);
  defaults.describe_limits(limits);
  given->world.declare(options, false);
  for (Setting& setting : how.settings()) {
    if (setting.name != "discount") continue;
    setting.low = std::numeric_limits<double>::denorm_min();
    setting.sentence = "discount factor of the future, above 0; without it the world's own";
  }
  given->how.declare(options, how.settings());
  given->limits.declare_flags(options, limits.settings());
  options.option("--threads", &given->threads, "N",
                 "processors to use; 0 = all; changes no result");
  options.flag("--explain", &given->explain, "show each update with its numbers");
  options.option("--save", &given->save, "FILE", "write the run to a file when it ends");
  options.option("--save-every", &given->save_every, "TIME", "and every so often, such as 60s");
  options.option("--certificate", &given->certificate, "FILE",
                 "write what --until certified:EPS found, for verify");
  options.option("--resume", &given->resume, "FILE",
                 "go on with a saved run, a file or a run folder");
  options.option("--from-data", &given->logs, "LOG.csv",
                 "learn from steps that somebody took, with or without WORLD; may be repeated");
  given->output.declare(
      options,
      "a folder for settings.toml, records.csv, run.quoll, seeds.csv, curve.svg and "
      "TensorBoard's events; with --from-data a file .csv or .json for the policy");
  options.run([given] { return learn(*given); });
}

}  // namespace quoll::cli
