#pragma once
// What the worlds of classic control share: float64 dynamics whose every expression is computed in
// the order of Gymnasium's source (classic_control), float32 observations.

#include <cmath>
#include <numbers>
#include <utility>

#include "quoll/env/dynamics.hpp"

namespace quoll {

inline constexpr double pi = std::numbers::pi;
inline constexpr double radian_in_degrees = 180.0 / std::numbers::pi;

/// x * x; with Gymnasium's dice the C library's pow(x, 2), which is not always that, as NumPy calls
/// it for `x ** 2`.
inline double square_of(auto&, double x) {
  return x * x;
}
inline double square_of(GuestDice&, double x) {
  // A compiler that sees the exponent would multiply.
  volatile double exponent = 2.0;
  return std::pow(x, exponent);
}

inline double bounded(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/// What these worlds declare: certain moves, and a step limit.
inline WorldFacts control_facts(std::uint64_t limit, Seeding seeding,
                                std::pair<double, double> rewards) {
  WorldFacts facts;
  facts.episode_steps = limit;
  facts.seeding = seeding;
  facts.traits.deterministic = true;
  facts.traits.reward_bounds = rewards;
  facts.traits.libm = seeding == Seeding::gymnasium;
  return facts;
}

}  // namespace quoll
