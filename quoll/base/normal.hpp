#pragma once
// A draw from the standard normal distribution, with the same bits on every machine.

#include <cmath>

#include "quoll/base/math.hpp"
#include "quoll/base/random.hpp"

namespace quoll {

/// Box, Muller 1958; two draws.
inline double draw_normal(Rng& dice) {
  const double radius = std::sqrt(-2.0 * math::log(1.0 - dice.uniform()));
  constexpr double turn = 6.283185307179586;
  return radius * math::cos(turn * dice.uniform());
}

}  // namespace quoll
