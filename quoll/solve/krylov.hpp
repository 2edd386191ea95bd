#pragma once
// A Krylov method for the value of a policy.

#include <cstdint>
#include <vector>

#include "quoll/solve/policy_rows.hpp"

namespace quoll {

struct Krylov {
  std::uint64_t products = 0;  ///< sweeps over the rows
  bool reached = false;        ///< the residual is as small as asked
};

/// Improves `value` towards the solution of V = r + discount * P V by BiCGSTAB (van der Vorst 1992)
/// until the norm of the residual is `share` of what it was; value stays as it is if it breaks down
/// or 500 products do not do. Sums run in the order of the states: the bits do not depend on
/// `threads`. Memory: seven numbers a state.
Krylov improve_by_krylov(const PolicyRows& rows, double discount, double share, unsigned threads,
                         std::vector<double>& value);

}  // namespace quoll
