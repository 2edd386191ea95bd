#pragma once
// The part of a large grid that its pictures show.

#include <algorithm>
#include <cstdint>

namespace quoll {

/// Rows [top, top + rows) and columns [left, left + columns) of a grid.
struct GridWindow {
  std::uint32_t top, left, rows, columns;
};

/// As much of a grid as a picture may show, with the given cell as near to its middle as the edges
/// allow.
inline GridWindow grid_window(std::uint32_t rows, std::uint32_t columns, std::uint32_t cell,
                              std::uint32_t most_rows, std::uint32_t most_columns) {
  const auto begin_of = [](std::uint32_t around, std::uint32_t shown, std::uint32_t all) {
    return std::min(around - std::min(around, shown / 2), all - shown);
  };
  GridWindow view{0, 0, std::min(rows, most_rows), std::min(columns, most_columns)};
  view.top = begin_of(cell / columns, view.rows, rows);
  view.left = begin_of(cell % columns, view.columns, columns);
  return view;
}

}  // namespace quoll
