#pragma once
// Grid worlds: a picture in letters that becomes a model.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Grid {
  std::vector<std::string> rows;   ///< letters, all rows of equal length
  std::uint32_t moves = 4;         ///< 4 (N E S W) or 8 (also diagonals; corners are not cut)
  double slip = 0.0;               ///< probability of slipping, half to each side of the move
  double move_reward = -1.0;       ///< for each move
  double discount = 1.0;
  std::map<char, double> reward;   ///< added on entering a cell with this letter
  std::string terminal = "GP";     ///< letters of ends
};

/// Letters: '#' wall, '.' or ' ' free, 'S' start (one or more; none = every free cell), 'G' goal,
/// 'P' pit, others by `reward`. A move into a wall or off the grid stays. States are the open cells in
/// reading order, named r<row>c<column> from 0.
Result<Mdp> to_mdp(const Grid& grid);

}  // namespace quoll
