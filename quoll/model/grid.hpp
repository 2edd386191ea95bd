#pragma once
// Grid worlds: a picture in letters that becomes a model.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Grid {
  std::vector<std::string> rows;  ///< letters, all rows of equal length
  std::uint32_t moves = 4;        ///< 4 (N E S W) or 8 (also NE SE SW NW; corners are not cut)
  double slip = 0.0;              ///< probability of slipping, half to each side of the move
  double move_reward = -1.0;      ///< for each move
  double discount = 1.0;
  std::map<char, double> reward;  ///< added on entering a cell; if not given: P -100, others 0
  std::string terminal = "GP";    ///< letters of ends
};

/// Letters: '#' wall, '.' or ' ' free, 'S' start (one or more; none = every cell that is no end),
/// 'G' goal, 'P' pit, others by `reward` or `terminal`. Ends have no actions. The sides of a move
/// are the directions next to it: at right angles with 4 moves, at 45 degrees with 8. A move into a
/// wall, off the grid or diagonally past a wall's corner stays and earns move_reward alone. States
/// are the cells that are no walls in reading order, named r<row>c<column> from 0. Errors: line and
/// column are those of the picture, from 1. Cost: one pass, about 80 bytes per cell.
Result<MdpArrays> to_arrays(const Grid& grid);
Result<Mdp> to_mdp(const Grid& grid);

/// The grid as a text that read_grid() takes back: "key = value" lines, "map", the rows.
std::string to_text(const Grid& grid);

/// The settings and rows of such a text; letters are checked by to_arrays(). `first_row` receives
/// the line of the first row.
Result<Grid> parse_grid(std::string_view content, const std::string& path,
                        std::uint64_t& first_row);

}  // namespace quoll
