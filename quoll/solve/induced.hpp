#pragma once
// The model a policy leaves: one choice per state. Evaluating a policy is solving that model.

#include <optional>
#include <span>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// One choice per non-terminal state, mixed by `choice_probability`. States in `ended` become ends.
/// A state whose probabilities are all zero becomes a loop to itself that earns `unknown_reward`,
/// or without one an end. Names are numbers.
Result<Mdp> induced_model(const Mdp& mdp, std::span<const double> choice_probability,
                          std::optional<double> unknown_reward,
                          const std::vector<bool>& ended = {});

/// Probability 1 for the chosen action of each state that has one.
std::vector<double> as_probabilities(const Mdp& mdp, std::span<const Action> policy);

}  // namespace quoll
