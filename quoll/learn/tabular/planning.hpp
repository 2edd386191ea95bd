#pragma once
// Planning on a counted model: the model as an Mdp for the solvers of quoll/solve, and its values
// per pair.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "quoll/learn/tabular/counted_model.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// How what is not known is valued, and how well to solve.
struct Planning {
  double discount = 1.0;
  /// Value of a pair tried fewer than `known_after` times; none = such pairs cannot be taken.
  std::optional<double> unknown;
  std::uint32_t known_after = 1;
  /// Value of a state where nothing can be taken, and of giving up anywhere at discount 1, so that
  /// every value is defined.
  double stuck = 0.0;
  /// Added to the mean reward of a known pair; empty = nothing.
  std::function<double(std::uint64_t pair)> bonus;
  double width = 1e-9;  ///< of the solver's interval
  const char* method = "auto";
};

/// Values of states in the model, and of pairs: mean reward + bonus + discount * mean value.
struct Plan {
  std::vector<double> state_value;
  std::vector<double> pair_value;    ///< -infinity for pairs that cannot be taken
  std::vector<double> lower, upper;  ///< per state, certified for this model
  std::vector<Action> policy;        ///< per state; no_action where it leaves or is stuck
  bool solved = false;               ///< false: values are not defined here (a cycle gains)
};

/// Solves the model. `begin` = first pair of each state, and the end. Cost: the solver's, and a few
/// passes over the outcomes.
Plan plan(const CountedModel& model, const std::vector<std::uint64_t>& begin,
          const Planning& planning);

}  // namespace quoll
