#pragma once
// Values of a counted model for somebody who hopes for the best: what was tried little gets a
// bonus.

#include <cstdint>
#include <vector>

#include "quoll/learn/tabular/counted_model.hpp"

namespace quoll {

/// The bonus of empirical Bernstein form, for a pair tried n times:
///   sqrt(B Var[r + discount U(s')] / n) + C range sqrt(H) / n
/// Maurer, Pontil 2009 for the form; Azar, Osband, Munos 2017 for its use on values.
struct Optimism {
  double discount = 1.0;
  double most = 0.0;         ///< no value is above this
  double variance = 2.0;     ///< B
  double range_roots = 0.0;  ///< C * range * sqrt(H)
  std::uint32_t known_after = 1;
  double precision = 1e-3;  ///< of the values
};

/// Improves `value` (per state, at least the answer) and `pair_value` to the solution of
///   U(s,a) = min(most, r(s,a) + bonus(s,a) + discount sum P U),  U(s) = max_a U(s,a)
/// by modified policy iteration with as many evaluation sweeps as it takes, so that states which
/// hold each other up fall at once and not by a factor a step.
void improve_optimistic_values(const CountedModel& model, const std::vector<std::uint64_t>& begin,
                               const Optimism& optimism, std::vector<double>& value,
                               std::vector<double>& pair_value);

}  // namespace quoll
