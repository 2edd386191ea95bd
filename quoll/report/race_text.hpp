#pragma once
// A race in the terminal, and its numbers as words for every other picture of it.

#include <string>
#include <vector>

#include "quoll/experiment/heat.hpp"

namespace quoll {

/// One line per entrant: steps and seconds (median and quartiles), how many times fewer than the
/// lecture's method needs, failures, memory; before it what was asked, after it what to know.
std::string race_text(const RaceResult& race);

/// What was asked, in one sentence.
std::string race_question(const RaceResult& race);

/// "45 ns", "3.2 us", "94 ms", "1.3 s", "3 min 20 s".
std::string seconds_text(double seconds);
/// "512 B", "12.3 kB".
std::string bytes_text(double bytes);

/// The cells of an entrant's line, as the columns of race_text().
std::vector<std::string> race_cells(const EntrantResult& yardstick, const EntrantResult& entrant);

/// Single ones; "-" where nothing ran, and "> " before a median that is a cap.
std::string steps_cell(const EntrantResult& entrant);
std::string seconds_cell(const EntrantResult& entrant);
std::string failures_cell(const EntrantResult& entrant);
/// "18,000x" with the sign of a bound where one of the two medians failed; "-" where both did.
std::string factor_cell(const EntrantResult& yardstick, const EntrantResult& entrant, double times);
std::string times_text(double times);

}  // namespace quoll
