#include "quoll/report/race_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/report/progress.hpp"
#include "quoll/report/race_text.hpp"

namespace quoll {

namespace {

using Races = std::vector<const PageRace*>;
using Factor = double EntrantResult::*;

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string head(const std::vector<std::string>& titles) {
  return row(titles) + row(std::vector<std::string>(titles.size(), "---"));
}

const EntrantResult* find(const PageRace& race, const std::string& word) {
  for (const EntrantResult& entrant : race.result.entrants) {
    if (entrant.word == word) return &entrant;
  }
  return nullptr;
}

/// Who ran in any of the races, in their order; the yardstick first.
std::vector<std::string> words_of(const Races& races) {
  std::vector<std::string> words;
  for (const PageRace* const race : races) {
    for (const EntrantResult& entrant : race->result.entrants) {
      if (std::find(words.begin(), words.end(), entrant.word) == words.end()) {
        words.push_back(entrant.word);
      }
    }
  }
  return words;
}

/// Whether the ratio of the medians says something: both ran, and not both failed.
bool counts(const PageRace& race, const EntrantResult& entrant, Factor factor) {
  const EntrantResult& yardstick = race.result.entrants.front();
  const double times = entrant.*factor;
  return std::isfinite(times) && times > 0.0 && !(yardstick.failed() && entrant.failed());
}

struct Tally {
  std::vector<double> steps, noisy_steps, seconds;
  std::uint64_t fewer = 0, more = 0, unfinished = 0, refused = 0, failures = 0, heats = 0;
};

Tally tally_of(const Races& races, const std::string& word) {
  Tally tally;
  for (const PageRace* const race : races) {
    const EntrantResult* const entrant = find(*race, word);
    if (!entrant || !entrant->refused.empty()) {
      ++tally.refused;
      continue;
    }
    tally.failures += entrant->failures;
    tally.heats += entrant->heats.size();
    tally.unfinished += entrant->failed();
    if (counts(*race, *entrant, &EntrantResult::fewer_steps)) {
      tally.steps.push_back(entrant->fewer_steps);
      if (!race->result.deterministic) tally.noisy_steps.push_back(entrant->fewer_steps);
      tally.fewer += entrant->fewer_steps > 1.0;
      tally.more += entrant->fewer_steps < 1.0;
    }
    if (counts(*race, *entrant, &EntrantResult::fewer_seconds)) {
      tally.seconds.push_back(entrant->fewer_seconds);
    }
  }
  return tally;
}

std::string mean_text(const std::vector<double>& factors) {
  return factors.empty() ? "-" : times_text(geometric_mean(factors));
}

std::string summary(const Races& races) {
  std::string text =
      head({"entrant", "fewer steps", "fewer steps, worlds with chance", "less time",
            "worlds with fewer steps", "with more", "median failed", "cannot run", "seeds failed"});
  for (const std::string& word : words_of(races)) {
    const Tally tally = tally_of(races, word);
    text += row({"`" + word + "`", mean_text(tally.steps), mean_text(tally.noisy_steps),
                 mean_text(tally.seconds), std::to_string(tally.fewer), std::to_string(tally.more),
                 std::to_string(tally.unfinished), std::to_string(tally.refused),
                 fmt::format("{} of {}", tally.failures, tally.heats)});
  }
  return text;
}

/// Factors world by world: one line a world, one column an entrant.
std::string matrix(const Races& races, Factor factor) {
  std::vector<std::string> words = words_of(races);
  std::vector<std::string> titles{"world"};
  for (const std::string& word : words) titles.push_back("`" + word + "`");
  std::string text = head(titles);
  for (const PageRace* const race : races) {
    const EntrantResult& yardstick = race->result.entrants.front();
    std::vector<std::string> cells{race->name};
    for (const std::string& word : words) {
      const EntrantResult* const entrant = find(*race, word);
      if (!entrant || entrant->heats.empty()) {
        cells.emplace_back("");
      } else if (entrant == &yardstick) {
        cells.push_back(factor == &EntrantResult::fewer_steps ? steps_cell(*entrant)
                                                              : seconds_cell(*entrant));
      } else {
        cells.push_back(factor_cell(yardstick, *entrant, entrant->*factor));
      }
    }
    text += row(cells);
  }
  return text;
}

std::string details(const PageRace& race) {
  const RaceResult& result = race.result;
  std::string text = fmt::format("#### {}\n\n", race.name);
  text +=
      fmt::format("`quoll race {} --mode {}`: {} states, {} pairs, {}.", result.command,
                  race_mode_names[static_cast<std::size_t>(result.mode)], grouped(result.states),
                  grouped(result.choices), result.deterministic ? "no chance" : "chance");
  if (!race.note.empty()) text += " Note: " + race.note + ".";
  text += "\n\n";
  if (!race.picture.empty()) text += fmt::format("![{}]({})\n\n", race.name, race.picture);
  text += head({"entrant", "steps", "quartiles", "fewer", "time", "quartiles", "less", "a step",
                "failed", "memory"});
  for (const EntrantResult& entrant : result.entrants) {
    if (!entrant.refused.empty()) continue;
    std::vector<std::string> cells = race_cells(result.entrants.front(), entrant);
    cells[0] = "`" + cells[0] + "`" + (entrant.note.empty() ? "" : " (" + entrant.note + ")");
    text += row(cells);
  }
  text += "\n";
  for (const EntrantResult& entrant : result.entrants) {
    if (!entrant.refused.empty()) {
      text += fmt::format("- `{}` does not run: {}\n", entrant.word, entrant.refused);
    }
  }
  return text + "\n";
}

std::string mode_section(const Races& races, RaceMode mode) {
  const bool all = mode == RaceMode::all;
  std::string text = fmt::format("## {}\n\n", all ? "From all states" : "From the start");
  text +=
      all ? "The policy must be good in every state, and any state may be chosen as a start.\n\n"
          : "The policy must be good at the start, and all one can do is begin anew.\n\n";
  text += summary(races) + "\n### How many times fewer steps\n\n";
  text += "The lecture's column holds its median steps.\n\n";
  text += matrix(races, &EntrantResult::fewer_steps) + "\n### How many times less time\n\n";
  text += "The lecture's column holds its median processor time.\n\n";
  text += matrix(races, &EntrantResult::fewer_seconds) + "\n### World by world\n\n";
  for (const PageRace* const race : races) text += details(*race);
  return text;
}

}  // namespace

std::string race_page(const RacePage& page) {
  std::string text = fmt::format("# {}\n\nMade by `{}`.\n\n", page.title, page.command);
  if (page.races.empty()) return text + "No race was run.\n";
  const RaceResult& one = page.races.front().result;
  text += fmt::format(
      "Steps and processor time until the greedy policy loses at most 1 % of the optimal value: "
      "median and quartiles over up to {} seeds, from seed {} on. The policy is judged after 1, 2, "
      "3, ... steps, 7 % apart; the first of two successive good looks counts. A seed that is not "
      "good after {} steps",
      one.seeds, one.first_seed, grouped(one.cap_steps));
  if (one.cap_seconds > 0.0) text += fmt::format(" or {}", seconds_text(one.cap_seconds));
  text += fmt::format(
      " has failed; it counts as that many steps, and as the time these take at its own speed. Who "
      "fails with each of the first {} seeds runs no others. ",
      trial_seeds);
  text +=
      "Where the lecture's median failed, factors are lower bounds (`>`); where the entrant's did, "
      "upper bounds (`<`); where both did, there is none (`-`). Geometric means take bounds as "
      "they "
      "stand. Memory is the learner as it would be saved. Those who learn see experience, the "
      "world's declared traits, and nothing else. `lecture`: uniform actions, random starts, step "
      "size 1 without chance and 1/N^0.6 with it; in races from all states the better of two "
      "lengths of its episodes.\n\n";
  for (const PageRace& race : page.races) {
    if (race.result.interrupted) {
      text += fmt::format("Interrupted in {}: what was run until then.\n\n", race.name);
      break;
    }
  }
  for (const RaceMode mode : {RaceMode::all, RaceMode::start}) {
    Races races;
    for (const PageRace& race : page.races) {
      if (race.result.mode == mode) races.push_back(&race);
    }
    if (!races.empty()) text += mode_section(races, mode);
  }
  return text;
}

}  // namespace quoll
