#pragma once
// How table worlds that are grids or rows look: a picture in letters with '@' where the agent is.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/world.hpp"

namespace quoll {

/// The pictures of a grid. `cells[s]` = row * columns + column of state s; rows are equally long.
/// Letters: '#' wall, 'G' and 'F' goals, '~', 'P', 'H' and 'C' danger, ' ' nothing, all others
/// floor. Grids wider than 160 or higher than 100 (60 in the drawing) show the part around the
/// agent.
Looks grid_looks(std::vector<std::string> picture, std::vector<std::uint32_t> cells);

/// Every cell a state, in reading order; `direction` as in Layout.
Layout grid_layout(std::uint32_t rows, std::uint32_t columns,
                   std::vector<std::pair<int, int>> direction);

/// States that stand side by side, one letter each.
Looks row_looks(std::string letters);
/// Their layout.
Layout row_layout(std::uint32_t states, std::vector<std::pair<int, int>> direction);

/// "r3c14", as grids name their cells.
std::string cell_name(std::uint32_t row, std::uint32_t column);

}  // namespace quoll
