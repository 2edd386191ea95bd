#pragma once
// learn --explain: the same run, each update shown with its numbers.

#include "quoll/cli/common.hpp"

namespace quoll::cli {

Exit learn_explained(Run& run, const RunSettings& limits, const OutputOption& output);

}  // namespace quoll::cli
