#pragma once
// What `explain` and `learn --explain` share: traces as people write them, and the standard rule
// beside another one.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/cli/common.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/report/explain_text.hpp"

namespace quoll::cli {

/// The state of a name or an index; the Error names the nearest.
Result<State> parse_state(const World& world, std::string_view word, std::string_view place);

/// "HALL:To-CAVE, CAVE:To-GOAL": the transitions of a trace, names or indices. Where a move has
/// several outcomes, a third word chooses one: "A:go:B". Steps count from 1. Needs a model.
Result<std::vector<Update>> parse_trace(const World& world, std::string_view text);

/// The same transitions with the rewards the world gives: what a rule that goes by its own rE
/// hides.
std::vector<Update> observed(const Mdp& mdp, std::span<const Update> updates);

/// The standard rule with step size 1, from Q = 0, on the same transitions.
Result<std::vector<Update>> standard_beside(const LearnSettings& settings, const World& world,
                                            std::span<const Update> updates);

/// Updates of a learner, and what each of them changed beside its own pair: empty unless the method
/// has memory.
struct ToldUpdates {
  std::vector<Update> updates;
  std::vector<std::vector<OtherChange>> others;
  std::span<const OtherChange> beside(std::size_t i) const {
    return others.empty() ? std::span<const OtherChange>() : others[i];
  }
};
/// Advances by at most `steps` and appends what happened. Cost for methods with memory: the whole
/// table each step.
LearnProgress advance_told(Learner& learner, const LearnerEntry& entry, std::uint64_t steps,
                           ToldUpdates& told);

/// The words for the updates that a learner of this entry made itself.
UpdateWords own_words(const LearnerEntry& entry);

/// The banner of the rule as-printed.
std::string as_printed_banner(bool all_zero);

/// Where the values of one state come from (explain --state).
struct StateQuestion {
  std::string state;      ///< name or index
  std::string run;        ///< file of a saved run, or empty
  double discount = 0.0;  ///< 0 = the world's own, or the run's
};
/// Of a world without a model: what the run learned about the state.
Exit explain_learned(const World& world, const StateQuestion& question, const OutputOption& output);
Exit explain_state(const World& world, const StateQuestion& question, const OutputOption& output);

}  // namespace quoll::cli
