#include "quoll/report/curve_svg.hpp"

#include <cmath>

#include "tests/report/picture.hpp"

namespace quoll {
namespace {

Curve ramp(const std::string& name, double scale) {
  Curve curve{name, {}};
  for (int i = 0; i <= 50; ++i) {
    const double value = scale * i;
    curve.points.push_back({i * 1000.0, value, value - scale, value + scale});
  }
  return curve;
}

TEST(CurveSvg, DrawsCurvesWithBands) {
  const std::vector<Curve> curves{ramp("epsilon-greedy 0.1", 1), ramp("softmax", 0.5),
                                  ramp("ucb & others", -0.25)};
  CurveView view;
  view.curves = curves;
  view.title = "return while learning";
  const Picture picture = curve_svg(view);
  testing::expect_sound(picture);
  std::size_t bands = 0;
  for (std::size_t i = picture.svg.find("fill-opacity"); i != std::string::npos;
       i = picture.svg.find("fill-opacity", i + 1)) {
    ++bands;
  }
  EXPECT_EQ(bands, 3U);
  EXPECT_NE(picture.svg.find("ucb &amp; others"), std::string::npos);
}

TEST(CurveSvg, KeepsLabelsApartOnAnyScale) {
  for (const double scale : {1e-12, 1e-3, 1.0, 1e5, 1e14, 1e300}) {
    SCOPED_TRACE(scale);
    const std::vector<Curve> curves{ramp("one", scale)};
    CurveView view;
    view.curves = curves;
    testing::expect_sound(curve_svg(view));
  }
}

TEST(CurveSvg, SurvivesGapsSinglesAndNothing) {
  Curve gaps = ramp("gaps", 1);
  for (std::size_t i = 0; i < gaps.points.size(); i += 2) gaps.points[i].value = std::nan("");
  const std::vector<Curve> curves{gaps, {"one", {{.step = 5, .value = 2}}}, {"none", {}}};
  CurveView view;
  view.curves = curves;
  testing::expect_sound(curve_svg(view));
  view.curves = {};
  const Picture empty = curve_svg(view);
  testing::expect_sound(empty);
  EXPECT_NE(empty.svg.find("no points yet"), std::string::npos);
}

TEST(CurveSvg, TellsManyCurvesApart) {
  std::vector<Curve> curves;
  for (int i = 0; i < 12; ++i)
    curves.push_back(ramp("strategy number " + std::to_string(i), 1 + i));
  CurveView view;
  view.curves = curves;
  testing::expect_sound(curve_svg(view));
}

}  // namespace
}  // namespace quoll
