#include "quoll/report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quoll {

namespace {

void include(AxisRange& range, double value) {
  if (!std::isfinite(value)) return;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

/// A range of one value becomes a small one around it.
void widen(AxisRange& range) {
  if (range.high > range.low) return;
  const double reach = range.low == 0 ? 1.0 : std::abs(range.low) * 0.1;
  range.low -= reach;
  range.high += reach;
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `width`.
double round_step(double width) {
  double power = 1;
  while (power * 10 <= width) power *= 10;
  while (power > width && power > 1e-300) power /= 10;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (power * factor >= width) return power * factor;
  }
  return power * 10;
}

}  // namespace

double AxisRange::share(double value) const {
  // Halves first: high - low overflows for ranges of the size of the largest doubles.
  const double width = high / 2 - low / 2;
  return std::clamp((value / 2 - low / 2) / width, 0.0, 1.0);
}

AxisRanges axis_ranges(std::span<const Curve> curves, bool bands) {
  AxisRanges ranges{{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, 0};
  for (const Curve& curve : curves) {
    for (const CurvePoint& point : curve.points) {
      if (!std::isfinite(point.value) || !std::isfinite(point.step)) continue;
      ++ranges.points;
      include(ranges.x, point.step);
      include(ranges.y, point.value);
      if (bands) {
        include(ranges.y, point.lower);
        include(ranges.y, point.upper);
      }
    }
  }
  if (ranges.points == 0) return {};
  widen(ranges.x);
  widen(ranges.y);
  return ranges;
}

std::string tick_text(double value, double step) {
  if (!(std::abs(value) < 1e7) || step < 1e-6) return number_text(value);
  int decimals = 0;
  for (double power = 1; power > step * 1.0001 && decimals < 6; power /= 10) ++decimals;
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // A rounded zero keeps no sign.
  if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
  return text;
}

std::vector<double> axis_ticks(double low, double high, int parts) {
  std::vector<double> ticks;
  const double width = high - low;
  if (!(width > 0) || !std::isfinite(width) || parts < 1) return {low};
  const double step = round_step(width / parts);
  const double slack = step * 1e-9;
  for (double i = std::ceil((low - slack) / step); i * step <= high + slack; ++i) {
    const double tick = i * step;
    ticks.push_back(tick == 0 ? 0.0 : tick);
    if (ticks.size() > static_cast<std::size_t>(parts) + 1) break;
  }
  return ticks;
}

}  // namespace quoll
