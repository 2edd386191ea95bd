#pragma once
// What is asked of a model: a goal chosen by label, and which of its structures of rewards count.

#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Without `states` and `rewards` nothing is asked beyond what the model says.
struct Goal {
  std::string states;  ///< as states_of() takes it; empty = no goal
  /// Name of a structure, "reward" for the model's own if they have no name; empty with a goal =
  /// the probability of reaching it.
  std::string rewards;
  bool minimise = false;
};

/// The states an expression over labels names, ascending: a label, the name of a state, "init" (the
/// start), with `!` not, `&` and, `|` or and brackets; names with other letters in quotation marks.
/// The Error names the nearest label.
Result<std::vector<State>> states_of(const Mdp& mdp, std::string_view expression);

/// The model in which an episode is over where the goal is reached, with the rewards asked for.
/// The probability of reaching the goal is the total of rewards of 1 on entering it, at discount 1;
/// states that can never reach it, or when minimising need never, are ends then, so that the best
/// policy of those that end gives the true probability (Baier and Katoen 2008, sections 10.6.1 and
/// 10.6.2). With rewards, who comes to an end outside the goal stays there for ever. Ends earn
/// nothing: a state of the goal has the value 0. Error: unknown names, and a
/// goal in a game of two. Cost: a few passes, 8 bytes per outcome when minimising.
Result<Mdp> aim(const Mdp& mdp, const Goal& goal);

}  // namespace quoll
