#pragma once
// How much a bound grows over one move, rounded outward: the form of the Bellman inequality at
// discount 1, exact where the values are equal. A row is taken to sum to 1.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

/// An upper bound on sum + sign * (sum of p (value(s') - value(s))) for a choice of s; sign is 1
/// or -1.
inline double growth_up(const Mdp& mdp, const std::vector<double>& value, double sign, State s,
                        std::uint64_t choice, double sum) {
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    const double step = add_up(sign * value[mdp.next(o)], -sign * value[s]);
    const Meant p(mdp.probability(o));
    sum = add_up(sum, scale_up(step >= 0.0 ? p.upper : p.lower, step));
  }
  return sum;
}

}  // namespace quoll
