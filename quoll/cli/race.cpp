// quoll race WORLD: methods against the lecture's.

#include "quoll/experiment/race.hpp"

#include <chrono>
#include <limits>
#include <memory>

#include "quoll/cli/common.hpp"
#include "quoll/cli/race_output.hpp"
#include "quoll/cli/verbs.hpp"
#include "quoll/report/race_svg.hpp"
#include "quoll/report/race_text.hpp"

namespace quoll::cli {
namespace {

/// What can be asked of a race.
struct RaceSettings {
  std::string methods;
  RaceMode mode = RaceMode::start;
  std::uint64_t seeds = 30;
  std::uint64_t seed = 1;
  double discount = 0.0;
  std::string from;
  std::uint64_t cap_steps = 50'000'000;
  double cap_seconds = 10.0;

  void describe(Describer& d) {
    d("methods", methods,
      "who runs against the lecture's method: METHOD or METHOD:key=value:key=value, separated by "
      "commas; without it every method");
    d.choice("mode", mode, race_mode_names,
             "from which states a policy must be good: from all, any of which may be chosen as a "
             "start, or from the start alone");
    d("seeds", seeds, 1, 1e6, "how many seeds each entrant runs, from --seed on");
    d("seed", seed, "which random numbers");
    d("discount", discount, std::numeric_limits<double>::denorm_min(), 1,
      "discount factor of the future; without it the world's own");
    d("from", from, "the state every episode begins in, instead of the world's start");
    d("cap_steps", cap_steps, 1, 1e15, "steps after which a seed has failed");
    d("cap_seconds", cap_seconds, 0, 1e9,
      "processor seconds after which a seed has failed; 0 = no such limit");
  }
};

struct RaceOptions {
  WorldOption world;
  OutputOption output;
  GivenSettings given;
  unsigned threads = 0;
};

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
  const RacePlan plan{
      &*world,        &*referee,
      settings->mode, settings->seeds,
      settings->seed, {settings->cap_steps, settings->cap_seconds},
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
  given->world.declare(options);
  given->given.declare(options, settings_of(defaults));
  options.option("--threads", &given->threads, "N",
                 "processors to use; 0 = all; changes no step count");
  given->output.declare(options, "a picture: FILE.svg");
  options.run([given] { return race(*given); });
}

}  // namespace quoll::cli
