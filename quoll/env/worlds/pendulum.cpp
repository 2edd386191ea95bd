// Pendulum: a rod hangs from a motor too weak to lift it at once; swing it up and hold it there.
// Gymnasium's Pendulum, with the torque taken from a few evenly spaced values: rod 1 m, 1 kg,
// steps of 0.05 s.
//
// State, as JSON: [angle (rad, 0 = upright, never wrapped), rate (rad/s, in +-8)], float64.
// Observation: cos, sin, rate as float32. Actions: `torques` values from -2 to 2. Reward of a step,
// from the state before it: -(a^2 + 0.1 rate^2 + 0.001 torque^2) with the angle a brought into
// [-pi, pi); in float64 throughout (NumPy 2 rounds the torque's part to float32). There is no end;
// the episode is cut off after `limit` steps.
//
// Draws: a start takes two, the angle uniform in [-pi, pi) and the rate in [-1, 1); a step none.
// Bins (--with bins=12,12,16) lie between: cos and sin +-1, rate +-8.

#include <array>
#include <cmath>

#include "quoll/base/text.hpp"
#include "quoll/env/binned.hpp"
#include "quoll/env/worlds/canvas.hpp"
#include "quoll/env/worlds/control.hpp"

namespace quoll {
namespace {

constexpr double fastest = 8.0, strongest = 2.0, step_seconds = 0.05;

struct Settings {
  std::uint64_t torques = 5;
  double gravity = 10.0;
  std::uint64_t limit = 200;
  std::string bins;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("torques", torques, 2.0, 1001.0, "number of torques, evenly spaced from -2 to 2");
    describe("gravity", gravity, 0.0, 1000.0, "acceleration of gravity (m/s^2)");
    describe("limit", limit, 1.0, 1e15, "steps after which an episode is cut off");
    describe("bins", bins,
             "numbers of bins for cosine, sine and rate, such as 12,12,16: states become numbers");
    describe.choice("seeding", seeding, seeding_names,
                    "whose random numbers and whose sine: this program's own or Gymnasium's");
  }
};

// The angle in [-pi, pi), as Python's % computes it.
double brought_round(double angle) {
  double rest = std::fmod(angle + pi, 2 * pi);
  if (rest < 0.0) rest += 2 * pi;
  return rest - pi;
}

struct Pendulum {
  using Position = std::array<double, 2>;
  std::uint32_t torques;
  double gravity;
  bool libm;  ///< of the observation

  Spaces spaces() const { return {.actions = torques, .observation = 3}; }
  std::vector<std::string> action_names() const {
    std::vector<std::string> names;
    for (Action a = 0; a < torques; ++a) names.push_back("torque " + shortest(torque(a)));
    return names;
  }
  std::vector<Measured> measured() const {
    return {{"cosine", -1, 1}, {"sine", -1, 1}, {"rate", -fastest, fastest}};
  }
  double torque(Action action) const {
    return -strongest + 2 * strongest * static_cast<double>(action) / (torques - 1);
  }

  Position start(auto& dice) const {
    const double angle = between(dice, -pi, pi);
    return {angle, between(dice, -1.0, 1.0)};
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    const auto [angle, rate] = at;
    const double u = torque(action);
    const double cost =
        square_of(dice, brought_round(angle)) + 0.1 * square_of(dice, rate) + 0.001 * (u * u);
    const double turned = rate + (3 * gravity / 2.0 * sin_of(dice, angle) + 3.0 * u) * step_seconds;
    const double next_rate = bounded(turned, -fastest, fastest);
    at = {angle + next_rate * step_seconds, next_rate};
    return {-cost, false, false};
  }
  void observe(const Position& at, std::span<float> seen) const {
    seen[0] = static_cast<float>(libm ? std::cos(at[0]) : math::cos(at[0]));
    seen[1] = static_cast<float>(libm ? std::sin(at[0]) : math::sin(at[0]));
    seen[2] = static_cast<float>(at[1]);
  }

  std::string text(const Position& at) const {
    constexpr double middle_x = 12, middle_y = 5, across = 11, down = 5;
    Canvas page(25, 11);
    const double x = -math::sin(at[0]), y = -math::cos(at[0]);
    page.put(middle_x, 0, '+');
    page.line(middle_x, middle_y, middle_x + across * x, middle_y + down * y, '*');
    page.put(middle_x, middle_y, 'O');
    return page.text() + "angle " + thousandths(brought_round(at[0])) + " rad, " +
           thousandths(at[1]) + " rad/s\n";
  }
  // In metres; the motor in the middle of 2.4 m; a positive angle leans to the left.
  Drawing drawing(const Position& at) const {
    constexpr double middle = 1.2;
    const double x = middle - math::sin(at[0]), y = middle - math::cos(at[0]);
    Drawing picture{2 * middle, 2 * middle, {}};
    picture.circle(Ink::goal, middle, middle - 1.0, 0.05);
    picture.line(Ink::agent, {{middle, middle}, {x, y}}, 0.18);
    picture.circle(Ink::agent, x, y, 0.09).circle(Ink::line, middle, middle, 0.05);
    return picture;
  }
};

Result<World> make(const Parameters& parameters) {
  const Result<Settings> settings = read_parameters<Settings>("pendulum", parameters);
  if (!settings) return settings.error();
  const double lowest = -(pi * pi + 0.1 * fastest * fastest + 0.001 * strongest * strongest);
  const WorldFacts facts = control_facts(settings->limit, settings->seeding, {lowest, 0.0});
  const auto torques = static_cast<std::uint32_t>(settings->torques);
  return to_world("pendulum", Pendulum{torques, settings->gravity, facts.traits.libm}, facts,
                  settings->bins);
}

}  // namespace

extern const WorldEntry pendulum_world;
const WorldEntry pendulum_world{"pendulum",
                                "Pendulum-v1",
                                "a rod is swung up and held by a weak motor",
                                "Gymnasium Pendulum-v1, torques discretised",
                                make,
                                parameters_of<Settings>};

}  // namespace quoll
