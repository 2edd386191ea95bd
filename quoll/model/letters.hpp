#pragma once
// Names of states and actions as the readers of world files take them: UTF-8, no control
// characters, not empty, so that every other format, a terminal and JSON can hold them.

#include <cstddef>
#include <string_view>

namespace quoll {

/// Bytes of the well-formed UTF-8 character `text` begins with; 0 if there is none (The Unicode
/// Standard, section 3.9, table 3-7).
std::size_t letter_length(std::string_view text);

/// What a name that is none lacks, "expected a name ..."; empty for a proper name. Linear.
std::string_view name_fault(std::string_view name);

}  // namespace quoll
