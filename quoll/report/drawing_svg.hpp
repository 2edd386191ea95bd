#pragma once
// The drawing of a state (env/drawing.hpp) as an SVG picture.

#include <string_view>

#include "quoll/env/drawing.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

/// Scaled to about 480 pixels on its longer side.
Picture drawing_svg(const Drawing& drawing, std::string_view title);

}  // namespace quoll
