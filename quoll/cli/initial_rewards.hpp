#pragma once
// --initial-rewards world|zero|FILE.csv: the given values of rE.

#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"

namespace quoll::cli {

/// Per choice. `world` = the model's rewards (none without a model: empty), `zero`, or a CSV file
/// with the columns state,action,reward; pairs it does not name get 0.
Result<std::vector<double>> initial_rewards(const std::string& text, const World& world);

}  // namespace quoll::cli
