#pragma once
// What the pictures of grids share: which state stands in which cell, and what marks it.

#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/report/grid_text.hpp"

namespace quoll {

inline constexpr State no_state = 0xFFFF'FFFF;

enum class CellMark : std::uint8_t { none, start, goal, pit };

struct GridCells {
  std::uint32_t rows = 0, columns = 0;
  std::vector<State> state;    ///< per cell; no_state = wall
  std::vector<CellMark> mark;  ///< per state
  double low = 0, high = 0;    ///< finite values of states that are not ends; low > high if none

  State at(std::uint32_t row, std::uint32_t column) const {
    return state[std::size_t{row} * columns + column];
  }
  /// Where a value stands between low (0) and high (1); 1 when all are equal.
  double share(double value) const;
};

/// Reads the layout. An end is a goal if the best reward for entering it is the best of all ends,
/// else a pit. A start is marked when at most 4 states are. Cost: one pass over the outcomes.
/// Error: the model has no layout.
Result<GridCells> grid_cells(const GridView& view);

/// The choices whose arrows a state shows: all optimal ones, else the policy's; none for ends.
std::vector<std::uint64_t> shown_choices(const GridView& view, State s);

/// Step to the right and down of a choice; {0, 0} when it has none.
std::pair<int, int> direction(const Mdp& mdp, std::uint64_t choice);

/// Mean value of the states in a square of cells.
struct BlockMean {
  double mean = 0;
  std::uint64_t valued = 0;  ///< cells with a value
  std::uint64_t walls = 0;
  std::uint64_t cells = 0;
  CellMark mark = CellMark::none;  ///< a start or end inside
};
BlockMean block_mean(const GridView& view, const GridCells& cells, std::uint32_t row,
                     std::uint32_t column, std::uint32_t side);

}  // namespace quoll
