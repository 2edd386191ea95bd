#pragma once
// Is a policy optimal, and if not, what does it lose? Decided on the policy's value, never on float
// equality of learned numbers.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

struct Optimality {
  std::optional<bool> optimal;    ///< nothing = not decided
  std::string proof;              ///< one sentence: why, or what is missing
  double regret = 0.0;            ///< certified: no state asked about loses more than this
  double regret_estimate = 0.0;   ///< the same between the middles of the intervals
  double start_regret = 0.0;      ///< certified: no state of `from` loses more than this
  std::uint64_t unreachable = 0;  ///< non-terminal states that cannot follow from `from`
  State worst = 0;                ///< where regret is largest
};

/// Judges a policy (action per state) on the non-terminal states reachable from `from`. True: every
/// chosen action is a maximiser by the exact graph, or V*(s) - V^policy(s) <= 1e-9 |V*(s)| is
/// certified in every state; false: the contrary is certified, or a state has no_action. `exact` is
/// a solution of the same model at the same discount. Cost: one evaluation of the policy;
/// where that leaves a deterministic model undecided and another method solved it, one solve by
/// label-setting. Where two players move in turn, V^policy(s) is what the policy is sure to get
/// from s for the player to move, against the best replies (judge_game).
Optimality judge(const Mdp& mdp, const Solution& exact, std::span<const Action> policy,
                 std::span<const State> from, double discount);

/// One backup: reward of the choice plus discounted expected value of what follows, which counts
/// negative when the turn passes.
double q_star(const Mdp& mdp, std::span<const double> value, std::uint64_t choice, double discount);

/// The actions that tie for the best, for many states of one model. Both arguments must outlive it.
class TiedActions {
 public:
  TiedActions(const Mdp& mdp, const Solution& solution);
  /// As optimal_actions(). Cost: that state's outcomes; at discount 1 where circles may earn
  /// nothing, once the whole model and a search, mostly short, per tied action that circles.
  std::vector<Action> of(State state) const;

 private:
  std::vector<Action> tied(State state) const;
  void find_circles() const;
  bool leaves(State from, std::uint64_t choice) const;

  const Mdp& mdp_;
  const Solution& solution_;
  bool may_circle_ = false;
  // Found when first needed: the tied choices, their circles, the fewest moves in circles to a
  // state where a tied choice leaves its circle, and the last search that saw a state.
  mutable std::vector<bool> tied_choice_;
  mutable EndComponents circles_;
  mutable std::vector<std::uint32_t> way_out_;
  mutable std::vector<std::uint64_t> seen_in_;
  mutable std::uint64_t search_ = 0;
};

/// All actions whose Q* is within max(1e-9 |V*|, width of the interval) of the best, ascending;
/// empty for ends. At discount 1 without those that keep the value only by circling for ever for
/// nothing: an optimal policy that ends takes each of them. For many states use TiedActions.
std::vector<Action> optimal_actions(const Mdp& mdp, const Solution& solution, State state);

}  // namespace quoll
