#pragma once
// Settings in TOML: `key = value` lines, as a run folder's settings.toml holds them.

#include <string>
#include <vector>

#include "quoll/base/settings.hpp"

namespace quoll {

/// Assigns every key of the file. Unknown keys and wrong values are one Error with file and line.
Result<void> read_config(const std::string& path, const std::vector<Setting>& settings);

/// The settings as TOML that read_config() takes back, one commented line each.
std::string config_text(const std::vector<Setting>& settings);

}  // namespace quoll
