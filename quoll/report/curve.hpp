#pragma once
// A learning curve in the terminal.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "quoll/report/table.hpp"

namespace quoll {

/// One evaluation: after `step` steps the mean return was `value`, over seeds within lower ..
/// upper.
struct CurvePoint {
  double step = 0;
  double value = 0;
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< nan = no band
  double upper = std::numeric_limits<double>::quiet_NaN();
};

struct Curve {
  std::string name;
  std::vector<CurvePoint> points;  ///< steps ascending; points whose value is nan are gaps
};

/// One line of eight heights (ASCII: "_.-:=+*#"), each letter the mean of its share of the values.
std::string sparkline(std::span<const double> values, std::size_t width, bool unicode = true);

/// Axes, ticks and the line in Braille dots (ASCII: stars), `columns` x `rows` letters inside the
/// axes.
std::string curve_text(const Curve& curve, const TerminalStyle& style, std::uint32_t columns = 60,
                       std::uint32_t rows = 10);

/// Round numbers that cut [low, high] into at most `parts` intervals of 1, 2 or 5 times a power of
/// ten.
std::vector<double> axis_ticks(double low, double high, int parts);

}  // namespace quoll
