// What a ride looks like: text for a terminal, and a picture from above with the track behind the
// bicycle and the tilt as seen from behind below it.

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/env/worlds/bicycle.hpp"

namespace quoll {
namespace {

using Position = Bicycle::Position;
using Point = std::pair<double, double>;

std::string tenths(double x) {
  const double rounded = std::floor(std::fabs(x) * 10.0 + 0.5) / 10.0;
  return shortest(rounded);
}

double degrees(double radians) {
  return radians * 180.0 / Bicycle::pi;
}

// "[----*-----|----------] 5.5 degrees left": left is positive, and stands on the left.
std::string gauge(double angle, double limit) {
  std::string scale(21, '-');
  scale[10] = '|';
  const double share = std::clamp(angle / limit, -1.0, 1.0);
  scale[static_cast<std::size_t>(10.5 - 10.0 * share)] = '*';
  const std::string size = tenths(degrees(angle));
  const std::string_view side = size == "0" ? "" : angle > 0.0 ? " left" : " right";
  return "[" + scale + "] " + size + " degrees" + std::string(side);
}

// The ground as it is seen: a square of 100 units around everything there is to see.
class View {
 public:
  View(const Position& at, bool goal) {
    see(at.x_front, at.y_front);
    see(at.x_back, at.y_back);
    for (std::size_t i = 0; i < at.track.x.size(); ++i) see(at.track.x[i], at.track.y[i]);
    if (goal) see(Bicycle::goal_x, Bicycle::goal_y);
    const double side = std::max({right_ - left_, top_ - bottom_, 3.0}) * 1.15;
    left_ = 0.5 * (left_ + right_ - side);
    top_ = 0.5 * (bottom_ + top_ + side);
    scale_ = 100.0 / side;
  }
  Point point(double x, double y) const { return {(x - left_) * scale_, (top_ - y) * scale_}; }
  double scale() const { return scale_; }

 private:
  void see(double x, double y) {
    left_ = std::min(left_, x);
    right_ = std::max(right_, x);
    bottom_ = std::min(bottom_, y);
    top_ = std::max(top_, y);
  }
  double left_ = 0, right_ = 0, bottom_ = 0, top_ = 0, scale_ = 1;
};

// A bar of a length around a centre, `turned` to the left of north.
std::vector<Point> bar(Point centre, double length, double turned) {
  const double x = -0.5 * length * math::sin(turned), y = -0.5 * length * math::cos(turned);
  return {{centre.first - x, centre.second - y}, {centre.first + x, centre.second + y}};
}

// Never smaller than 6 units, so that it can be found on a long track.
void draw_bicycle(Drawing& drawing, const View& view, const Position& at) {
  const double length = std::max(Bicycle::length * view.scale(), 6.0);
  const Point front = view.point(at.x_front, at.y_front);
  const Point back{front.first + length * math::sin(at.psi),
                   front.second + length * math::cos(at.psi)};
  drawing.line(Ink::agent, {back, front}, 0.06 * length);
  drawing.line(Ink::line, bar(back, 0.6 * length, at.psi), 0.1 * length);
  drawing.line(Ink::line, bar(front, 0.6 * length, at.psi + at.theta), 0.1 * length);
  const Point handles{front.first + 0.2 * length * math::sin(at.psi),
                      front.second + 0.2 * length * math::cos(at.psi)};
  drawing.line(Ink::agent, bar(handles, 0.5 * length, at.psi + at.theta + 0.5 * Bicycle::pi),
               0.06 * length);
}

// From behind, in the strip below: 0.94 m to the centre of mass are 14 units.
void draw_tilt(Drawing& drawing, const Position& at) {
  const bool fallen = std::fabs(at.omega) > Bicycle::fall;
  drawing.line(Ink::line, {{0.0, 128.0}, {100.0, 128.0}}, 0.5);
  for (const double limit : {-Bicycle::fall, Bicycle::fall}) {
    drawing.line(Ink::faint,
                 {{50.0, 128.0}, {50.0 - 26.0 * math::sin(limit), 128.0 - 26.0 * math::cos(limit)}},
                 0.4);
  }
  const double x = -math::sin(at.omega), y = -math::cos(at.omega);
  drawing.line(fallen ? Ink::danger : Ink::agent,
               {{50.0, 128.0}, {50.0 + 20.0 * x, 128.0 + 20.0 * y}}, 1.5);
  drawing.circle(fallen ? Ink::danger : Ink::agent, 50.0 + 22.0 * x, 128.0 + 22.0 * y, 2.0);
}

}  // namespace

std::string Bicycle::text(const Position& at) const {
  std::string lines = "tilt        " + gauge(at.omega, fall) + "\n";
  lines += "handlebars  " + gauge(at.theta, stop) + "\n";
  if (settings.task == BicycleTask::goal) {
    const double x = goal_x - at.x_front, y = goal_y - at.y_front;
    lines += "goal        " + gauge(angle_to_goal(at), pi) + ", " +
             tenths(std::sqrt(x * x + y * y)) + " m\n";
  }
  if (fallen(at)) lines += "fallen\n";
  if (!fallen(at) && at_goal(at)) lines += "at the goal\n";
  return lines;
}

Drawing Bicycle::drawing(const Position& at) const {
  Drawing drawing{100.0, 130.0, {}};
  const bool goal = settings.task == BicycleTask::goal;
  const View view(at, goal);
  if (goal) {
    const Point centre = view.point(goal_x, goal_y);
    drawing.circle(Ink::goal, centre.first, centre.second,
                   std::max(goal_radius * view.scale(), 1.5));
  }
  std::vector<Point> track;
  for (std::size_t i = 0; i < at.track.x.size(); ++i) {
    track.push_back(view.point(at.track.x[i], at.track.y[i]));
  }
  track.push_back(view.point(at.x_front, at.y_front));
  if (track.size() > 1) drawing.line(Ink::other, std::move(track), 0.6);
  draw_bicycle(drawing, view, at);
  draw_tilt(drawing, at);
  return drawing;
}

}  // namespace quoll
