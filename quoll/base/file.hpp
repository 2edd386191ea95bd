#pragma once
// Files on disk: read whole, written whole or not at all.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

/// The bytes of a regular file. Refuses a folder, a missing or unreadable file, in one line.
Result<std::string> read_file(const std::string& path);

/// Writes a new content atomically: temporary file beside it, fsync, rename, fsync of the folder. On
/// any failure (disk full, short write, failing fsync, read-only folder) the old file is untouched, the
/// temporary one removed, and the Error says which call failed and why.
Result<void> write_file(const std::string& path, std::string_view content);

/// A checked container around an Archive: magic, version, kind, length, XXH3 checksum (docs/formats.md).
Result<void> save_archive(const std::string& path, std::string_view kind,
                          std::span<const std::byte> content);
/// The content, after every check. A truncated, altered, newer or foreign file is one Error.
Result<std::vector<std::byte>> load_archive(const std::string& path, std::string_view kind);

}  // namespace quoll
