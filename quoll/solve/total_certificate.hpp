#pragma once
// Proves bounds on total reward at discount 1 for a stochastic model.
//
// With w a bound on the expected number of moves left under every nearly optimal choice, L = V - e
// w and U = V + e w satisfy T_pi L >= L and T U <= U if V is accurate to within e per move. Both
// are then checked move by move with outward rounding, as sums of p (U(s') - U(s)), which is exact
// where U is constant; rows are taken to sum to 1. Sets of states between which one moves for
// nothing (free_parts.hpp) share one value. What the policy is sure of is proved in any case in
// which it ends; the upper bound stays open where rewards balance in numbers no double can hold.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct TotalCertificate {
  std::vector<double> lower;  ///< -infinity where not proved
  std::vector<double> upper;  ///< +infinity where not proved
};

/// `value` approximates the value of `policy` in the live states; ends are worth 0, other states
/// -infinity in both bounds. Cost: some sweeps, as many as it takes to follow episodes to their
/// end.
TotalCertificate certify_total(const Mdp& mdp, const std::vector<std::uint8_t>& live,
                               const std::vector<Action>& policy, const std::vector<double>& value);

}  // namespace quoll
