#pragma once
// UTF-8 text as a terminal and a picture see it: code points and columns.

#include <cstddef>
#include <string>
#include <string_view>

namespace quoll {

/// One decoded code point. An ill-formed sequence yields U+FFFD and the length of its longest
/// well-formed beginning, at least 1 (The Unicode Standard, section 3.9, table 3-7).
struct CodePoint {
  char32_t value = 0;
  std::size_t length = 0;  ///< bytes taken
  bool valid = true;
};

/// The first code point of `text`, which must not be empty.
CodePoint decode(std::string_view text);

/// Appends `value` as UTF-8.
void encode(char32_t value, std::string& out);

/// `text` with every ill-formed sequence replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

/// Columns a terminal gives `text`: 0 for controls and combining marks, 2 for wide East Asian
/// characters and emoji, 1 otherwise. Escape sequences "ESC [ ... letter" count 0.
std::size_t display_width(std::string_view text);

/// The longest beginning of `text` that fits into `columns`; a cut text ends with `mark`, which
/// counts.
std::string fit_width(std::string_view text, std::size_t columns, std::string_view mark = "…");

}  // namespace quoll
