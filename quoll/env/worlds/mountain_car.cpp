// Mountain car: a car in a valley, too weak for the hill on the right; it must swing up. Moore
// 1990, "Efficient memory-based learning for robot control"; constants of Sutton, Barto 2018,
// example 10.1, as in Gymnasium's MountainCar.
//
// State, as JSON: [position, velocity], float64, position in [-1.2, 0.6], velocity in +-0.07; the
// valley's height is sin(3 position). Observation: the same as float32. Actions: left, coast,
// right. The episode ends at position >= 0.5 with velocity >= goal_velocity, and is cut off after
// `limit` steps. Reward -1 for every step, the last included.
//
// Draws: a start takes one, the position, uniform in [-0.6, -0.4), velocity 0; a step none.
// Bins (--with bins=20,20) lie between the bounds of position and velocity.

#include <array>
#include <cmath>

#include "quoll/env/binned.hpp"
#include "quoll/env/worlds/canvas.hpp"
#include "quoll/env/worlds/control.hpp"

namespace quoll {
namespace {

constexpr double lowest = -1.2, highest = 0.6, fastest = 0.07, goal = 0.5;
constexpr double force = 0.001, gravity = 0.0025;

struct Settings {
  double goal_velocity = 0.0;
  std::uint64_t limit = 200;
  std::string bins;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe("goal_velocity", goal_velocity, 0.0, fastest,
             "least velocity that counts at the goal");
    describe("limit", limit, 1.0, 1e15, "steps after which an episode is cut off");
    describe("bins", bins,
             "numbers of bins for position and velocity, such as 20,20: states become numbers");
    describe.choice("seeding", seeding, seeding_names,
                    "whose random numbers and whose cosine: this program's own or Gymnasium's");
  }
};

struct MountainCar {
  using Position = std::array<double, 2>;
  double goal_velocity;

  Spaces spaces() const { return {.actions = 3, .observation = 2}; }
  std::vector<std::string> action_names() const { return {"left", "coast", "right"}; }
  std::vector<Measured> measured() const {
    return {{"position", lowest, highest}, {"velocity", -fastest, fastest}};
  }

  Position start(auto& dice) const { return {between(dice, -0.6, -0.4), 0.0}; }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (arrived(at)) return {0.0, true, false};
    auto [position, velocity] = at;
    velocity +=
        (static_cast<double>(action) - 1.0) * force + cos_of(dice, 3 * position) * (-gravity);
    velocity = bounded(velocity, -fastest, fastest);
    position = bounded(position + velocity, lowest, highest);
    if (position == lowest && velocity < 0) velocity = 0;
    at = {position, velocity};
    return {-1.0, arrived(at), false};
  }
  void observe(const Position& at, std::span<float> seen) const {
    seen[0] = static_cast<float>(at[0]);
    seen[1] = static_cast<float>(at[1]);
  }
  bool arrived(const Position& at) const { return at[0] >= goal && at[1] >= goal_velocity; }

  static double height(double position) { return 0.45 * math::sin(3 * position) + 0.55; }

  // 0.04 a letter across; 0.15 a line up.
  std::string text(const Position& at) const {
    constexpr int width = 46, rows = 8;
    const auto row = [](double position) { return 1.0 + (1.0 - height(position)) / 0.15; };
    const auto column = [](double position) { return (position - lowest) / 0.04; };
    Canvas page(width, rows);
    for (int i = 0; i < width; ++i) page.put(i, row(lowest + 0.04 * i), '.');
    page.put(column(goal), row(goal) - 1, 'F');
    page.put(column(at[0]), row(at[0]), 'o');
    return page.text() + "position " + thousandths(at[0]) + ", velocity " +
           thousandths(at[1] * 1000) + " thousandths a step\n";
  }
  Drawing drawing(const Position& at) const {
    constexpr double high = 1.3;
    Drawing picture{highest - lowest, high, {}};
    constexpr int pieces = 90;
    std::vector<std::pair<double, double>> hills;
    for (int i = 0; i <= pieces; ++i) {
      const double x = (highest - lowest) * i / pieces;
      hills.emplace_back(x, high - height(lowest + x));
    }
    std::vector<std::pair<double, double>> ground = hills;
    ground.insert(ground.end(), {{highest - lowest, high}, {0.0, high}});
    picture.polygon(Ink::floor, std::move(ground)).line(Ink::line, std::move(hills), 0.01);
    const double pole = goal - lowest, foot = high - height(goal), top = foot - 0.18;
    picture.line(Ink::line, {{pole, foot}, {pole, top}}, 0.01);
    picture.polygon(Ink::goal, {{pole, top}, {pole + 0.09, top + 0.03}, {pole, top + 0.06}});
    // The car stands on the slope: along the tangent (1, 1.35 cos 3x), y down.
    const double slope = 1.35 * math::cos(3 * at[0]), length = std::sqrt(1 + slope * slope);
    const double along_x = 1 / length, along_y = -slope / length;
    const double x = at[0] - lowest, y = high - height(at[0]);
    const auto point = [&](double along, double above) {
      return std::pair(x + along * along_x + above * along_y,
                       y + along * along_y - above * along_x);
    };
    picture.polygon(Ink::agent,
                    {point(-0.06, 0.03), point(0.06, 0.03), point(0.06, 0.065), point(0.03, 0.065),
                     point(0.02, 0.1), point(-0.04, 0.1), point(-0.06, 0.065)});
    for (const double along : {-0.035, 0.035}) {
      const auto [wheel_x, wheel_y] = point(along, 0.025);
      picture.circle(Ink::line, wheel_x, wheel_y, 0.022);
    }
    return picture;
  }
};

Result<World> make(const Parameters& parameters) {
  const Result<Settings> settings = read_parameters<Settings>("mountain-car", parameters);
  if (!settings) return settings.error();
  WorldFacts facts = control_facts(settings->limit, settings->seeding, {-1.0, 0.0});
  facts.traits.solved = -110.0;  // Gymnasium's reward_threshold
  return to_world("mountain-car", MountainCar{settings->goal_velocity}, facts, settings->bins);
}

}  // namespace

extern const WorldEntry mountain_car_world;
const WorldEntry mountain_car_world{"mountain-car",
                                    "MountainCar-v0",
                                    "a car too weak for the hill must swing up from the valley",
                                    "Moore 1990; Sutton, Barto 2018; Gymnasium MountainCar-v0",
                                    make,
                                    parameters_of<Settings>};

}  // namespace quoll
