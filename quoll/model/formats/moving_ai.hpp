#pragma once
// Maps and problems of the Moving AI benchmarks. Sturtevant 2012, "Benchmarks for Grid-Based
// Pathfinding", IEEE TCIAIG 4(2) 144-148.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/model/terrain.hpp"

namespace quoll {

/// A .map file: "type octile", "height N", "width N", "map" and the rows. '.', 'G' and 'S' are
/// ground, 'W' is water, '@', 'O' and 'T' are blocked.
Result<TerrainMap> parse_moving_ai(std::string_view content, const std::string& path);

/// One line of a .scen file; places are columns and rows from the top left.
struct Problem {
  std::uint32_t width = 0, height = 0;  ///< of the map it was made for
  std::uint32_t start_x = 0, start_y = 0;
  std::uint32_t goal_x = 0, goal_y = 0;
  double length = 0.0;  ///< of the shortest way, as its author computed it
  std::uint64_t line = 0;
};

/// A .scen file: "version 1", then bucket, map, width, height, start x, start y, goal x, goal y and
/// length per line, between tabs or, where there is none, blanks.
Result<std::vector<Problem>> parse_problems(std::string_view content, const std::string& path);

}  // namespace quoll
