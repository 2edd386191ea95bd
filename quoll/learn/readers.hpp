#pragma once
// Which settings of learning are read depends on the method and on other settings.

#include <string_view>

#include "quoll/act/exploration.hpp"
#include "quoll/base/error.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

/// Whether the method of this entry never reads a setting that tables have.
bool ignores(const LearnerEntry& entry, std::string_view setting);

/// Error: a setting that is not as usual, though nothing that reads it was chosen. Names its flag,
/// its readers (Setting::readers), and what was chosen instead of them. `--optimiser auto` stands
/// for a choice of the method's and lets the settings of all optimisers pass.
Result<void> check_readers(const LearnSettings& settings, const LearnerEntry& entry,
                           const Exploration& exploration);

}  // namespace quoll
