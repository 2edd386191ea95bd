// MinAtar's Freeway: a chicken crosses eight lanes of cars, as often as it can in 2,501 steps. What
// all five games share stands in minatar.hpp.
//
// Channels: chicken, car, speed1 to speed5; the cell behind a car carries the flag of its speed (a
// car of speed k moves on every (k+1)-th step). Minimal actions: stay, up, down. Reward 1 for a
// crossing. There is no ramp.
//
// One step, in this order:
//   up or down, only when move_timer is 0, which then becomes 3: the chicken moves one row (at row
//     9 down takes the move too).
//   At row 0: reward 1, all cars get new speeds and directions where they are, and the chicken is
//     back at row 9.
//   Each car: a timer of 0 becomes the car's speed and it moves one cell, around the edge; any
//     other falls by 1. A car at the chicken before or after that sends it to row 9.
//   move_timer falls by 1 unless 0; steps_left falls by 1, and below 0 is the end.
//
// Draws of a start, and of a step with a crossing after the sticky one: eight times below(5), speed
// minus 1 of the cars from the top; then eight times uniform, below 1/2 to the left. (Exactly 1/2
// gives a car without a direction in the original, which then cannot show it; here it goes right.)
//
// State: y of the chicken; of the cars of rows 1-8 car_x, car_timer, and car_speed, negative to the
// left; move_timer, steps_left.

#include "quoll/env/worlds/minatar.hpp"

namespace quoll {
namespace {

using namespace minatar;

struct Freeway {
  static constexpr Channel channels[] = {{"chicken", 'K', Ink::agent}, {"car", 'C', Ink::danger},
                                         {"speed1", '1', Ink::faint},  {"speed2", '2', Ink::faint},
                                         {"speed3", '3', Ink::faint},  {"speed4", '4', Ink::faint},
                                         {"speed5", '5', Ink::faint}};
  static constexpr Move minimal[] = {stay, up, down};
  static constexpr std::pair<double, double> reward_bounds{0.0, 1.0};
  static constexpr bool ramps = false;

  struct Position : Common {
    std::int8_t y = 9;
    std::array<std::int8_t, 8> car_x{}, car_timer{}, car_speed{};
    std::int8_t move_timer = 3;
    std::int16_t steps_left = 2500;

    template <class Archive>
    void persist(Archive& archive) {
      persist_within(archive, "y", y, 1, 9);
      archive("car_x", car_x);
      archive("car_timer", car_timer);
      archive("car_speed", car_speed);
      persist_within(archive, "move_timer", move_timer, 0, 3);
      persist_within(archive, "steps_left", steps_left, -1, 2500);
      persist_common(archive);
      if (archive.saving()) return;
      for (std::size_t i = 0; i < 8; ++i) {
        const int speed = car_speed[i];
        if (outside(car_x[i])) archive.fail("car_x: whole numbers from 0 to 9 expected");
        if (car_timer[i] < 0 || car_timer[i] > 5) {
          archive.fail("car_timer: whole numbers from 0 to 5 expected");
        }
        if (speed == 0 || speed < -5 || speed > 5) {
          archive.fail("car_speed: whole numbers from -5 to 5 without 0 expected");
        }
      }
    }
  };

  static void new_speeds(Position& at, auto& dice) {
    for (std::size_t i = 0; i < 8; ++i) {
      at.car_timer[i] = static_cast<std::int8_t>(1 + dice.below(5));
    }
    for (std::size_t i = 0; i < 8; ++i) {
      const int speed = at.car_timer[i];
      at.car_speed[i] = static_cast<std::int8_t>(chance(dice, 0.5) ? -speed : speed);
    }
  }

  static Position start(auto& dice) {
    Position at;
    new_speeds(at, dice);
    return at;
  }

  static double act(Position& at, Move move, bool, auto& dice) {
    double reward = 0.0;
    if (at.move_timer == 0 && move_y[move] != 0) {
      at.move_timer = 3;
      at.y = static_cast<std::int8_t>(std::min(at.y + move_y[move], 9));
      if (at.y == 0) {
        reward = 1.0;
        new_speeds(at, dice);
        at.y = 9;
      }
    }
    // Only the car in the chicken's row can hit it; rows 0 and 9 have none.
    const std::array<std::int8_t, 8> before = at.car_x;
    for (std::size_t i = 0; i < 8; ++i) {
      const int speed = at.car_speed[i];
      const bool moves = at.car_timer[i] == 0;
      const int step = moves ? (speed > 0 ? 1 : -1) : 0;
      const int x = at.car_x[i] + step;
      at.car_timer[i] =
          static_cast<std::int8_t>(moves ? (speed > 0 ? speed : -speed) : at.car_timer[i] - 1);
      at.car_x[i] = static_cast<std::int8_t>(x < 0 ? 9 : x > 9 ? 0 : x);
    }
    if (at.y < 9 && (before[at.y - 1] == 4 || at.car_x[at.y - 1] == 4)) at.y = 9;
    at.move_timer = static_cast<std::int8_t>(at.move_timer - (at.move_timer > 0));
    --at.steps_left;
    at.over = at.steps_left < 0;
    return reward;
  }

  static void show(const Position& at, Flags<7> flags) {
    flags.set(0, 4, at.y);
    for (int i = 0; i < 8; ++i) {
      const int x = at.car_x[i], speed = at.car_speed[i];
      flags.set(1, x, i + 1);
      const int behind = speed > 0 ? x - 1 : x + 1;
      flags.set(static_cast<std::size_t>(1 + (speed > 0 ? speed : -speed)),
                behind < 0   ? 9
                : behind > 9 ? 0
                             : behind,
                i + 1);
    }
  }
};

}  // namespace

extern const WorldEntry minatar_freeway_world;
const WorldEntry minatar_freeway_world{
    "minatar-freeway",
    "MinAtar/Freeway-v0 MinAtar/Freeway-v1:minimal=true",
    "MinAtar: a chicken crosses eight lanes of cars",
    "Young and Tian 2019, arXiv 1903.03176; MinAtar 1.0.15",
    [](const Parameters& given) { return minatar::make<Freeway>("minatar-freeway", given); },
    parameters_of<minatar::SettingsOf<Freeway>>};

}  // namespace quoll
