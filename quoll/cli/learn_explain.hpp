#pragma once
// learn --explain: the same run, each update shown with its numbers.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quoll/base/json.hpp"
#include "quoll/cli/common.hpp"
#include "quoll/cli/explain.hpp"

namespace quoll::cli {

/// The updates that the run's first seed is about to make.
struct ComingUpdates : ToldUpdates {
  LearnProgress before;          ///< where the learner stood
  Estimates table;               ///< what it had learned by then
  std::vector<Update> standard;  ///< for as-printed: the standard rule on the same transitions
  bool more = false;             ///< the run goes on after the last one listed
};

/// Makes them with a copy of the learner: the run itself is not touched, and will make the same
/// ones. Up to --steps and --episodes, else until it stops; without either limit about 1,000 lines,
/// and never more than 100,000 updates unless `all`. Error: a world whose model is not known.
Result<ComingUpdates> coming_updates(Run& run, const RunSettings& limits, bool all);

/// The rule as-printed beside the standard rule, over all the updates of the run's first seed.
struct StandardBeside {
  std::vector<double> q;                    ///< of the standard rule, per choice; empty = not known
  std::optional<Update> printed, standard;  ///< the first update where they differ
};

/// A learner at the beginning of the run's first seed, to make its updates again later; null unless
/// the rule is as-printed, the model is known, and the run stands at step 0.
Result<std::unique_ptr<Learner>> first_twin(Run& run);

/// Compares after learning. Not known without a twin, and above 100,000 steps.
Result<StandardBeside> standard_beside(const Run& run, Learner* twin);

/// For people: line by line, episodes marked, or both columns of as-printed.
std::string updates_text(const Run& run, const ComingUpdates& coming);

/// The member "updates" of the JSON object of `learn`.
void write_updates(JsonWriter& json, const Run& run, const ComingUpdates& coming, bool all);

}  // namespace quoll::cli
