#pragma once
// Compressed bytes, told by their first ones: gzip (RFC 1952) and xz (tukaani.org, "The .xz File
// Format").

#include <string>
#include <string_view>

#include "quoll/base/error.hpp"

namespace quoll {

/// Whether the bytes begin as gzip or xz files do.
bool is_compressed(std::string_view bytes);

/// What the bytes hold, all members of the file. Errors: cut or damaged bytes, a content larger
/// than the memory, and a build without the library (zlib, liblzma), which says the command that
/// does it by hand. Cost: the content once; no more is allocated than the bytes present give.
Result<std::string> decompress(std::string_view bytes, const std::string& path);

}  // namespace quoll
