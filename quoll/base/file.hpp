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

/// The bytes of a regular file or of a pipe. Refuses a folder, a device, a missing or unreadable
/// file and one larger than the memory.
Result<std::string> read_file(const std::string& path);

/// Writes a new content atomically: temporary file beside it, fsync, rename, fsync of the folder.
/// On any failure (disk full, short write, failing fsync, read-only folder) the old file is
/// untouched, the temporary one removed, and the Error says which call failed and why; only when
/// the last call, fsync of the folder, fails, the new content is already in place, and the Error
/// says so. Permissions of a replaced file stay, a symbolic link stays one, a device or pipe is
/// written in place.
Result<void> write_file(const std::string& path, std::string_view content);

/// A checked container around an Archive: magic, version, kind, length, XXH3 checksum
/// (docs/formats.md). Replaces only an empty file or an intact one of the same kind: any other
/// stays, with an Error. `kind` is a noun of at most 255 bytes ("run"); messages use it.
Result<void> save_archive(const std::string& path, std::string_view kind,
                          std::span<const std::byte> content);
/// The content, after every check. A truncated, altered, newer or foreign file is one Error.
Result<std::vector<std::byte>> load_archive(const std::string& path, std::string_view kind);

}  // namespace quoll
