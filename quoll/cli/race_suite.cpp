// quoll race --suite: a list of worlds in both modes, line by line in a log, and a page of it.

#include "quoll/experiment/race_suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/cli/exact.hpp"
#include "quoll/cli/race_options.hpp"
#include "quoll/cli/race_output.hpp"
#include "quoll/experiment/heat_log.hpp"
#include "quoll/report/race_svg.hpp"

namespace quoll::cli {
namespace {

/// Who runs in which mode.
struct Division {
  RaceMode mode;
  std::vector<Entrant> entrants;
};

Result<std::vector<Division>> divisions_of(const RaceOptions& options,
                                           const RaceSettings& settings) {
  std::vector<Division> divisions;
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    if (asked_for(options.given, "mode") && mode != settings.mode) continue;
    if (settings.methods.empty()) {
      divisions.push_back({mode, all_entrants(mode)});
      continue;
    }
    Result<std::vector<Entrant>> entrants = parse_entrants(settings.methods, mode);
    if (!entrants) return entrants.error();
    divisions.push_back({mode, std::move(*entrants)});
  }
  return divisions;
}

/// A suite on its way.
class SuiteRun {
 public:
  SuiteRun(const RaceOptions& options, const RaceSettings& settings, const Suite& suite,
           std::vector<Division> divisions, HeatLog log)
      : options_(options),
        settings_(settings),
        suite_(suite),
        divisions_(std::move(divisions)),
        log_(std::move(log)),
        display_(options.output.quiet, "heats") {
    for (const SuiteWorld& row : suite.worlds) {
      for (const Division& division : divisions_) total_ += heats_of(row, division);
    }
  }

  /// Runs every race; the page is written anew after each world.
  Result<void> run() {
    for (const SuiteWorld& row : suite_.worlds) {
      const Result<World> world = open_world(row);
      if (!world) return world.error();
      const Result<Referee> referee = Referee::make(*world, row.discount);
      if (!referee) return referee.error();
      for (const Division& division : divisions_) {
        const Result<void> done = run(row, *world, *referee, division);
        if (!done) return done;
      }
      const Result<void> written = write_page();
      if (!written) return written;
      if (interrupted()) break;
    }
    return {};
  }

  const std::vector<PageRace>& races() const { return races_; }
  std::string page_file() const {
    return folder() +
           (suite_.name == "standard" ? "/race.md" : "/race-" + std::string(suite_.name) + ".md");
  }
  std::string folder() const { return folder_of(options_); }

  static std::string folder_of(const RaceOptions& options) {
    return options.output.file.empty() ? "race" : options.output.file;
  }

 private:
  std::uint64_t seeds_of(const SuiteWorld& row) const {
    return std::min(settings_.seeds, row.most_seeds);
  }
  std::uint64_t heats_of(const SuiteWorld& row, const Division& division) const {
    const std::uint64_t lectures = division.mode == RaceMode::all ? 2 : 1;
    return seeds_of(row) * (division.entrants.size() + lectures);
  }

  Result<void> run(const SuiteWorld& row, const World& world, const Referee& referee,
                   const Division& division) {
    const HeatPlace place{command_of(row), division.mode, settings_.cap_steps,
                          settings_.cap_seconds};
    const RacePlan plan{&world,          &referee,
                        division.mode,   seeds_of(row),
                        settings_.seed,  {settings_.cap_steps, settings_.cap_seconds},
                        options_.threads};
    Result<void> logged;
    RaceHooks hooks;
    hooks.known = [&](const Entrant& entrant, std::uint64_t seed) {
      const Heat* const heat = log_.find(place, complete_word(entrant.settings), seed);
      known_ += heat != nullptr;
      return heat;
    };
    hooks.finished = [&](const Entrant& entrant, const Heat& heat) {
      if (logged) logged = log_.add(place, complete_word(entrant.settings), heat);
    };
    hooks.keep_going = [&](std::uint64_t done_now, std::uint64_t) {
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun_;
      display_.show(before_ + done_now, total_, seconds.count(), std::string(row.name), known_);
      return logged && !interrupted();
    };
    PageRace race{run_race(plan, division.entrants, hooks), std::string(row.name),
                  std::string(row.note), ""};
    before_ += heats_of(row, division);
    if (!logged) return logged;
    const auto& entrants = race.result.entrants;
    const bool ran = std::any_of(entrants.begin(), entrants.end(),
                                 [](const EntrantResult& one) { return !one.heats.empty(); });
    if (!ran) return {};  // cut short before the first heat was over
    race.result.command = place.command;
    race.picture = race.name + "-" +
                   std::string(race_mode_names[static_cast<std::size_t>(division.mode)]) + ".svg";
    const Result<void> drawn =
        write_output(folder() + "/" + race.picture, race_svg(race.result).svg, {});
    races_.push_back(std::move(race));
    return drawn;
  }

  // " --cap-steps 1000000", as it could be typed.
  std::string flag_of(const char* key) const {
    RaceSettings copy = settings_;
    std::string flag = " --" + std::string(key);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag + " " + text_of(*find(settings_of(copy), key));
  }

  Result<void> write_page() const {
    std::string command = "quoll race --suite";
    if (suite_.name != "standard") command += " " + std::string(suite_.name);
    command += fmt::format(" --seeds {}", settings_.seeds);
    for (const char* key : {"mode", "methods", "seed", "cap_steps", "cap_seconds"}) {
      if (asked_for(options_.given, key)) command += flag_of(key);
    }
    return write_output(page_file(), race_page({std::string(suite_.title), command, races_}), {});
  }

  const RaceOptions& options_;
  const RaceSettings& settings_;
  const Suite& suite_;
  std::vector<Division> divisions_;
  HeatLog log_;
  ProgressDisplay display_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::uint64_t total_ = 0, before_ = 0, known_ = 0;
  std::vector<PageRace> races_;
};

// What a suite decides itself cannot be asked for.
Result<const Suite*> suite_of(const RaceOptions& options) {
  for (const char* key : {"discount", "from"}) {
    if (asked_for(options.given, key)) {
      return Error{"--" + std::string(key), 0, 0, "each world of a suite has its own", ""};
    }
  }
  if (!options.world.with.empty() || options.world.aimed()) {
    return Error{options.world.with.empty() ? "--goal" : "--with", 0, 0,
                 "each world of a suite has its own", ""};
  }
  const std::string name = options.world.name.empty() ? "standard" : options.world.name;
  const Suite* const suite = find_suite(name);
  if (suite) return suite;
  Nearest nearest(name);
  for (const Suite& one : suites()) nearest.offer(one.name);
  return Error{"--suite", 0, 0, "standard or fresh expected, not '" + name + "'", nearest.best()};
}

}  // namespace

Exit race_suite(const RaceOptions& options, const RaceSettings& settings) {
  const Result<const Suite*> suite = suite_of(options);
  if (!suite) return fail(suite.error());
  Result<std::vector<Division>> divisions = divisions_of(options, settings);
  if (!divisions) return fail(divisions.error());
  const std::string folder = SuiteRun::folder_of(options);
  const Result<void> made = make_folder(folder);
  if (!made) return fail(made.error());
  Result<HeatLog> log = HeatLog::open(folder + "/heats.csv");
  if (!log) return fail(log.error());
  catch_interrupts();
  SuiteRun run(options, settings, **suite, std::move(*divisions), std::move(*log));
  const Result<void> done_all = run.run();
  if (!done_all) return fail(done_all.error());
  const std::string text = options.output.json
                               ? suite_json((*suite)->name, run.races())
                               : fmt::format("{}: {} races, with every heat in {}/heats.csv\n",
                                             run.page_file(), run.races().size(), folder);
  if (!print(text)) return user_error;
  return interrupted() ? goal_missed : done;
}

}  // namespace quoll::cli
