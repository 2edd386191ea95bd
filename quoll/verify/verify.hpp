#pragma once
// An independent checker of certificates: it shares no code with the solvers and trusts nothing but
// the model. What it accepts is true: lower <= V^policy and V* <= upper, state by state.

#include <optional>
#include <span>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

struct Verdict {
  bool accepted = false;
  std::string reason;          ///< which condition failed and where; empty when accepted
  std::optional<State> state;  ///< first state that violates a condition
};

/// Checks that T upper <= upper, T_policy lower >= lower, and at discount 1 that the policy
/// ends with probability 1 wherever lower is above -infinity. Where two players move in turn each
/// bound is checked against the other one of the next states, V^policy is what the policy is sure
/// to get against any replies, and at discount 1 no state may come again. One pass with outward
/// rounding; O(size). Error: arrays of the wrong length, discount outside (0, 1], an action a state
/// does not have.
Result<Verdict> verify(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
                       std::span<const Action> policy, double discount);

}  // namespace quoll
