// Acrobot: two links hang from a fixed joint, and a motor between them swings the tip above the
// bar. Sutton 1996, "Generalization in reinforcement learning"; constants of Gymnasium's Acrobot:
// both links 1 m and 1 kg, centre of mass in the middle, moment of inertia 1, gravity 9.8.
//
// State, as JSON: [angle of link 1 (rad, 0 = down), angle of link 2 relative to link 1, and their
// rates (rad/s)], float64; angles in +-pi, rates in +-4 pi and +-9 pi. Observation: cos and sin of
// angle 1, cos and sin of angle 2, the rates, float32. Actions: torque -1, 0, +1; steps of 0.2 s,
// one step of the classical Runge-Kutta method. equations=book follows Sutton, Barto and the Java
// program, nips the paper. The episode ends when the tip is more than 1 m above the joint,
// -cos a1 - cos(a1 + a2) > 1, and is cut off after `limit` steps. Reward -1, at the end 0.
//
// Draws: a start takes four, in the order of the state, each uniform in [-0.1, 0.1) and rounded to
// float32; a step none. Bins (--with bins=6,6,6,6,8,8) lie between: cosines and sines +-1, the
// rates +-4 pi and +-9 pi.

#include <array>
#include <cmath>

#include "quoll/env/binned.hpp"
#include "quoll/env/worlds/canvas.hpp"
#include "quoll/env/worlds/control.hpp"

namespace quoll {
namespace {

constexpr double fastest_1 = 4 * pi, fastest_2 = 9 * pi;
constexpr double step_seconds = 0.2;
constexpr double gravity = 9.8;

enum class Equations : std::uint8_t { book, nips };
constexpr std::string_view equations_names[] = {"book", "nips"};

struct Settings {
  Equations equations = Equations::book;
  std::uint64_t limit = 500;
  std::string bins;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe.choice("equations", equations, equations_names,
                    "the second link's acceleration as the book or as the paper prints it");
    describe("limit", limit, 1.0, 1e15, "steps after which an episode is cut off");
    describe("bins", bins,
             "numbers of bins for the six observed numbers, such as 6,6,6,6,8,8: states become "
             "numbers");
    describe.choice("seeding", seeding, seeding_names,
                    "whose random numbers and whose sine: this program's own or Gymnasium's");
  }
};

// x - 2 pi or x + 2 pi as often as needed to come into [-pi, pi].
double wrapped(double x) {
  if (std::fabs(x) > 1e4) x = std::fmod(x, 2 * pi);
  while (x > pi) x -= 2 * pi;
  while (x < -pi) x += 2 * pi;
  return x;
}

struct Acrobot {
  using Position = std::array<double, 4>;
  Equations equations;
  bool libm;  ///< of the observation

  Spaces spaces() const { return {.actions = 3, .observation = 6}; }
  std::vector<std::string> action_names() const { return {"torque -1", "torque 0", "torque +1"}; }
  std::vector<Measured> measured() const {
    return {{"cos 1", -1, 1},
            {"sin 1", -1, 1},
            {"cos 2", -1, 1},
            {"sin 2", -1, 1},
            {"rate 1", -fastest_1, fastest_1},
            {"rate 2", -fastest_2, fastest_2}};
  }

  Position start(auto& dice) const {
    Position at;
    for (double& number : at) number = double{static_cast<float>(between(dice, -0.1, 0.1))};
    return at;
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (swung_up(at, dice)) return {0.0, true, false};
    const double torque = static_cast<double>(action) - 1.0;
    constexpr double half = step_seconds / 2.0, sixth = step_seconds / 6.0;
    const Position k1 = slope(at, torque, dice);
    const Position k2 = slope(along(at, half, k1), torque, dice);
    const Position k3 = slope(along(at, half, k2), torque, dice);
    const Position k4 = slope(along(at, step_seconds, k3), torque, dice);
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] = at[i] + sixth * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    at = {wrapped(at[0]), wrapped(at[1]), bounded(at[2], -fastest_1, fastest_1),
          bounded(at[3], -fastest_2, fastest_2)};
    const bool ended = swung_up(at, dice);
    return {ended ? 0.0 : -1.0, ended, false};
  }
  void observe(const Position& at, std::span<float> seen) const {
    // NumPy takes the float32 functions for a float32 array: that is what a start is.
    const bool start = is_start(at);
    for (std::size_t i = 0; i < 2; ++i) {
      const double angle = at[i];
      seen[2 * i] = !libm   ? rounded(math::cos(angle))
                    : start ? std::cos(rounded(angle))
                            : rounded(std::cos(angle));
      seen[2 * i + 1] = !libm   ? rounded(math::sin(angle))
                        : start ? std::sin(rounded(angle))
                                : rounded(std::sin(angle));
      seen[4 + i] = rounded(at[2 + i]);
    }
  }

  std::string text(const Position& at) const {
    constexpr double middle_x = 20, middle_y = 9, across = 9, down = 4;
    const auto [x1, y1, x2, y2] = joints(at);
    Canvas page(41, 18);
    for (int i = 0; i < 41; i += 2) page.put(i, middle_y - down, '-');
    const auto column = [&](double x) { return middle_x + across * x; };
    const auto row = [&](double y) { return middle_y + down * y; };
    page.line(column(0), row(0), column(x1), row(y1), '*');
    page.line(column(x1), row(y1), column(x2), row(y2), '.');
    page.put(column(0), row(0), 'O');
    page.put(column(x1), row(y1), 'o');
    return page.text() + "angles " + thousandths(at[0]) + ", " + thousandths(at[1]) + " rad   " +
           thousandths(at[2]) + ", " + thousandths(at[3]) + " rad/s\n";
  }
  // In metres; the joint in the middle of 4.4 m.
  Drawing drawing(const Position& at) const {
    constexpr double middle = 2.2;
    const auto [x1, y1, x2, y2] = joints(at);
    Drawing picture{2 * middle, 2 * middle, {}};
    picture.line(Ink::goal, {{0.0, middle - 1.0}, {2 * middle, middle - 1.0}}, 0.02);
    picture.line(Ink::agent, {{middle, middle}, {middle + x1, middle + y1}}, 0.18);
    picture.line(Ink::other, {{middle + x1, middle + y1}, {middle + x2, middle + y2}}, 0.14);
    picture.circle(Ink::line, middle, middle, 0.1);
    picture.circle(Ink::line, middle + x1, middle + y1, 0.08);
    picture.circle(Ink::faint, middle + x2, middle + y2, 0.07);
    return picture;
  }

 private:
  static float rounded(double x) { return static_cast<float>(x); }
  static bool is_start(const Position& at) {
    bool start = true;
    for (const double x : at) start &= std::fabs(x) <= 0.1f && x == double{rounded(x)};
    return start;
  }
  static bool swung_up(const Position& at, auto& dice) {
    const double elbow = cos_of(dice, at[0]), tip = cos_of(dice, at[1] + at[0]);
    return !(-elbow - tip <= 1.0);
  }
  static Position along(const Position& at, double seconds, const Position& slope) {
    Position to;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = at[i] + seconds * slope[i];
    return to;
  }
  // The equations of motion with every mass, length and inertia put in; multiplications by 1 and
  // 0.5 lose nothing, so the bits are those of the general formula.
  Position slope(const Position& at, double torque, auto& dice) const {
    const auto [angle_1, angle_2, rate_1, rate_2] = at;
    const double cosine_2 = cos_of(dice, angle_2), sine_2 = sin_of(dice, angle_2);
    const double d1 = 0.25 + (1.25 + cosine_2) + 1.0 + 1.0;
    const double d2 = (0.25 + 0.5 * cosine_2) + 1.0;
    const double phi_2 = 0.5 * gravity * cos_of(dice, angle_1 + angle_2 - pi / 2.0);
    const double phi_1 = -0.5 * square_of(dice, rate_2) * sine_2 - rate_2 * rate_1 * sine_2 +
                         1.5 * gravity * cos_of(dice, angle_1 - pi / 2.0) + phi_2;
    const double below = 1.25 - square_of(dice, d2) / d1;
    double above = torque + d2 / d1 * phi_1;
    if (equations == Equations::book) above = above - 0.5 * square_of(dice, rate_1) * sine_2;
    const double acceleration_2 = (above - phi_2) / below;
    const double acceleration_1 = -(d2 * acceleration_2 + phi_1) / d1;
    return {rate_1, rate_2, acceleration_1, acceleration_2};
  }
  // Elbow and tip seen from the joint, y down.
  static std::array<double, 4> joints(const Position& at) {
    const double x = math::sin(at[0]), y = math::cos(at[0]), both = at[0] + at[1];
    return {x, y, x + math::sin(both), y + math::cos(both)};
  }
};

Result<World> make(const Parameters& parameters) {
  const Result<Settings> settings = read_parameters<Settings>("acrobot", parameters);
  if (!settings) return settings.error();
  WorldFacts facts = control_facts(settings->limit, settings->seeding, {-1.0, 0.0});
  facts.traits.solved = -100.0;  // Gymnasium's reward_threshold
  return to_world("acrobot", Acrobot{settings->equations, facts.traits.libm}, facts,
                  settings->bins);
}

}  // namespace

extern const WorldEntry acrobot_world;
const WorldEntry acrobot_world{"acrobot",
                               "Acrobot-v1",
                               "two hanging links, a motor between them, a bar to reach above",
                               "Sutton 1996; Gymnasium Acrobot-v1",
                               make,
                               parameters_of<Settings>};

}  // namespace quoll
