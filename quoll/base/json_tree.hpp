#pragma once
// Trees of data (base/tree.hpp) as JSON text, and back.

#include <string>
#include <string_view>

#include "quoll/base/json.hpp"
#include "quoll/base/tree.hpp"

namespace quoll {

/// Writes the tree as the next value: floats and doubles in their shortest forms, "inf", "-inf" and
/// "nan" as texts.
void write_tree(JsonWriter& json, const Tree& tree);
/// The tree on one line.
std::string json_text(const Tree& tree);

/// Reads one JSON text (RFC 8259). Errors: `place`, line and column, what was expected. Nesting
/// deeper than 100 is refused.
Result<Tree> read_json(std::string_view text, const std::string& place);

}  // namespace quoll
