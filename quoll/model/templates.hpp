#pragma once
// Small complete worlds to copy and change: what `quoll new template` and `quoll new csv-template`
// give.

#include <string_view>

namespace quoll {

/// A maintenance problem as a TOML world, every element of the format explained once.
std::string_view toml_template();

/// The same problem, number by number, as a CSV world.
std::string_view csv_template();

}  // namespace quoll
