#pragma once
// Names and texts within C sources. Strings are escaped to plain ASCII, so that no compiler's idea
// of encodings, trigraphs or comments can change them.

#include <string>
#include <string_view>

namespace quoll {

/// A C identifier made from a name: other letters than A-Z a-z 0-9 become '_'; "world_" in front
/// of what cannot stand first.
std::string c_identifier(std::string_view name);

/// The text as a C string literal, everything but plain ASCII as octal escapes.
std::string c_string(std::string_view text);

/// The text as it may stand within a comment.
std::string c_comment(std::string_view text);

/// Letters a to z as A to Z.
std::string c_upper(std::string_view name);

}  // namespace quoll
