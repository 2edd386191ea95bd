#pragma once
// Riding a bicycle at 10 km/h: balancing it, or riding it to a goal (Randlov, Alstrom 1998,
// "Learning to drive a bicycle using reinforcement learning and shaping", ICML, pp. 463-471).
//
// Metres, seconds, radians; x to the east, y to the north. omega: the bicycle's tilt from the
// vertical, positive to the left; theta: the handlebars' turn, positive to the left; psi: the
// heading, from the north to the left. Steps are 0.01 s.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/math.hpp"
#include "quoll/base/settings.hpp"
#include "quoll/env/dice.hpp"
#include "quoll/env/drawing.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/env/measured.hpp"

namespace quoll {

/// How a step is computed: see bicycle.cpp.
enum class Integration : std::uint8_t { original, euler };
inline constexpr std::string_view integration_names[] = {"original", "euler"};
enum class BicycleTask : std::uint8_t { balance, goal };
inline constexpr std::string_view bicycle_task_names[] = {"balance", "goal"};
enum class Shaping : std::uint8_t { standard, none, potential };
inline constexpr std::string_view shaping_names[] = {"standard", "none", "potential"};

struct BicycleSettings {
  Integration integration = Integration::original;
  BicycleTask task = BicycleTask::balance;
  Shaping shaping = Shaping::standard;
  double shaping_weight = 0.1;
  double noise = 0.02;
  double heading = 90.0;
  bool any_heading = false;
  double discount = 0.99;

  void describe(Describer& describe);
  std::string_view needs(std::string_view name) const;
};

/// Where a ride went, for pictures: at most 512 points, evenly spaced in time.
struct Track {
  std::vector<double> x, y;
  std::uint32_t stride = 10;  ///< steps from one point to the next
  std::uint32_t wait = 0;     ///< steps until the next point

  void add(double at_x, double at_y);
  void persist(Archive& archive);
};

struct Bicycle {
  static constexpr double length = 1.11;  ///< between the points where the tyres touch
  static constexpr double fall = 0x1.acee9f37bebd6p-3;  ///< 12 degrees of tilt
  static constexpr double stop = 0x1.657184ae74487p+0;  ///< 80 degrees, the handlebars' limit
  static constexpr double pi = 0x1.921fb54442d18p+1;
  static constexpr double goal_x = 1000.0, goal_y = 0.0, goal_radius = 10.0;

  struct Position {
    double omega = 0, omega_rate = 0, omega_acceleration = 0;
    double theta = 0, theta_rate = 0;
    double x_front = 0, y_front = 0, x_back = 0, y_back = 0;
    double psi = 0;
    Track track;  ///< no part of the state that people see and give

    template <class A>
    void persist(A& archive) {
      archive("omega", omega);
      archive("omega_rate", omega_rate);
      archive("omega_acceleration", omega_acceleration);
      archive("theta", theta);
      archive("theta_rate", theta_rate);
      archive("x_front", x_front);
      archive("y_front", y_front);
      archive("x_back", x_back);
      archive("y_back", y_back);
      archive("psi", psi);
      if constexpr (std::is_same_v<A, Archive>) {
        archive("track", track);
      } else if (!archive.saving()) {
        track = {};
      }
      if (archive.saving()) return;
      if (const char* const reason = impossible()) archive.fail(reason);
    }
    /// What cannot be, or nullptr.
    const char* impossible() const;
  };

  BicycleSettings settings;

  Spaces spaces() const;
  std::vector<std::string> action_names() const;
  std::vector<Measured> measured() const;
  Position start(auto& dice) const {
    return start_at(settings.any_heading ? between(dice, -180.0, 180.0) : settings.heading);
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    const double sway = between(dice, -settings.noise, settings.noise);
    return ride(at, action, sway);
  }
  void observe(const Position& at, std::span<float> x) const;
  std::string text(const Position& at) const;
  Drawing drawing(const Position& at) const;

  /// A start that heads so many degrees to the left of the goal's direction.
  Position start_at(double degrees) const;
  /// A step whose noise is given: metres added to the rider's displacement.
  Feedback ride(Position& at, Action action, double sway) const;
  /// The goal's direction as seen from the heading, positive to the left, in [-pi, pi].
  static double angle_to_goal(const Position& at);

 private:
  bool fallen(const Position& at) const { return std::fabs(at.omega) > fall; }
  bool at_goal(const Position& at) const;
  double potential(const Position& at) const;
};

}  // namespace quoll
