#pragma once
// Random mazes as grids.

#include <cstdint>

#include "quoll/base/settings.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {

struct MazeSettings {
  std::uint64_t size = 50;  ///< cells per side of the text grid
  std::uint64_t seed = 1;
  double braid = 0.5;

  void describe(Describer& d) {
    d("size", size, 3, 40000, "side of the grid in cells, walls included");
    d("seed", seed, "which maze");
    d("braid", braid, 0, 1, "share of dead ends opened; 0 is a perfect maze");
  }
};

/// A maze of size x size cells without a wall around it: the grid's edge is its border. Start top
/// left, goal bottom right; rooms in every second row and column, so that a little over half of the
/// cells are open. braid = share of the dead ends that get a second door; 0 = exactly one path
/// between two cells, 1 = no dead end. The same settings give the same maze everywhere. Cost:
/// linear in the cells, a quarter byte per cell beside the text.
Grid make_maze(const MazeSettings& settings);

}  // namespace quoll
