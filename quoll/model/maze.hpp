#pragma once
// Random mazes as grids.

#include <cstdint>

#include "quoll/base/settings.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {

struct MazeSettings {
  std::uint64_t size = 50;   ///< cells per side of the text grid
  std::uint64_t seed = 1;
  double braid = 0.5;

  void describe(Describer& d) {
    d("size", size, 3, 40000, "side of the grid in cells, walls included");
    d("seed", seed, "which maze");
    d("braid", braid, 0, 1, "share of dead ends opened; 0 is a perfect maze");
  }
};

/// A maze of size x size cells (depth-first search with an explicit stack; start top left, goal bottom
/// right). braid = share of dead ends opened by removing one wall; 0 = exactly one path between cells.
Grid make_maze(const MazeSettings& settings);

}  // namespace quoll
