#pragma once
// A picture of a state as plain shapes, for worlds to describe and the report to draw: units are
// the world's own, x to the right, y down.

#include <string>
#include <utility>
#include <vector>

namespace quoll {

/// What a shape means; the report gives it a colour that fits the page.
enum class Ink : unsigned char { line, faint, agent, goal, danger, wall, floor, reward, other };

struct Shape {
  enum class Kind : unsigned char { polyline, polygon, circle, text } kind = Kind::polygon;
  Ink ink = Ink::line;
  std::vector<std::pair<double, double>> points;  ///< circle, text: the centre
  double size = 1.0;  ///< polyline: width; circle: radius; text: height of the letters
  std::string text;   ///< text: what it says
};

struct Drawing {
  double width = 0.0, height = 0.0;
  std::vector<Shape> shapes;  ///< drawn in this order

  Drawing& line(Ink ink, std::vector<std::pair<double, double>> points, double width_of_line) {
    shapes.push_back({Shape::Kind::polyline, ink, std::move(points), width_of_line, {}});
    return *this;
  }
  Drawing& polygon(Ink ink, std::vector<std::pair<double, double>> points) {
    shapes.push_back({Shape::Kind::polygon, ink, std::move(points), 0.0, {}});
    return *this;
  }
  Drawing& box(Ink ink, double x, double y, double wide, double high) {
    return polygon(ink, {{x, y}, {x + wide, y}, {x + wide, y + high}, {x, y + high}});
  }
  Drawing& circle(Ink ink, double x, double y, double radius) {
    shapes.push_back({Shape::Kind::circle, ink, {{x, y}}, radius, {}});
    return *this;
  }
  Drawing& write(Ink ink, double x, double y, double letter_height, std::string words) {
    shapes.push_back({Shape::Kind::text, ink, {{x, y}}, letter_height, std::move(words)});
    return *this;
  }
};

}  // namespace quoll
