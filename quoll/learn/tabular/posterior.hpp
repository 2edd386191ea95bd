#pragma once
// A model drawn from what experience leaves possible.

#include <cstdint>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/learn/tabular/planning.hpp"

namespace quoll {

/// A draw from the Gamma distribution of this shape and scale 1 (Marsaglia, Tsang 2000).
double draw_gamma(double shape, Rng& dice);

struct Posterior {
  double low = 0.0, high = 1.0;  ///< range of rewards
  bool certain = false;          ///< no noise: what was tried is known

  /// The optimal value of each pair in a model drawn anew; empty where that is not defined.
  std::vector<double> draw(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                           const Planning& planning, Rng& dice) const;
};

}  // namespace quoll
