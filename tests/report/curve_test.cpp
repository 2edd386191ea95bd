#include "quoll/report/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "quoll/base/utf8.hpp"
#include "quoll/report/axis.hpp"

namespace quoll {
namespace {

TEST(Axis, TicksAreRound) {
  EXPECT_EQ(axis_ticks(0, 100, 5), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(axis_ticks(-3, 13, 4), (std::vector<double>{0, 5, 10}));
  EXPECT_EQ(axis_ticks(5, 5, 4), (std::vector<double>{5}));
  EXPECT_EQ(axis_ticks(0, std::numeric_limits<double>::infinity(), 4).size(), 1U);
  for (const double scale : {1e-290, 1e-9, 1.0, 1e17, 1e290}) {
    const auto ticks = axis_ticks(0, scale, 6);
    EXPECT_GE(ticks.size(), 3U) << scale;
    EXPECT_LE(ticks.size(), 7U) << scale;
  }
}

TEST(Axis, TickTextKeepsNeededDecimals) {
  EXPECT_EQ(tick_text(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_text(100.25, 0.05), "100.25");
  EXPECT_EQ(tick_text(-0.0, 0.5), "0.0");
  EXPECT_EQ(tick_text(40, 20), "40");
}

TEST(Sparkline, HasEightHeights) {
  const std::vector<double> ramp{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(sparkline(ramp, 8), "▁▂▃▄▅▆▇█");
  EXPECT_EQ(sparkline(ramp, 8, false), "_.-:=+*#");
  EXPECT_EQ(sparkline(ramp, 4, false), "_-+#");  // means 0.5 2.5 4.5 6.5 of 7, times 8: 0 2 5 7
  EXPECT_EQ(sparkline({}, 8), "");
}

TEST(Sparkline, LeavesGapsForNan) {
  const std::vector<double> values{0, std::nan(""), 7};
  EXPECT_EQ(sparkline(values, 3, false), "_ #");
}

// y = 0.3 x at x = 0 .. 10, rounded, halves down: 0 0 1 1 1 1 2 2 2 3 3.
TEST(CurveText, DrawsTheDiagonal) {
  const Curve curve{"", {{.step = 0, .value = 0}, {.step = 10, .value = 3}}};
  EXPECT_EQ(curve_text(curve, {.width = 80, .unicode = false}, 11, 4),
            "  |         **\n"
            "2 +      ***\n"
            "  |  ****\n"
            "0 +**\n"
            "  ++----+----+\n"
            "   0    5   10\n");
}

TEST(CurveText, FitsTheTerminal) {
  Curve curve{"return", {}};
  for (int i = 0; i < 500; ++i) {
    curve.points.push_back({.step = i * 1e5, .value = -1000.0 / (1 + i)});
  }
  curve.points[77].value = std::nan("");
  for (const std::uint32_t width : {30U, 50U, 80U}) {
    std::istringstream lines(curve_text(curve, {.width = width}));
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(display_width(line), width) << line;
  }
}

TEST(CurveText, SaysWhenThereIsNothing) {
  EXPECT_EQ(curve_text({"x", {}}, {}), "no points yet\n");
  EXPECT_EQ(curve_text({"x", {{.step = 1, .value = std::nan("")}}}, {}), "no points yet\n");
}

}  // namespace
}  // namespace quoll
