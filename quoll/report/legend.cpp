#include "quoll/report/legend.hpp"

#include <fmt/format.h>

#include "quoll/report/table.hpp"

namespace quoll {

namespace {

constexpr double font = 14;
constexpr double line_height = 24;
constexpr double sign_width = 26;
constexpr double between = 22;

double item_width(const LegendItem& item) {
  const double sign = item.kind == LegendItem::Kind::none ? 0 : sign_width + 8;
  return sign + text_width(item.text, font);
}

void draw_sign(SvgWriter& svg, double x, double y, const LegendItem& item) {
  const auto stroke = [&](double width, std::string_view more) {
    return fmt::format(R"(fill="none" stroke="{}" stroke-width="{}" {})", item.color,
                       svg_number(width), more);
  };
  const auto arrow = [&](double width, double head) {
    svg.line(x, y, x + sign_width - head, y, stroke(width, ""));
    svg.path(fmt::format("M{} {}l{} -{}v{}z", svg_number(x + sign_width), svg_number(y),
                         svg_number(-2 * head), svg_number(head), svg_number(2 * head)),
             fmt::format(R"(fill="{}")", item.color));
  };
  switch (item.kind) {
    case LegendItem::Kind::none:
      break;
    case LegendItem::Kind::square:
      svg.rect({x + 6, y - 8, 16, 16}, 2, fmt::format(R"(fill="{}")", item.color));
      break;
    case LegendItem::Kind::ring:
      svg.rect({x + 7, y - 7, 14, 14}, 0, stroke(3, ""));
      break;
    case LegendItem::Kind::arrow:
      arrow(1.8, 5);
      break;
    case LegendItem::Kind::thick_arrow:
      arrow(4, 7);
      break;
    case LegendItem::Kind::line:
      svg.line(x, y, x + sign_width, y, stroke(3, ""));
      break;
    case LegendItem::Kind::dashes:
      svg.line(x, y, x + sign_width, y, stroke(2, R"(stroke-dasharray="5 4")"));
      break;
  }
}

}  // namespace

double legend_width(const std::vector<LegendItem>& items) {
  double width = 0;
  for (const LegendItem& item : items) width += item_width(item) + (width > 0 ? between : 0);
  return width;
}

double draw_legend(SvgWriter& svg, double x, double y, double width,
                   const std::vector<LegendItem>& items) {
  if (items.empty()) return y;
  double at = x;
  for (const LegendItem& item : items) {
    const double wide = item_width(item);
    if (at > x && at + wide > x + width) {
      at = x;
      y += line_height;
    }
    draw_sign(svg, at, y + line_height / 2, item);
    const double sign = item.kind == LegendItem::Kind::none ? 0 : sign_width + 8;
    svg.text(at + sign, y + line_height / 2 + font * 0.36, item.text,
             {.size = font, .anchor = "start"});
    at += wide + between;
  }
  return y + line_height;
}

double draw_scale(SvgWriter& svg, double x, double y, double width, double low, double high) {
  constexpr int steps = 48;
  const std::string from = "value " + number_text(low), to = number_text(high);
  const double left = x + text_width(from, font) + 10;
  const double right = x + width - text_width(to, font) - 10;
  const double bar = std::min(260.0, right - left);
  const double baseline = y + line_height / 2 + font * 0.36;
  svg.text(x, baseline, from, {.size = font, .anchor = "start"});
  for (int i = 0; i < steps; ++i) {
    svg.rect(
        {left + bar * i / steps, y + 4, bar / steps + 0.4, 16}, 0,
        fmt::format(R"(fill="{}" shape-rendering="crispEdges")", scale_color((i + 0.5) / steps)));
  }
  svg.text(left + bar + 10, baseline, to, {.size = font, .anchor = "start"});
  return y + line_height + 6;
}

}  // namespace quoll
