#pragma once
// A grid world as a picture: heat by value, arrows for all optimal moves, walls, start, goal.

#include "quoll/base/error.hpp"
#include "quoll/report/grid_text.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

/// Largest side drawn cell by cell; a larger grid is sampled down to squares of cells, without
/// arrows.
inline constexpr std::uint32_t grid_svg_side = 120;

/// The picture with a legend of the scale. Values stand in the cells when these are large enough.
/// Error: no layout, with what to use instead.
Result<Picture> grid_svg(const GridView& view);

}  // namespace quoll
