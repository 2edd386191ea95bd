#pragma once
// What a policy is worth, state by state, as an interval that contains the true value.

#include <functional>
#include <span>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

/// Called during long evaluations; false stops the work, and the interval so far is returned.
using KeepGoing = std::function<bool(const SolveProgress&)>;

struct Evaluation {
  std::vector<double> lower;  ///< per state
  std::vector<double> upper;  ///< per state
  double gap = 0.0;  ///< largest upper - lower; states that cannot follow from the start and of
                     ///< which nothing is known do not count
  bool converged = false;  ///< gap <= the width asked for
};

/// The value of a deterministic policy (action per state; ends need none). A non-terminal state
/// with no_action has an unknown value: the widest interval the rewards allow. At discount 1 a
/// state from which the policy may never end is worth -infinity where what it then earns is never
/// positive and sometimes negative, +infinity in the mirrored case, and counts 0 where it earns
/// nothing; undecided cases get the interval [-infinity, +infinity]. Deterministic models: exact
/// along the graph, relative error about 4e-16 per step, O(states). Others: below
/// discount 1 sweeps until `width`; at discount 1 elimination (chain_elimination.hpp), sweeps where
/// that takes too long.
/// Where two players move in turn the policy plays both, and values are those of the player to
/// move; such a model must be acyclic.
/// Error: wrong length or an action a state does not have.
Result<Evaluation> evaluate(const Mdp& mdp, std::span<const Action> policy, double discount,
                            double width = 1e-9, const KeepGoing& keep_going = {});

/// The same for a policy that draws its action: probability of each choice, each state's summing to
/// 1 within 1e-9; all zero = no action known.
Result<Evaluation> evaluate(const Mdp& mdp, std::span<const double> choice_probability,
                            double discount, double width = 1e-9, const KeepGoing& keep_going = {});

/// The policy that takes every action of a state equally often, for `evaluate`.
std::vector<double> uniform_policy(const Mdp& mdp);

}  // namespace quoll
