#pragma once
// Many draws from the standard normal distribution, a few nanoseconds each, with the same bits on
// every machine. Marsaglia, Tsang 2000 ("The ziggurat method for generating random variables"),
// with 53 random bits of their own for each number as in Doornik 2005.
//
// The half of the density f(x) = exp(-x^2 / 2) right of 0 is covered by 256 layers of one area: 255
// boxes from f(edge[i]) up to f(edge[i + 1]), i >= 1, and at the bottom what is left, to which the
// tail beyond edge[1] belongs. A number drawn in a layer is nearly always in the part of it that
// lies below f everywhere.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "quoll/base/random.hpp"

namespace quoll {

class Ziggurat {
 public:
  static const Ziggurat& normal();

  /// Nearly always one draw; seldom, in a border or the tail, some more.
  double draw(Rng& dice) const {
    const std::uint64_t bits = dice.next();
    const std::size_t layer = bits % layers;
    const double x = (2.0 * unit(bits) - 1.0) * edge_[layer];
    return std::fabs(x) < edge_[layer + 1] ? x : draw_border(dice, layer, x);
  }

 private:
  static constexpr std::size_t layers = 256;

  Ziggurat();
  double draw_border(Rng& dice, std::size_t layer, double x) const;

  std::array<double, layers + 1> edge_;    // falling; edge_[0]: as wide as the lowest layer would
                                           // be as a box, the last 0
  std::array<double, layers + 1> height_;  // f(edge), the first of no meaning
};

}  // namespace quoll
