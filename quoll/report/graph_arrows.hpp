#pragma once
// The arrows of a state graph: what each says, and the curve it takes between the boxes.

#include <array>
#include <string>
#include <vector>

#include "quoll/report/graph_layout.hpp"
#include "quoll/report/graph_svg.hpp"

namespace quoll {

/// One line of an arrow's label.
struct ArrowLine {
  std::string text;
  std::string_view color;
  bool bold = false;
};

using Cubic = std::array<GraphPoint, 4>;  ///< a Bezier curve

struct Arrow {
  State from = 0, to = 0;
  bool optimal = false;
  bool chance = false;  ///< one of several outcomes of its action
  std::vector<ArrowLine> lines;
  Cubic curve{};                    ///< from border to border, the tip of the head at its end
  std::vector<GraphPoint> samples;  ///< along the curve, equally spaced in its parameter
};

inline constexpr double arrow_font = 14;

/// One arrow per outcome, in the order of the choices.
std::vector<Arrow> arrows_of(const GraphView& view);

/// Gives each arrow its curve: two directions bend to their right, several moves of one direction
/// fan out, loops take the emptiest sides, and an arrow bends further rather than cross a foreign
/// box.
void route(std::vector<Arrow>& arrows, const std::vector<Box>& nodes);

GraphPoint point_at(const Cubic& curve, double t);

}  // namespace quoll
