#pragma once
// Randomness handed to a world. A world's functions take `auto& dice` and ask for
//   dice.uniform()          a real in [0, 1)
//   dice.below(n)           a whole number in [0, n)
//   between(dice, low, high), chance(dice, p), pick(dice, running sums)   made of those
//   sin_of(dice, x), cos_of(dice, x)   the dice decide whose functions
// and are instantiated for exactly three kinds of dice: Rng (base/random.hpp), one stream for
// starts and one for steps; GuestDice, one generator for both in Gymnasium's order, with the C
// library's functions as NumPy calls them; Branches (branches.hpp), all that chance can do.

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/math.hpp"
#include "quoll/base/numpy_random.hpp"
#include "quoll/base/random.hpp"

namespace quoll {

/// Where a world's random numbers come from.
enum class Seeding : std::uint8_t { quoll, gymnasium };
inline constexpr std::string_view seeding_names[] = {"quoll", "gymnasium"};

/// NumPy's generator, seeded as Gymnasium seeds it, or a list of numbers given from outside.
class GuestDice {
 public:
  explicit GuestDice(std::uint64_t seed) : numpy_(seed) {}
  /// Numbers to give out in order: uniform() gives a number as it is, below(n) takes it as the
  /// whole number it must be.
  explicit GuestDice(std::shared_ptr<const std::vector<double>> tape)
      : numpy_(0), tape_(std::move(tape)) {}

  double uniform() { return tape_ ? from_tape(1.0) : numpy_.random(); }
  std::uint32_t below(std::uint32_t n) {
    return tape_ ? static_cast<std::uint32_t>(from_tape(n)) : numpy_.integers(n);
  }
  /// The generator itself, for the draws of one world only; a tape answers instead where it can.
  NumpyRandom& numpy() { return numpy_; }
  /// False once a tape was used up or had a number that did not fit.
  bool good() const { return good_; }

  void persist(Archive& archive) {
    archive("numpy", numpy_);
    archive("taken", taken_);
    archive("good", good_);
  }

 private:
  double from_tape(double limit) {
    if (taken_ >= tape_->size() || !((*tape_)[taken_] >= 0.0 && (*tape_)[taken_] < limit)) {
      good_ = false;
      return 0.0;
    }
    return (*tape_)[taken_++];
  }

  NumpyRandom numpy_;
  std::shared_ptr<const std::vector<double>> tape_;
  std::uint64_t taken_ = 0;
  bool good_ = true;
};

/// A real in [low, high), as NumPy computes it.
double between(auto& dice, double low, double high) {
  return low + (high - low) * dice.uniform();
}

/// True with probability p; one draw.
bool chance(auto& dice, double p) {
  return dice.uniform() < p;
}

/// The first index whose running sum of probabilities exceeds a uniform draw: how Gymnasium's table
/// worlds sample. The last index takes what rounding leaves over.
std::size_t pick(auto& dice, std::span<const double> running_sums) {
  const double draw = dice.uniform();
  std::size_t index = 0;
  while (index + 1 < running_sums.size() && !(running_sums[index] > draw)) ++index;
  return index;
}

inline double sin_of(Rng&, double x) {
  return math::sin(x);
}
inline double cos_of(Rng&, double x) {
  return math::cos(x);
}
inline double sin_of(GuestDice&, double x) {
  return std::sin(x);
}
inline double cos_of(GuestDice&, double x) {
  return std::cos(x);
}

}  // namespace quoll
