#include "quoll/report/race_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/report/progress.hpp"
#include "quoll/report/table.hpp"

namespace quoll {

namespace {

std::string between(const Quartiles& quartiles, std::string (*text)(double)) {
  if (std::isnan(quartiles.median)) return "-";
  return text(quartiles.lower) + " .. " + text(quartiles.upper);
}

std::string median(const EntrantResult& entrant, double value, std::string (*text)(double)) {
  if (std::isnan(value)) return "-";
  return (entrant.failed() ? "> " : "") + text(value);
}

bool by_the_clock(const RaceResult& race) {
  for (const EntrantResult& entrant : race.entrants) {
    for (const Heat& heat : entrant.heats) {
      if (heat.end == HeatEnd::seconds) return true;
    }
  }
  return false;
}

std::string notes(const RaceResult& race) {
  std::string text;
  std::uint64_t failures = 0;
  for (const EntrantResult& entrant : race.entrants) {
    failures += entrant.failures;
    if (!entrant.note.empty()) text += entrant.word + ": " + entrant.note + "\n";
  }
  if (failures > 0) {
    text += fmt::format(
        "a failed seed counts as {} steps, and as the seconds these take at its own speed\n",
        grouped(race.cap_steps));
  }
  if (by_the_clock(race)) {
    text += fmt::format(
        "some seeds were stopped by the clock, after {}: that depends on the "
        "machine (--cap-seconds)\n",
        seconds_text(race.cap_seconds));
  }
  if (!race.interrupted) {
    std::vector<std::string> words;
    for (const EntrantResult& entrant : race.entrants) {
      if (entrant.heats.size() < race.seeds && retired(entrant.heats))
        words.push_back(entrant.word);
    }
    if (!words.empty()) {
      text += fmt::format("failed with each of the first {} seeds and ran no others: {}\n",
                          trial_seeds, fmt::join(words, ", "));
    }
  }
  for (const EntrantResult& entrant : race.entrants) {
    if (!entrant.refused.empty()) text += entrant.word + " does not run: " + entrant.refused + "\n";
  }
  if (race.interrupted) text += "interrupted: these are the seeds that were done\n";
  return text;
}

}  // namespace

std::string seconds_text(double seconds) {
  if (seconds >= 99.5) return duration_text(seconds);
  // 0.9995 of a unit would print as 1000 of the smaller one.
  if (seconds >= 0.9995) return fmt::format("{:.3g} s", seconds);
  if (seconds >= 0.9995e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds >= 0.9995e-6) return fmt::format("{:.3g} us", seconds * 1e6);
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string bytes_text(double bytes) {
  const std::string text = scaled_text(bytes);
  return text + (text.find(' ') == std::string::npos ? " B" : "B");
}

std::string times_text(double times) {
  if (times >= 99.5 && times < 1e15) {
    return grouped(static_cast<std::uint64_t>(std::llround(times))) + "x";
  }
  return fmt::format("{:.2g}x", times);
}

std::string steps_cell(const EntrantResult& entrant) {
  return median(entrant, entrant.steps.median, scaled_text);
}

std::string seconds_cell(const EntrantResult& entrant) {
  return median(entrant, entrant.seconds.median, seconds_text);
}

std::string failures_cell(const EntrantResult& entrant) {
  if (entrant.heats.empty()) return "-";
  return fmt::format("{}/{}", entrant.failures, entrant.heats.size());
}

std::string factor_cell(const EntrantResult& yardstick, const EntrantResult& entrant,
                        double times) {
  if (std::isnan(times) || (yardstick.failed() && entrant.failed())) return "-";
  return (yardstick.failed() ? "> " : entrant.failed() ? "< " : "") + times_text(times);
}

std::vector<std::string> race_cells(const EntrantResult& yardstick, const EntrantResult& entrant) {
  const bool ran = !entrant.heats.empty();
  return {entrant.word,
          steps_cell(entrant),
          between(entrant.steps, scaled_text),
          factor_cell(yardstick, entrant, entrant.fewer_steps),
          seconds_cell(entrant),
          between(entrant.seconds, seconds_text),
          factor_cell(yardstick, entrant, entrant.fewer_seconds),
          ran ? seconds_text(entrant.step_seconds) : "-",
          failures_cell(entrant),
          ran ? bytes_text(static_cast<double>(entrant.bytes)) : "-"};
}

std::string race_question(const RaceResult& race) {
  std::string text = fmt::format(
      "steps and seconds until within 1 % of optimal {}; discount {}, {} from {}, at most {}",
      race.mode == RaceMode::all ? "in every state (any state may be chosen)" : "at the start",
      shortest(race.discount), counted(race.seeds, "seed"), race.first_seed,
      counted(race.cap_steps, "step"));
  if (race.cap_seconds > 0.0) text += fmt::format(" and {}", seconds_text(race.cap_seconds));
  return text;
}

std::string race_text(const RaceResult& race) {
  using Align = TextTable::Align;
  TextTable table({{"entrant"},
                   {"steps", Align::right},
                   {"quartiles"},
                   {"fewer", Align::right},
                   {"time", Align::right},
                   {"quartiles"},
                   {"less", Align::right},
                   {"a step", Align::right},
                   {"failed", Align::right},
                   {"memory", Align::right}});
  for (const EntrantResult& entrant : race.entrants) {
    if (entrant.refused.empty()) table.row(race_cells(race.entrants.front(), entrant));
  }
  return fmt::format("race {}   {}\n\n{}\n{}", race.world, race_question(race), table.text(),
                     notes(race));
}

}  // namespace quoll
