#pragma once
// The part of a model in which the total reward until an end, without discounting, is defined. What
// a model checker calls infinite lies outside: states from which no policy ends with probability 1,
// and those from which one can gain for ever.

#include <optional>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/model/solution.hpp"

namespace quoll {

struct DefinedPart {
  /// The model with the states below as ends and without the choices that may lead to one of
  /// `endless`, which no best policy of those that end takes; empty = all of it is defined.
  std::optional<Mdp> part;
  /// No policy ends from here with probability 1, none gains for ever: ascending.
  std::vector<State> endless;
  /// From here one may gain for ever (lose, when minimising); no other state leads here: ascending.
  std::vector<State> boundless;
  /// Whether all that can be gained is of one sign, so that the value of `boundless` is infinite;
  /// otherwise nothing is known of it.
  bool certain = true;

  /// The values of the states outside, into a solution of the part: of endless ones -infinity, of
  /// boundless ones +infinity or nothing; with the signs turned when minimising.
  void fill(bool maximise, Solution& solution) const;
};

/// Cost: searches over the graph; a copy of the model only where something is not defined.
Result<DefinedPart> defined_part(const Mdp& mdp, bool maximise);

}  // namespace quoll
