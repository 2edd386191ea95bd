#pragma once
// Is a policy optimal, and if not, what does it lose? Decided on the policy's value, never on float
// equality of learned numbers.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

struct Optimality {
  std::optional<bool> optimal;    ///< nothing = not decided
  std::string proof;              ///< one sentence: why, or what is missing
  double regret = 0.0;            ///< certified: no state asked about loses more than this
  double regret_estimate = 0.0;   ///< the same between the middles of the intervals
  std::uint64_t unreachable = 0;  ///< non-terminal states that cannot follow from `from`
  State worst = 0;                ///< where regret is largest
};

/// Judges a policy (action per state) on the non-terminal states reachable from `from`. True: every
/// chosen action is a maximiser by the exact graph, or V*(s) - V^policy(s) <= 1e-9 |V*(s)| is
/// certified in every state; false: the contrary is certified, or a state has no_action. `exact` is
/// a solution of the same model at the same discount. Cost: one evaluation of the policy;
/// where that leaves a deterministic model undecided and another method solved it, one solve by
/// label-setting.
Optimality judge(const Mdp& mdp, const Solution& exact, std::span<const Action> policy,
                 std::span<const State> from, double discount);

/// One backup: reward of the choice plus discounted expected value of what follows.
double q_star(const Mdp& mdp, std::span<const double> value, std::uint64_t choice, double discount);

/// All actions whose Q* is within max(1e-9 |V*|, width of the interval) of the best, ascending;
/// empty for ends.
std::vector<Action> optimal_actions(const Mdp& mdp, const Solution& solution, State state);

}  // namespace quoll
