#pragma once
// Legends below and above pictures.

#include <string>
#include <vector>

#include "quoll/report/svg.hpp"

namespace quoll {

struct LegendItem {
  enum class Kind : std::uint8_t { none, square, ring, arrow, thick_arrow, line, dashes } kind;
  std::string_view color;
  std::string text;
};

/// Draws the items from (x, y) in lines at most `width` wide; returns the y below them.
double draw_legend(SvgWriter& svg, double x, double y, double width,
                   const std::vector<LegendItem>& items);

/// The width draw_legend needs for one line of all items.
double legend_width(const std::vector<LegendItem>& items);

/// Draws the scale from `low` to `high` as a bar between its numbers; returns the y below it.
double draw_scale(SvgWriter& svg, double x, double y, double width, double low, double high);

}  // namespace quoll
