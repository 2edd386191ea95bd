#pragma once
// Models in which no state comes again, judged from their ends on; above all games of two who move
// in turn (MdpArrays::alternating). Every bound is true in spite of rounding.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

/// Every state that is no end, after all states that can follow it. Error, naming a state: one can
/// come again.
Result<std::vector<State>> backward_order(const Mdp& mdp);

/// An interval per state.
struct Bounds {
  std::vector<double> lower, upper;

  explicit Bounds(const Mdp& mdp) : lower(mdp.states(), 0.0), upper(mdp.states(), 0.0) {}
};

/// Bounds on reward + carried discount * value of what follows a choice, if `follows` bounds that.
double q_lower(const Mdp& mdp, std::uint64_t choice, const Discount& discount,
               const Bounds& follows);
double q_upper(const Mdp& mdp, std::uint64_t choice, const Discount& discount,
               const Bounds& follows);

/// The value to the player to move when both draw their actions by `choice_probability` (all zero
/// in a state = any action may be taken). Error: a state can come again.
Result<Evaluation> evaluate_game(const Mdp& mdp, std::span<const double> choice_probability,
                                 double discount);

/// judge() for a model with two players: the policy's value in a state is what it is sure to get
/// there, the other player replying as is worst for it. Regret = V* minus that. Below discount 1
/// states may come again.
Optimality judge_game(const Mdp& mdp, const Solution& exact, std::span<const Action> policy,
                      std::span<const State> from, double discount);

}  // namespace quoll
