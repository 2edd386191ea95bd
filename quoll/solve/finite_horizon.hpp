#pragma once
// The best that can be earned in a given number of steps, and the policy that does, which depends
// on the steps left.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {

struct HorizonSettings {
  std::uint64_t steps = 1;         ///< at least 1
  std::optional<double> discount;  ///< instead of the model's own; in (0, 1]
  bool maximise = true;            ///< false: rewards are costs
  unsigned threads = 1;            ///< 0 = all processors; the answer's bits do not depend on it
  bool keep_policy = false;        ///< fill HorizonSolution::changes
  /// Called between steps; false stops the work: true but wide bounds are returned.
  std::function<bool(const SolveProgress&)> keep_going;
};

/// From step `step` on (0 = the first) the policy takes another action than before.
struct PolicyChange {
  std::uint64_t step;
  State state;
  Action action;
};

struct HorizonSolution {
  std::vector<double> lower;   ///< per state, all steps left: the policy earns at least this
  std::vector<double> upper;   ///< no policy earns more
  std::vector<Action> policy;  ///< of the first step; no_action for ends
  double discount = 1.0;
  std::uint64_t steps = 0;           ///< steps worked out; fewer than asked if stopped
  std::uint64_t sweeps = 0;          ///< fewer than steps where nothing changed any more
  std::uint64_t action_changes = 0;  ///< states times steps where the action changes
  std::uint64_t changing_steps = 0;  ///< steps at which some state's action changes
  /// With so many steps left or more the policy is always the same.
  std::uint64_t settled = 1;
  std::vector<PolicyChange> changes;  ///< by step, then state; if kept
  double gap = 0.0;                   ///< upper - lower, certified
};

/// Backward induction over `steps` steps; ends stop, nothing is earned when no step is left.
/// Puterman 1994, section 4.5. An action changes only for one that is better by more than rounding.
/// Bounds hold in spite of rounding, and are exact for integer rewards in deterministic models
/// without discount. Where two players move in turn the value is that of the player to move. Error:
/// a discount outside (0, 1], no step, changes that do not fit into a gigabyte. Memory: two values
/// and two actions a state; kept changes 16 bytes each. Cost: a sweep a step, until nothing
/// changes.
Result<HorizonSolution> solve_horizon(const Mdp& mdp, const HorizonSettings& settings);

}  // namespace quoll
