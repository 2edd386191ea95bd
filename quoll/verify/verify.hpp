#pragma once
// An independent checker of certificates: it shares no code with the solvers and trusts nothing but
// the model. What it accepts is true: lower <= V^policy and V* <= upper, state by state.

#include <cstdint>
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
  /// The choice that violates it, what was claimed of the state, and what the sweep found instead.
  std::optional<std::uint64_t> choice;
  std::optional<double> claimed, found;
};

/// Checks that T upper <= upper, T_policy lower >= lower, and at discount 1 that the policy
/// ends with probability 1 wherever lower is above -infinity, and that no policy does where upper
/// is -infinity. Where two players move in turn each bound is checked against the other one of the
/// next states, V^policy is what the policy is sure to get against any replies, and at discount 1
/// no state may come again. With maximise = false rewards are costs: lower <= V* and V^policy <=
/// upper are what is proved, the signs of all the above turned. One pass with outward rounding;
/// O(size). Error: arrays of the wrong length, discount outside (0, 1], an action a state does not
/// have.
Result<Verdict> verify(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
                       std::span<const Action> policy, double discount, bool maximise = true);

/// What accepted bounds say.
struct Proved {
  double start_lower = 0.0, start_upper = 0.0;  ///< expectation of V* over the starts
  double gap = 0.0;                             ///< the policy loses at most this
  State widest = 0;                             ///< where it may lose that much
  std::uint64_t silent = 0;                     ///< states of which nothing is claimed; not in gap
};

/// Sums rounded outward. O(states).
Proved proved(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper);

}  // namespace quoll
