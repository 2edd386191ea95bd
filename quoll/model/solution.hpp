#pragma once
// An exact answer: an interval that contains the optimal value of each state, and a policy with its
// certified loss. Plain data, so that solvers, verifier, reports and files share it.

#include <cstdint>
#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Solution {
  std::vector<double> lower;   ///< per state: V*(s) >= lower[s], and the policy earns at least this
  std::vector<double> upper;   ///< per state: V*(s) <= upper[s]
  std::vector<Action> policy;  ///< per state; no_action for ends
  double discount = 1.0;
  std::string method;         ///< the solver that ran
  std::uint64_t sweeps = 0;   ///< passes over all states (fractions rounded up)
  std::uint64_t backups = 0;  ///< maximisations over one state's actions
  bool converged = false;     ///< largest upper - lower <= the width asked for
  bool exact = false;         ///< proved without rounding: lower = upper = V*
};

}  // namespace quoll
