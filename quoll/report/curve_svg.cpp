#include "quoll/report/curve_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/report/axis.hpp"
#include "quoll/report/legend.hpp"
#include "quoll/report/progress.hpp"

namespace quoll {

namespace {

constexpr double width = 960, height = 560;
constexpr double tick_font = 15, label_font = 17;
// Okabe and Ito's set in an order whose neighbours differ most; yellow is too pale for lines.
constexpr std::array<std::string_view, 8> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#1f2933", "#8c6d1f"};

struct Plot {
  Box area;
  AxisRange x, y;
  double px(double step) const { return area.x + x.share(step) * area.width; }
  double py(double value) const { return area.bottom() - y.share(value) * area.height; }
};

double step_of(const std::vector<double>& ticks) {
  return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
}

void draw_y_axis(SvgWriter& svg, const Plot& plot, const std::vector<double>& ticks) {
  for (const double tick : ticks) {
    const double y = plot.py(tick);
    svg.line(plot.area.x, y, plot.area.right(), y,
             fmt::format(R"(stroke="{}" stroke-width="1")", palette::pale));
    svg.text(plot.area.x - 10, y + tick_font * 0.36, tick_text(tick, step_of(ticks)),
             {.size = tick_font, .anchor = "end"});
  }
}

void draw_x_axis(SvgWriter& svg, const Plot& plot, const std::string& label) {
  const std::string stroke = fmt::format(R"(stroke="{}" stroke-width="1.5")", palette::grey);
  svg.line(plot.area.x, plot.area.bottom(), plot.area.right(), plot.area.bottom(), stroke);
  double free_from = 0;
  for (const double tick : axis_ticks(plot.x.low, plot.x.high, 8)) {
    const double x = plot.px(tick);
    const TextStyle style{.size = tick_font};
    const double baseline = plot.area.bottom() + 24;
    const std::string words = std::abs(tick) < 1000 ? number_text(tick) : scaled_text(tick);
    const Box box = text_box(x, baseline, words, style);
    svg.line(x, plot.area.bottom(), x, plot.area.bottom() + 6, stroke);
    if (box.x < free_from || box.right() > width) continue;
    svg.text(x, baseline, words, style);
    free_from = box.right() + 8;
  }
  svg.text(plot.area.x + plot.area.width / 2, plot.area.bottom() + 52, label, {.size = label_font});
}

/// The pieces of a curve between gaps.
std::vector<std::span<const CurvePoint>> pieces(const Curve& curve) {
  std::vector<std::span<const CurvePoint>> runs;
  std::size_t begin = 0;
  const std::size_t size = curve.points.size();
  for (std::size_t i = 0; i <= size; ++i) {
    if (i < size && std::isfinite(curve.points[i].value) && std::isfinite(curve.points[i].step)) {
      continue;
    }
    if (i > begin) runs.push_back(std::span(curve.points).subspan(begin, i - begin));
    begin = i + 1;
  }
  return runs;
}

void draw_band(SvgWriter& svg, const Plot& plot, std::span<const CurvePoint> run,
               std::string_view color) {
  std::string upper, lower;
  const auto add = [&](std::string& data, const char* command, double step, double value) {
    data += fmt::format("{}{} {}", command, svg_number(plot.px(step)), svg_number(plot.py(value)));
  };
  const auto banded = [](const CurvePoint& p) {
    return std::isfinite(p.lower) && std::isfinite(p.upper);
  };
  for (const CurvePoint& p : run) {
    if (banded(p)) add(upper, upper.empty() ? "M" : "L", p.step, p.upper);
  }
  for (auto p = run.rbegin(); p != run.rend(); ++p) {
    if (banded(*p)) add(lower, "L", p->step, p->lower);
  }
  if (upper.empty()) return;
  svg.path(upper + lower + "z", fmt::format(R"(fill="{}" fill-opacity="0.18")", color));
}

void draw_line(SvgWriter& svg, const Plot& plot, std::span<const CurvePoint> run,
               std::string_view color, bool dashed) {
  if (run.size() == 1) {
    svg.circle(plot.px(run[0].step), plot.py(run[0].value), 4, fmt::format(R"(fill="{}")", color));
    return;
  }
  std::string data;
  for (const CurvePoint& point : run) {
    data += fmt::format("{}{} {}", data.empty() ? "M" : "L", svg_number(plot.px(point.step)),
                        svg_number(plot.py(point.value)));
  }
  svg.path(data,
           fmt::format(R"(fill="none" stroke="{}" stroke-width="3" stroke-linejoin="round"{})",
                       color, dashed ? R"( stroke-dasharray="8 5")" : ""));
}

std::vector<LegendItem> legend_of(std::span<const Curve> curves) {
  std::vector<LegendItem> items;
  bool band = false;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const bool dashed = i / colors.size() % 2 == 1;
    if (curves.size() > 1 || !curves[i].name.empty()) {
      items.push_back({dashed ? LegendItem::Kind::dashes : LegendItem::Kind::line,
                       colors[i % colors.size()], curves[i].name});
    }
    for (const CurvePoint& point : curves[i].points) band = band || std::isfinite(point.upper);
  }
  if (band)
    items.push_back({LegendItem::Kind::square, "#cfdbe6", "95 % interval of the mean over seeds"});
  return items;
}

}  // namespace

Picture curve_svg(const CurveView& view) {
  SvgWriter svg;
  const std::string title = view.title.empty() ? "learning curve" : view.title;
  const double title_size = std::min(24.0, 24 * (width - 40) / text_width(title, 24, true));
  svg.text(width / 2, 42, title, {.size = title_size, .bold = true});
  const AxisRanges ranges = axis_ranges(view.curves, true);
  if (ranges.points == 0) {
    svg.text(width / 2, height / 2, "no points yet", {.size = label_font, .color = palette::grey});
    return svg.finish(width, height, title);
  }
  const double legend_bottom = draw_legend(svg, 40, 62, width - 80, legend_of(view.curves));
  const double label_baseline = legend_bottom + 24;
  svg.text(24, label_baseline, view.y_label, {.size = label_font, .anchor = "start"});
  const std::vector<double> ticks = axis_ticks(ranges.y.low, ranges.y.high, 7);
  double tick_width = 0;
  for (const double tick : ticks) {
    tick_width = std::max(tick_width, text_width(tick_text(tick, step_of(ticks)), tick_font));
  }
  const double left = 24 + tick_width + 10;
  const double top = label_baseline + 24;
  const double plot_height = std::max(200.0, height - 76 - top);
  const Plot plot{{left, top, width - 36 - left, plot_height}, ranges.x, ranges.y};
  draw_y_axis(svg, plot, ticks);
  draw_x_axis(svg, plot, view.x_label);
  for (std::size_t i = 0; i < view.curves.size(); ++i) {
    for (const auto& run : pieces(view.curves[i]))
      draw_band(svg, plot, run, colors[i % colors.size()]);
  }
  for (std::size_t i = 0; i < view.curves.size(); ++i) {
    for (const auto& run : pieces(view.curves[i])) {
      draw_line(svg, plot, run, colors[i % colors.size()], i / colors.size() % 2 == 1);
    }
  }
  return svg.finish(width, plot.area.bottom() + 76, title);
}

}  // namespace quoll
