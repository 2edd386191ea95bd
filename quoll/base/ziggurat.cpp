#include "quoll/base/ziggurat.hpp"

#include "quoll/base/math.hpp"

namespace quoll {

namespace {
// Where the tail begins and the area of a layer, of 256 (Doornik 2005, table 1).
constexpr double tail = 3.6541528853610088, area = 0.00492867323399;

double density(double x) {
  return math::exp(-0.5 * x * x);
}
}  // namespace

Ziggurat::Ziggurat() {
  edge_[0] = area / density(tail);
  edge_[1] = tail;
  for (std::size_t i = 2; i < layers; ++i) {
    edge_[i] = std::sqrt(-2.0 * math::log(area / edge_[i - 1] + density(edge_[i - 1])));
  }
  edge_[layers] = 0.0;
  for (std::size_t i = 0; i <= layers; ++i) height_[i] = density(edge_[i]);
}

const Ziggurat& Ziggurat::normal() {
  static const Ziggurat one;
  return one;
}

double Ziggurat::draw_border(Rng& dice, std::size_t layer, double x) const {
  if (layer == 0) {
    // Marsaglia 1964: the tail by an exponential that is a little too high.
    double beyond = 0.0, other = 0.0;
    do {
      beyond = -math::log(1.0 - dice.uniform()) / tail;
      other = -math::log(1.0 - dice.uniform());
    } while (2.0 * other < beyond * beyond);
    return std::copysign(tail + beyond, x);
  }
  const double height = height_[layer] + dice.uniform() * (height_[layer + 1] - height_[layer]);
  return height < density(x) ? x : draw(dice);
}

}  // namespace quoll
