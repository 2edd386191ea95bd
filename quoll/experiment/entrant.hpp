#pragma once
// Who runs in a race: a word for people and the settings it stands for.

#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/experiment/heat.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

struct Entrant {
  std::string word;
  LearnSettings settings;
  std::string note;  ///< one more fact for people, or empty
};

/// The word of the yardstick: uniform actions, random starts, step size 1 in deterministic worlds
/// and 1/N^0.6 in others; from the start in episodes of at most 2,000 steps, from all states in
/// those or in short ones.
inline constexpr std::string_view lecture_word = "lecture";

/// "method", or "method:key=value:key=value": the method's settings for races, then these of
/// LearnSettings. A value may contain colons ("epsilon=1:0.05:10000"). Errors name the nearest
/// method, key or value; seed and discount are the race's own.
Result<Entrant> parse_entrant(std::string_view word, RaceMode mode);

/// "a,b,c"; nobody runs twice.
Result<std::vector<Entrant>> parse_entrants(std::string_view words, RaceMode mode);

/// Every method of the registry that learns a table as it should, with its settings for races.
std::vector<Entrant> all_entrants(RaceMode mode);

/// The lecture's method in its settings for this world: in mode `all` two, of which the better one
/// counts.
std::vector<Entrant> lecture_entrants(const World& world, RaceMode mode, double discount);

/// The word that gives these settings whatever the defaults for races are.
std::string complete_word(const LearnSettings& settings);

}  // namespace quoll
