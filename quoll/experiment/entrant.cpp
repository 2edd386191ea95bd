#include "quoll/experiment/entrant.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/readers.hpp"

namespace quoll {
namespace {

/// What a method runs with if a word says no more: the same in every world.
struct RaceSettings {
  std::string_view method;
  std::string_view all;    ///< where the world can be put into any state
  std::string_view start;  ///< where it can only begin anew
};
constexpr RaceSettings race_settings[] = {
    {"q-learning", "start=each-pair", "explore=epsilon-greedy"},
    // What on-policy methods learn is the optimal policy only as chance fades.
    {"sarsa", "start=uniform:explore=epsilon-greedy:epsilon=0.5:0.01:200000",
     "explore=epsilon-greedy:epsilon=0.5:0.01:200000"},
    {"expected-sarsa", "start=uniform:explore=epsilon-greedy:epsilon=0.5:0.01:200000",
     "explore=epsilon-greedy:epsilon=0.5:0.01:200000"},
    {"double-q", "start=each-pair", "explore=epsilon-greedy"},
    {"n-step", "start=uniform:explore=epsilon-greedy:epsilon=0.5:0.01:200000",
     "explore=epsilon-greedy:epsilon=0.5:0.01:200000"},
    {"tree-backup", "start=uniform", "explore=epsilon-greedy"},
    // Actions that are not greedy cut the trace.
    {"q-lambda", "start=uniform:explore=epsilon-greedy", "explore=epsilon-greedy"},
    {"reverse-replay", "start=uniform", "explore=epsilon-greedy"},
    {"dyna-q", "start=each-pair", "explore=epsilon-greedy"},
    {"prioritised-sweeping", "start=each-pair", "explore=epsilon-greedy"},
    {"empirical-model", "start=each-pair", "explore=epsilon-greedy"},
    {"optimistic-model", "start=each-pair", ""},
    {"posterior-sampling", "start=each-pair", ""},
};
/// Of methods that are not listed.
constexpr RaceSettings others{"", "start=uniform", ""};

constexpr std::string_view not_of_entrants[] = {"method", "seed", "discount"};

// The pieces between colons; one without '=' belongs to the value before it.
std::vector<std::string> pieces(std::string_view text) {
  std::vector<std::string> result;
  for (const std::string_view part : split(text, ':')) {
    const bool pair = part.find('=') != std::string_view::npos;
    if (pair || result.empty() || result.back().find('=') == std::string::npos) {
      result.emplace_back(part);
    } else {
      result.back() += ":" + std::string(part);
    }
  }
  return result;
}

Result<void> apply(std::string_view text, const std::string& place, LearnSettings& settings) {
  if (text.empty()) return {};
  const std::vector<Setting> list = settings_of(settings);
  for (const std::string& piece : pieces(text)) {
    const std::size_t equals = piece.find('=');
    if (equals == std::string::npos || equals == 0) {
      return Error{place, 0, 0, "method:key=value:key=value expected, not '" + piece + "'", ""};
    }
    const std::string key = piece.substr(0, equals);
    const Setting* const setting = find(list, key);
    if (!setting) {
      Nearest nearest(key);
      for (const Setting& one : list) nearest.offer(one.name);
      return Error{place, 0, 0, "no setting '" + key + "'", nearest.best()};
    }
    if (std::find(std::begin(not_of_entrants), std::end(not_of_entrants), setting->name) !=
        std::end(not_of_entrants)) {
      return Error{place, 0, 0, key + " is the same for all who race: it stands in no word", ""};
    }
    const Result<void> assigned = assign(*setting, piece.substr(equals + 1), place + " " + key);
    if (!assigned) return assigned;
  }
  return {};
}

RaceSettings settings_for(std::string_view method) {
  for (const RaceSettings& one : race_settings) {
    if (one.method == method) return one;
  }
  return others;
}

}  // namespace

Result<Entrant> parse_entrant(std::string_view word, RaceMode mode) {
  const std::string place = "--methods";
  const std::string_view trimmed = trim(word);
  const std::size_t colon = trimmed.find(':');
  Entrant entrant{std::string(trimmed), {}, ""};
  entrant.settings.method = std::string(trimmed.substr(0, colon));
  entrant.settings.until_stable = false;
  const std::string given(colon == std::string_view::npos ? "" : trimmed.substr(colon + 1));
  if (colon != std::string_view::npos && given.empty()) {
    return Error{place, 0, 0,
                 "method:key=value:key=value expected, not '" + std::string(trimmed) + "'", ""};
  }
  const RaceSettings defaults = settings_for(entrant.settings.method);
  Result<void> applied =
      apply(mode == RaceMode::all ? defaults.all : defaults.start, place, entrant.settings);
  if (applied) applied = apply(given, place, entrant.settings);
  if (!applied) return applied.error();
  const Result<const LearnerEntry*> entry = find_offered(entrant.settings);
  if (!entry) {
    Error error = entry.error();
    error.file = place;
    return error;
  }
  if (!(*entry)->sound) {
    return Error{place, 0, 0,
                 "the rule " + entrant.settings.rule + " exists to be studied, it does not race",
                 ""};
  }
  // The log of a race says what was done, whatever auto may come to mean.
  if (entrant.settings.explore == "auto" && !(*entry)->traits.approximates &&
      !ignores(**entry, "explore")) {
    entrant.settings.explore = "uniform";
  }
  if (mode == RaceMode::start && entrant.settings.start != "world") {
    return Error{
        place, 0, 0,
        "start=" + entrant.settings.start + " chooses start states; only --mode all allows that",
        ""};
  }
  return entrant;
}

Result<std::vector<Entrant>> parse_entrants(std::string_view words, RaceMode mode) {
  std::vector<Entrant> entrants;
  for (const std::string_view word : split(words, ',')) {
    if (word.empty() || word == lecture_word) {
      return Error{"--methods", 0, 0,
                   word.empty() ? "a list such as q-learning,dyna-q expected, not '" +
                                      std::string(words) + "'"
                                : "the lecture's method always runs: name the others",
                   ""};
    }
    Result<Entrant> entrant = parse_entrant(word, mode);
    if (!entrant) return entrant.error();
    for (const Entrant& other : entrants) {
      if (other.word == entrant->word) {
        return Error{"--methods", 0, 0, entrant->word + " stands twice", ""};
      }
    }
    entrants.push_back(std::move(*entrant));
  }
  return entrants;
}

std::vector<Entrant> all_entrants(RaceMode mode) {
  std::vector<Entrant> entrants;
  for (const LearnerEntry& entry : learners()) {
    const bool seen = std::any_of(entrants.begin(), entrants.end(), [&](const Entrant& one) {
      return one.settings.method == entry.method;
    });
    if (seen || !entry.sound || entry.traits.approximates) continue;
    Result<Entrant> entrant = parse_entrant(entry.method, mode);
    if (entrant) entrants.push_back(std::move(*entrant));
  }
  return entrants;
}

std::vector<Entrant> lecture_entrants(const World& world, RaceMode mode, double discount) {
  Entrant entrant{std::string(lecture_word), {}, "episodes of at most 2,000 steps"};
  entrant.settings.until_stable = false;
  entrant.settings.explore = "uniform";
  entrant.settings.start = mode == RaceMode::all ? "uniform" : "world";
  entrant.settings.step_size = world.traits.deterministic ? "1" : "1/N^0.6";
  entrant.settings.episode_steps = 2000;
  if (mode == RaceMode::start) return {entrant};
  Entrant brief = entrant;
  // 1 / (1 - 0.8) is 5, not 5.000000000000001.
  const double horizon = discount < 1.0 ? std::ceil(1.0 / (1.0 - discount) - 1e-9) : 32.0;
  brief.settings.episode_steps = static_cast<std::uint64_t>(std::min(horizon, 32.0));
  brief.note = "episodes of " + std::to_string(brief.settings.episode_steps) + " steps";
  return {entrant, brief};
}

std::string complete_word(const LearnSettings& settings) {
  LearnSettings defaults, given = settings;
  const std::vector<Setting> standard = settings_of(defaults), list = settings_of(given);
  const RaceSettings races = settings_for(settings.method);
  std::string word = settings.method;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name(list[i].name);
    if (std::find(std::begin(not_of_entrants), std::end(not_of_entrants), name) !=
        std::end(not_of_entrants)) {
      continue;
    }
    // What the defaults for races might set is always said.
    const bool raced = races.all.find(name + "=") != std::string_view::npos ||
                       races.start.find(name + "=") != std::string_view::npos;
    if (!raced && text_of(list[i]) == text_of(standard[i])) continue;
    std::string key = name;
    std::replace(key.begin(), key.end(), '_', '-');
    word += ":" + key + "=" + text_of(list[i]);
  }
  return word;
}

}  // namespace quoll
