#pragma once
// Ranges and ticks of the axes of a chart.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quoll/report/curve.hpp"

namespace quoll {

struct AxisRange {
  double low = 0, high = 1;
  /// Where a value stands between low (0) and high (1), clamped.
  double share(double value) const;
};

struct AxisRanges {
  AxisRange x, y;
  std::uint64_t points = 0;  ///< finite ones met
};

/// The ranges that hold all finite points, never empty; `bands` includes lower and upper.
AxisRanges axis_ranges(std::span<const Curve> curves, bool bands);

/// A tick's number with the decimals its neighbours `step` away need.
std::string tick_text(double value, double step);

}  // namespace quoll
