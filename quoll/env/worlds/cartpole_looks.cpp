// How the cart and its pole look, as letters and as shapes.

#include "quoll/base/math.hpp"
#include "quoll/env/worlds/canvas.hpp"
#include "quoll/env/worlds/cartpole.hpp"

namespace quoll::cartpole {

// 0.1 m a letter; the lean, at most 12 degrees, drawn four times too wide.
std::string text(const std::array<double, 4>& at) {
  constexpr int middle = 24, width = 2 * middle + 1;
  Canvas page(width, 5);
  const double cart = middle + 10.0 * at[0], lean = 4.0 * math::sin(at[2]);
  const char pole = lean > 0.2 ? '/' : lean < -0.2 ? '\\' : '|';
  for (int row = 0; row < 3; ++row) page.put(cart + (2.5 - row) * lean, row, pole);
  page.write(cart - 2, 3, "[___]");
  for (int i = 0; i < width; ++i) page.put(i, 4, i == middle ? '+' : '-');
  page.put(0, 4, '|');
  page.put(width - 1, 4, '|');
  return page.text() + "x " + thousandths(at[0]) + " m, " + thousandths(at[1]) + " m/s   angle " +
         thousandths(at[2] * radian_in_degrees) + " deg, " +
         thousandths(at[3] * radian_in_degrees) + " deg/s\n";
}
// In metres; the axle 1.4 m below the upper edge.

Drawing drawing(const std::array<double, 4>& at) {
  constexpr double axle = 1.4, cart_wide = 0.44, cart_high = 0.24, wheel = 0.06;
  constexpr double ground = axle + cart_high / 2 + 2 * wheel;
  const double x = track_end + 0.3 + at[0], pole = 2 * half_pole;
  Drawing picture{2 * track_end + 0.6, ground + 0.12, {}};
  picture.line(Ink::line, {{0.3, ground}, {0.3 + 2 * track_end, ground}}, 0.02);
  for (const double end : {0.3, 0.3 + 2 * track_end}) {
    picture.line(Ink::danger, {{end, ground - 0.15}, {end, ground}}, 0.03);
  }
  for (const double side : {-1.0, 1.0}) {
    const double limit = side * angle_end;
    picture.line(Ink::faint,
                 {{x, axle}, {x + pole * math::sin(limit), axle - pole * math::cos(limit)}}, 0.01);
    picture.circle(Ink::line, x + side * cart_wide * 0.3, ground - wheel, wheel);
  }
  picture.box(Ink::agent, x - cart_wide / 2, axle - cart_high / 2, cart_wide, cart_high);
  picture.line(Ink::other,
               {{x, axle}, {x + pole * math::sin(at[2]), axle - pole * math::cos(at[2])}}, 0.07);
  picture.circle(Ink::line, x, axle, 0.04);
  return picture;
}

}  // namespace quoll::cartpole
