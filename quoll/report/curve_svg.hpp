#pragma once
// Learning curves as a picture: axes with ticks, a line per curve, a band over several seeds.

#include <span>
#include <string>

#include "quoll/report/curve.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

struct CurveView {
  std::span<const Curve> curves;  ///< up to 8 are told apart by colour and dashes
  std::string title;
  std::string x_label = "steps";
  std::string y_label = "mean return";
};

/// Never fails: without points it says so in the picture.
Picture curve_svg(const CurveView& view);

}  // namespace quoll
