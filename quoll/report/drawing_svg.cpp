#include "quoll/report/drawing_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace quoll {
namespace {

constexpr double longer_side = 480.0, margin = 16.0;

std::string_view color(Ink ink) {
  switch (ink) {
    case Ink::line:
      return palette::ink;
    case Ink::faint:
      return palette::pale;
    case Ink::agent:
      return palette::blue;
    case Ink::goal:
      return palette::green;
    case Ink::danger:
      return palette::orange;
    case Ink::wall:
      return palette::wall;
    case Ink::floor:
      return "#e8ecf0";
    case Ink::reward:
      return palette::amber;
    case Ink::other:
      break;
  }
  return palette::grey;
}

}  // namespace

Picture drawing_svg(const Drawing& drawing, std::string_view title) {
  SvgWriter svg;
  const double largest = std::max({drawing.width, drawing.height, 1e-9});
  const double scale = longer_side / largest;
  const auto x = [&](double from) { return margin + from * scale; };
  const auto path = [&](const Shape& shape) {
    std::string data;
    for (const auto& [px, py] : shape.points) {
      data += fmt::format("{}{:.2f} {:.2f}", data.empty() ? "M" : " L", x(px), x(py));
    }
    return data;
  };
  for (const Shape& shape : drawing.shapes) {
    if (shape.points.empty()) continue;
    const auto [px, py] = shape.points.front();
    switch (shape.kind) {
      case Shape::Kind::polyline:
        svg.path(path(shape), fmt::format(R"(fill="none" stroke="{}" stroke-width="{:.2f}" )"
                                          R"(stroke-linecap="round" stroke-linejoin="round")",
                                          color(shape.ink), std::max(shape.size * scale, 0.75)));
        break;
      case Shape::Kind::polygon:
        svg.path(path(shape) + " Z", fmt::format(R"(fill="{}")", color(shape.ink)));
        break;
      case Shape::Kind::circle:
        svg.circle(x(px), x(py), shape.size * scale, fmt::format(R"(fill="{}")", color(shape.ink)));
        break;
      case Shape::Kind::text:
        svg.text(x(px), x(py) + 0.35 * shape.size * scale, shape.text,
                 {shape.size * scale, color(shape.ink), false, "middle"});
        break;
    }
  }
  return svg.finish(drawing.width * scale + 2 * margin, drawing.height * scale + 2 * margin, title);
}

}  // namespace quoll
