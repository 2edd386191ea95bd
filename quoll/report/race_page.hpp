#pragma once
// A whole suite of races as a page in Markdown: losses beside wins.

#include <span>
#include <string>

#include "quoll/experiment/heat.hpp"

namespace quoll {

/// One race and what the page says around it.
struct PageRace {
  RaceResult result;
  std::string name;     ///< of the suite's world
  std::string note;     ///< where the world differs from what one may expect; may be empty
  std::string picture;  ///< its file beside the page; may be empty
};

struct RacePage {
  std::string title;
  std::string command;  ///< what makes this page
  std::span<const PageRace> races;
};

/// Per mode: the entrants with their geometric means over the lecture's method, the factors world
/// by world, and each race in full.
std::string race_page(const RacePage& page);

}  // namespace quoll
