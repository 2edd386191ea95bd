#include "quoll/report/svg.hpp"

#include "tests/report/picture.hpp"

namespace quoll {
namespace {

TEST(Svg, EscapesText) {
  EXPECT_EQ(xml_escape("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(xml_escape("a\x01\nb\xff"), "a  b\xEF\xBF\xBD");
}

TEST(Svg, PrintsShortCoordinates) {
  EXPECT_EQ(svg_number(12.0), "12");
  EXPECT_EQ(svg_number(12.345), "12.35");
  EXPECT_EQ(svg_number(-0.001), "0");
  EXPECT_EQ(label_number(8.57794), "8.578");
  EXPECT_EQ(label_number(123456.7), "123457");
  EXPECT_EQ(label_number(1234567), "1.235e+06");
}

TEST(Svg, BoxesKnowTheirNeighbours) {
  const Box box{0, 0, 10, 10};
  EXPECT_TRUE(box.overlaps({9, 9, 5, 5}));
  EXPECT_FALSE(box.overlaps({10, 0, 5, 5}));
  EXPECT_TRUE(box.overlaps({11, 0, 5, 5}, 2));
  EXPECT_TRUE(box.contains({0, 0, 10, 10}));
  EXPECT_FALSE(box.contains({0, 0, 10.1, 10}));
}

// Luma 0.299 R + 0.587 G + 0.114 B falls all the way, so a grey print keeps the order.
TEST(Svg, ScaleDarkensAllTheWay) {
  double before = 256;
  for (int i = 0; i <= 20; ++i) {
    const std::string c = scale_color(i / 20.0);
    ASSERT_EQ(c.size(), 7U);
    const double luma = 0.299 * std::stoi(c.substr(1, 2), nullptr, 16) +
                        0.587 * std::stoi(c.substr(3, 2), nullptr, 16) +
                        0.114 * std::stoi(c.substr(5, 2), nullptr, 16);
    EXPECT_LT(luma, before);
    before = luma;
  }
  EXPECT_TRUE(scale_is_light(0));
  EXPECT_FALSE(scale_is_light(1));
  EXPECT_EQ(scale_color(-5), scale_color(0));
}

TEST(Svg, FinishesAFile) {
  SvgWriter svg;
  svg.text(50, 40, "R & B", {.size = 10, .bold = true});
  const Picture picture = svg.finish(100, 60, "a < b");
  testing::expect_sound(picture);
  EXPECT_NE(picture.svg.find("<title>a &lt; b</title>"), std::string::npos);
  ASSERT_EQ(picture.labels.size(), 1U);
  EXPECT_EQ(picture.labels[0].text, "R & B");
}

TEST(Svg, CheckerSeesFaults) {
  EXPECT_NE(testing::xml_fault("<a><b></a>"), "");
  EXPECT_NE(testing::xml_fault("<a x=\"1>"), "");
  EXPECT_EQ(testing::xml_fault("<a x=\"1\"><b/></a>"), "");
}

}  // namespace
}  // namespace quoll
