// CartPole: a pole hinged on a cart that is pushed left or right at every step; keep it up. Barto,
// Sutton, Anderson 1983, "Neuronlike adaptive elements that can solve difficult learning control
// problems", with the constants and the explicit Euler step of Gymnasium's CartPole.
//
// State, as JSON: [x (m), x' (m/s), angle (rad, 0 = upright, to the right positive), angle'
// (rad/s)], float64. Observation: the same as float32. Actions: left, right (-10 N, +10 N); steps
// of 0.02 s. The episode ends when |x| > 2.4 or |angle| > 12 degrees, and is cut off after `limit`
// steps. Reward 1 for every step, the last included; with sutton_barto_reward 0, and -1 at the end.
//
// Draws: a start takes four, x, x', angle, angle', each uniform in [-0.05, 0.05); a step none.
// Bins (--with bins=6,6,12,12) lie between: x +-2.4, x' +-3, angle +-12 degrees, angle' +-3.5.

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/env/binned.hpp"
#include "quoll/env/worlds/canvas.hpp"
#include "quoll/env/worlds/control.hpp"

namespace quoll {
namespace {

constexpr double gravity = 9.8;
constexpr double pole_mass = 0.1;
constexpr double total_mass = 0.1 + 1.0;
constexpr double half_pole = 0.5;
constexpr double pole_moment = pole_mass * half_pole;
constexpr double force_size = 10.0;
constexpr double step_seconds = 0.02;
constexpr double track_end = 2.4;
constexpr double angle_end = 12 * 2 * pi / 360;

struct Settings {
  bool sutton_barto_reward = false;
  std::uint64_t limit = 500;
  std::string bins;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("sutton_barto_reward", sutton_barto_reward,
             "reward 0 for a step and -1 for the fall, instead of 1 for every step");
    describe("limit", limit, 1.0, 1e15, "steps after which an episode is cut off");
    describe("bins", bins,
             "numbers of bins for position, velocity, angle and turning rate, such as 6,6,12,12: "
             "states become numbers");
    describe.choice("seeding", seeding, seeding_names,
                    "whose random numbers and whose sine: this program's own or Gymnasium's");
  }
};

struct CartPole {
  using Position = std::array<double, 4>;
  bool sutton_barto_reward;

  Spaces spaces() const { return {.actions = 2, .observation = 4}; }
  std::vector<std::string> action_names() const { return {"left", "right"}; }
  std::vector<Measured> measured() const {
    return {{"position", -track_end, track_end},
            {"velocity", -3.0, 3.0},
            {"angle", -angle_end, angle_end},
            {"turning rate", -3.5, 3.5}};
  }

  Position start(auto& dice) const {
    Position at;
    for (double& number : at) number = between(dice, -0.05, 0.05);
    return at;
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (fallen(at)) return {0.0, true, false};
    const auto [x, speed, angle, turning] = at;
    const double force = action == 1 ? force_size : -force_size;
    const double cosine = cos_of(dice, angle), sine = sin_of(dice, angle);
    const double push = (force + pole_moment * (turning * turning) * sine) / total_mass;
    const double angular = (gravity * sine - cosine * push) /
                           (half_pole * (4.0 / 3.0 - pole_mass * (cosine * cosine) / total_mass));
    const double linear = push - pole_moment * angular * cosine / total_mass;
    at = {x + step_seconds * speed, speed + step_seconds * linear, angle + step_seconds * turning,
          turning + step_seconds * angular};
    const bool ended = fallen(at);
    return {sutton_barto_reward ? (ended ? -1.0 : 0.0) : 1.0, ended, false};
  }
  void observe(const Position& at, std::span<float> seen) const {
    for (std::size_t i = 0; i < at.size(); ++i) seen[i] = static_cast<float>(at[i]);
  }
  static bool fallen(const Position& at) {
    return !(std::fabs(at[0]) <= track_end && std::fabs(at[2]) <= angle_end);
  }

  // 0.1 m a letter; the lean, at most 12 degrees, drawn four times too wide.
  std::string text(const Position& at) const {
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
  Drawing drawing(const Position& at) const {
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
                   {{x, axle}, {x + pole * math::sin(limit), axle - pole * math::cos(limit)}},
                   0.01);
      picture.circle(Ink::line, x + side * cart_wide * 0.3, ground - wheel, wheel);
    }
    picture.box(Ink::agent, x - cart_wide / 2, axle - cart_high / 2, cart_wide, cart_high);
    picture.line(Ink::other,
                 {{x, axle}, {x + pole * math::sin(at[2]), axle - pole * math::cos(at[2])}}, 0.07);
    picture.circle(Ink::line, x, axle, 0.04);
    return picture;
  }
};

Result<World> make(const Parameters& parameters) {
  const Result<Settings> settings = read_parameters<Settings>("cartpole", parameters);
  if (!settings) return settings.error();
  const double end = settings->sutton_barto_reward ? -1.0 : 1.0;
  const WorldFacts facts =
      control_facts(settings->limit, settings->seeding, {std::min(end, 0.0), std::max(end, 0.0)});
  return to_world("cartpole", CartPole{settings->sutton_barto_reward}, facts, settings->bins);
}

}  // namespace

extern const WorldEntry cartpole_world;
const WorldEntry cartpole_world{"cartpole",
                                "CartPole-v1 CartPole-v0:limit=200",
                                "a cart is pushed left or right to keep its pole upright",
                                "Barto, Sutton, Anderson 1983; Gymnasium CartPole-v1",
                                make,
                                parameters_of<Settings>};

}  // namespace quoll
