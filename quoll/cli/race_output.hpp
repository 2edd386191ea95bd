#pragma once
// What `quoll race` prints beside its table.

#include <span>
#include <string>
#include <string_view>

#include "quoll/report/race_page.hpp"

namespace quoll::cli {

/// The race as one JSON object; every heat is in it.
std::string race_json(const RaceResult& race);

/// The races of a suite as one JSON object.
std::string suite_json(std::string_view suite, std::span<const PageRace> races);

}  // namespace quoll::cli
