#pragma once
// Dice that go through everything chance can do. A step is repeated: each time the draws take
// another of the possibilities there are, and in the end each combination was taken once, with its
// probability.
//
//   dice.begin();
//   do {
//     ... what draws from dice ...    // has probability dice.probability()
//   } while (dice.next());
//
// below(n) has n possibilities. A real number of uniform() has as many as the comparisons with it
// leave open: `dice.uniform() < 0.1` has two, and so have chance and pick of env/dice.hpp theirs.
// Whoever takes it as a number asks for one of a continuum; that cannot be gone through and is a
// fault.

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "quoll/base/math.hpp"
#include "quoll/base/random.hpp"

namespace quoll {

class Branches {
 public:
  /// In one step; a loop that draws until something fits has no end here.
  static constexpr std::size_t most_draws = 1000;

  /// A real in [0, 1) of which only the interval is known in which it lies, narrower after each
  /// comparison. Valid until the path ends.
  class Real {
   public:
    operator double() const { return dice_->as_number(place_); }
    bool below(double bound) const { return dice_->is_below(place_, bound); }

   private:
    friend class Branches;
    Real(Branches& dice, std::size_t place) : dice_(&dice), place_(place) {}
    Branches* dice_;
    std::size_t place_;
  };

  Real uniform();
  std::uint32_t below(std::uint32_t n);

  /// Before the first path of a step.
  void begin();
  /// After a path: goes on to the next; false when there is none, or after a fault.
  bool next();
  /// Of the path that was taken.
  double probability() const { return probability_; }
  /// Why the step cannot be gone through, as the end of a sentence; empty = it can. After a fault
  /// the draws are those of a generator, so that what draws comes to its end.
  std::string_view fault() const { return fault_; }

 private:
  struct Decision {
    std::uint32_t taken, of;
  };
  struct Interval {
    double low, high;
  };
  std::uint32_t decide(std::uint32_t possibilities);
  bool is_below(std::size_t place, double bound);
  double as_number(std::size_t place);
  void rewind();

  std::vector<Decision> path_;
  std::vector<Interval> reals_;
  std::size_t depth_ = 0;
  double probability_ = 1.0;
  std::string_view fault_;
  Rng fallback_{};
};

// That it is just the bound has no probability. Templates, so that a float is no worse a match than
// a double.
template <class N>
concept Bound = std::is_arithmetic_v<N>;
bool operator<(Branches::Real u, Bound auto bound) {
  return u.below(static_cast<double>(bound));
}
bool operator<=(Branches::Real u, Bound auto bound) {
  return u < bound;
}
bool operator>(Branches::Real u, Bound auto bound) {
  return !(u < bound);
}
bool operator>=(Branches::Real u, Bound auto bound) {
  return !(u < bound);
}
bool operator<(Bound auto bound, Branches::Real u) {
  return u > bound;
}
bool operator<=(Bound auto bound, Branches::Real u) {
  return u > bound;
}
bool operator>(Bound auto bound, Branches::Real u) {
  return u < bound;
}
bool operator>=(Bound auto bound, Branches::Real u) {
  return u < bound;
}

/// The first index whose running sum exceeds a uniform draw, as pick of env/dice.hpp.
std::size_t pick(Branches& dice, std::span<const double> running_sums);

/// A real in [low, high): one possibility where both are the same.
inline double between(Branches& dice, double low, double high) {
  return low == high ? low : low + (high - low) * dice.uniform();
}

inline double sin_of(Branches&, double x) {
  return math::sin(x);
}
inline double cos_of(Branches&, double x) {
  return math::cos(x);
}

}  // namespace quoll
