#pragma once
// TOML as text: what is looked at before parsing, and how names and numbers are written.

#include <cstdint>
#include <string>
#include <string_view>

namespace quoll {

/// The first line, from 1, with a dotted key of over 100 parts, or 0. The parser nests one table
/// per part without a limit and would overflow the stack when it takes them down.
std::uint64_t line_with_deep_key(std::string_view content);

/// A key: bare if it may be, else a string.
std::string toml_key(std::string_view name);
/// A string in quotes.
std::string toml_string(std::string_view text);
/// A finite number that reads back with the same bits.
std::string toml_number(double value);

}  // namespace quoll
