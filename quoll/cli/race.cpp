// quoll race WORLD: methods against the lecture's.

#include "quoll/experiment/race.hpp"

#include <chrono>
#include <memory>

#include "quoll/cli/common.hpp"
#include "quoll/cli/race_options.hpp"
#include "quoll/cli/race_output.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/report/race_svg.hpp"
#include "quoll/report/race_text.hpp"

namespace quoll::cli {
namespace {

Result<RaceSettings> settings_of_race(const RaceOptions& options) {
  RaceSettings settings;
  Result<void> applied = options.given.check_discount();
  if (applied) applied = options.given.apply(settings_of(settings));
  if (!applied) return applied.error();
  if (settings.seeds - 1 > std::numeric_limits<std::uint64_t>::max() - settings.seed) {
    return Error{"--seeds", 0, 0, "seeds beyond the largest number do not exist", ""};
  }
  return settings;
}

// The world, at the start that was asked for.
Result<World> open_world(const RaceOptions& options, const RaceSettings& settings) {
  Result<World> world = options.world.open();
  if (!world || settings.from.empty()) return world;
  return world_from(*world, settings.from);
}

Result<std::vector<Entrant>> entrants_of(const RaceSettings& settings, const World& world) {
  if (settings.methods.empty()) return all_entrants(settings.mode);
  Result<std::vector<Entrant>> entrants = parse_entrants(settings.methods, settings.mode);
  if (!entrants) return entrants;
  for (const Entrant& entrant : *entrants) {
    const Result<std::unique_ptr<Learner>> learner = make_learner(entrant.settings, world);
    if (learner) continue;
    Error error = learner.error();
    error.file = "--methods " + entrant.word;
    return error;
  }
  return entrants;
}

// Runs all heats with a bar.
RaceResult run(const RacePlan& plan, const std::vector<Entrant>& entrants, bool quiet) {
  ProgressDisplay display(quiet, "heats");
  const auto begun = std::chrono::steady_clock::now();
  RaceHooks hooks;
  hooks.keep_going = [&](std::uint64_t done_now, std::uint64_t all) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
    display.show(done_now, all, seconds.count(), "");
    return !interrupted();
  };
  return run_race(plan, entrants, hooks);
}

Exit race(const RaceOptions& options) {
  const Result<RaceSettings> settings = settings_of_race(options);
  if (!settings) return fail(settings.error());
  if (options.suite) return race_suite(options, *settings);
  if (options.world.name.empty()) {
    return fail({"race", 0, 0,
                 "WORLD expected: a built-in world (see 'quoll list worlds') or a file; or --suite",
                 ""});
  }
  const Result<World> world = open_world(options, *settings);
  if (!world) return fail(world.error());
  if (settings->mode == RaceMode::all && !world->traits.settable) {
    return fail({"--mode", 0, 0,
                 "the world " + world->name + " cannot be put into any state; use --mode start",
                 ""});
  }
  const double discount = settings->discount > 0.0 ? settings->discount : world->discount;
  const Result<Referee> referee = Referee::make(*world, discount);
  if (!referee) return fail(referee.error());
  const Result<std::vector<Entrant>> entrants = entrants_of(*settings, *world);
  if (!entrants) return fail(entrants.error());
  catch_interrupts();
  const RacePlan plan{&*world,         &*referee,      settings->mode,
                      settings->seeds, settings->seed, {settings->cap_steps, settings->cap_seconds},
                      options.threads};
  const RaceResult result = run(plan, *entrants, options.output.quiet);
  if (!print(options.output.json ? race_json(result) : race_text(result))) return user_error;
  if (!options.output.file.empty()) {
    const Result<void> written =
        write_output(options.output.file, race_svg(result).svg, {options.world.name});
    if (!written) return fail(written.error());
  }
  return result.interrupted ? goal_missed : done;
}

}  // namespace

void declare_race(Options& options) {
  auto given = std::make_shared<RaceOptions>();
  RaceSettings defaults;
  given->world.declare(options, false);
  options.flag("--suite", &given->suite,
               "run a list of worlds in both modes: standard, or WORLD = fresh for worlds never "
               "used to choose a setting; what was run before is not run again");
  given->given.declare(options, settings_of(defaults));
  options.option("--threads", &given->threads, "N",
                 "processors to use; 0 = all; changes no step count");
  given->output.declare(options, "a picture, FILE.svg; with --suite a folder for race.md [race]");
  options.run([given] { return race(*given); });
}

}  // namespace quoll::cli
