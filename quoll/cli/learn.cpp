// quoll learn WORLD: learn by experience.

#include <sys/stat.h>

#include <chrono>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/initial_rewards.hpp"
#include "quoll/cli/learn_explain.hpp"
#include "quoll/cli/learn_report.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/experiment/config.hpp"

namespace quoll::cli {
namespace {

struct LearnOptions {
  WorldOption world;
  OutputOption output;
  GivenSettings how;     // what a resumed run takes from its file
  GivenSettings limits;  // what may be given anew
  unsigned threads = 0;
  bool explain = false;
  std::string save, resume, save_every;
};

// A resumed run takes its settings from the file: anything else given must agree.
Result<void> agrees(const LearnOptions& options, const Run& run) {
  RunSettings saved = run.settings();
  std::vector<Setting> settings = settings_of(saved);
  const auto given = options.how.given();
  if (!given) return given.error();
  for (const auto& [key, text] : *given) {
    const Setting* setting = find(settings, key);
    if (!setting) return options.how.apply(settings);  // names the nearest
    const std::string before = text_of(*setting);
    const Result<void> assigned = assign(*setting, text, "--" + key);
    if (!assigned) return assigned;
    if (text_of(*setting) != before) {
      return Error{
          "--" + key, 0, 0,
          "the saved run has " + before + ", not " + text + "; a resumed run keeps its settings",
          ""};
    }
  }
  if (!options.how.config.empty()) {
    return Error{"--config", 0, 0, "a resumed run keeps its settings", ""};
  }
  if (options.world.name != run.source().name) {
    return Error{"--resume", 0, 0,
                 "the saved run learns " + run.source().name + ", not " + options.world.name, ""};
  }
  const Result<WorldSource> source = options.world.source();
  if (!source) return source.error();
  if (!source->parameters.empty() && source->parameters != run.source().parameters) {
    const auto words = [](const WorldSource& one) {
      std::string text;
      for (const auto& [key, value] : one.parameters) {
        text += (text.empty() ? "" : " ") + key + "=" + value;
      }
      return text.empty() ? std::string("none") : text;
    };
    return Error{"--with", 0, 0,
                 "the saved run has " + words(run.source()) + ", not " + words(*source) +
                     "; a resumed run keeps its world",
                 ""};
  }
  return {};
}

Result<RunSettings> limits_of(const LearnOptions& options) {
  RunSettings limits;
  Describer list;
  limits.describe_limits(list);
  const Result<void> applied = options.limits.apply(list.settings());
  if (!applied) return applied.error();
  if (!limits.until.empty() && limits.until != "stable") {
    return Error{"--until", 0, 0, "stable expected, not '" + limits.until + "'", "stable"};
  }
  if (!limits.time.empty()) {
    const Result<double> seconds = parse_duration(limits.time, "--time");
    if (!seconds) return seconds.error();
  }
  return limits;
}

Result<Run> open_run(const LearnOptions& options, const RunSettings& limits) {
  const bool watch = !limits.has_limit() || limits.until == "stable";
  if (!options.resume.empty()) {
    Result<Run> run = Run::load(options.resume, watch);
    if (!run) return run;
    const Result<void> same = agrees(options, *run);
    if (!same) return same.error();
    return run;
  }
  RunSettings settings;
  const Result<void> applied = options.how.apply(settings_of(settings));
  if (!applied) return applied.error();
  settings.learn.until_stable = watch;
  const Result<WorldSource> source = options.world.source();
  if (!source) return source.error();
  const Result<World> world = options.world.open();
  if (!world) return world.error();
  const Result<std::vector<double>> rewards =
      initial_rewards(settings.learn.initial_rewards, *world);
  if (!rewards) return rewards.error();
  return Run::start(settings, *source, *world, *rewards);
}

// Learns, saving every so often, until done or interrupted.
Result<void> advance(Run& run, const LearnOptions& options, const RunSettings& limits,
                     std::string& records) {
  double pause = 0.0;
  if (!options.save_every.empty()) {
    const Result<double> seconds = parse_duration(options.save_every, "--save-every");
    if (!seconds) return seconds.error();
    if (options.save.empty()) return Error{"--save-every", 0, 0, "needs --save FILE", ""};
    pause = *seconds;
  }
  const Sink sink = [&](const Record& record) {
    records += std::to_string(record.step) + "," + std::to_string(record.lane) + "," +
               std::string(record.name) + "," + shortest(record.value) + "\n";
  };
  ProgressDisplay display(options.output.quiet);
  const std::uint64_t total = limits.steps * run.trainings().size();
  std::uint64_t resumed = 0;
  for (const Training& training : run.trainings()) resumed += training.learner().progress().steps;
  const auto begun = std::chrono::steady_clock::now();
  const auto keep_going = [&](const RunProgress& now) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
    const std::string extra =
        now.mean_return ? "return " + number_text(*now.mean_return) : std::string();
    display.show(now.steps, total, seconds.count(), extra, resumed);
    return !interrupted();
  };
  for (;;) {
    const bool finished =
        run.advance(limits, pause, keep_going, options.output.file.empty() ? Sink() : sink);
    if (!options.save.empty()) {
      const Result<void> saved = run.save(options.save);
      if (!saved) return saved;
    }
    if (finished || interrupted()) return {};
  }
}

// A run folder: settings.toml, records.csv, run.quoll.
Result<void> write_folder(Run& run, const std::string& folder, const std::string& records) {
  if (mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) {
    return Error{folder, 0, 0, "the folder cannot be made", ""};
  }
  RunSettings settings = run.settings();
  Result<void> written = write_file(folder + "/settings.toml", config_text(settings_of(settings)));
  if (!written) return written;
  written = write_file(folder + "/records.csv", "step,seed_index,name,value\n" + records);
  if (!written) return written;
  return run.save(folder + "/run.quoll");
}

Exit exit_status(const Run& run, const RunSettings& limits) {
  for (const Training& training : run.trainings()) {
    const Stop stop = training.stop();
    if (stop == Stop::diverged || stop == Stop::budget || stop == Stop::interrupted) {
      return goal_missed;
    }
    if (limits.until == "stable" && stop != Stop::stable) return goal_missed;
  }
  return done;
}

Exit learn(const LearnOptions& options) {
  const Result<RunSettings> limits = limits_of(options);
  if (!limits) return fail(limits.error());
  Result<Run> run = open_run(options, *limits);
  if (!run) return fail(run.error());
  run->set_threads(options.threads);
  std::optional<ComingUpdates> coming;
  if (options.explain) {
    Result<ComingUpdates> made = coming_updates(*run, *limits, options.output.all);
    if (!made) return fail(made.error());
    coming = std::move(*made);
    if (!options.output.json && !print(updates_text(*run, *coming))) return user_error;
  }
  catch_interrupts();
  std::string records;
  const Result<void> learned = advance(*run, options, *limits, records);
  if (!learned) return fail(learned.error());
  if (!options.output.file.empty()) {
    const Result<void> written = write_folder(*run, options.output.file, records);
    if (!written) return fail(written.error());
  }
  const RunResult result = run->result(true);
  const std::string text =
      options.output.json
          ? learn_json(*run, result, options.output.all, coming ? &*coming : nullptr)
          : learn_text(*run, result, stdout_style(), options.output.all);
  if (!print(text)) return user_error;
  return exit_status(*run, *limits);
}

}  // namespace

void declare_learn(Options& options) {
  auto given = std::make_shared<LearnOptions>();
  RunSettings defaults;
  Describer how, limits;
  defaults.describe(how);
  defaults.describe_limits(limits);
  given->world.declare(options);
  given->how.declare(options, how.settings());
  given->limits.declare_flags(options, limits.settings());
  options.option("--threads", &given->threads, "N",
                 "processors to use; 0 = all; changes no result");
  options.flag("--explain", &given->explain, "show each update with its numbers");
  options.option("--save", &given->save, "FILE", "write the run to a file when it ends");
  options.option("--save-every", &given->save_every, "TIME", "and every so often, such as 60s");
  options.option("--resume", &given->resume, "FILE", "go on with a saved run");
  given->output.declare(options, "a folder for settings.toml, records.csv and run.quoll");
  options.run([given] { return learn(*given); });
}

}  // namespace quoll::cli
