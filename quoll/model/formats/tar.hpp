#pragma once
// Archives of files in one: POSIX tar (IEEE Std 1003.1, pax, "ustar Interchange Format"), with the
// long names and large sizes of GNU tar and of pax headers.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

struct TarEntry {
  std::string name;          ///< without "./" or "/" at its front
  std::string_view content;  ///< leads into the archive
};

/// The regular files of an archive in their order; folders and what else there may be are passed
/// over. Every head's checksum and every size is verified. Allocates only the names.
Result<std::vector<TarEntry>> tar_entries(std::string_view archive);

/// The head of a file of `size` bytes, whose content follows it, filled up with tar_padding(size)
/// zeros. At most 100 bytes of name.
std::string tar_head(std::string_view name, std::uint64_t size);
std::uint64_t tar_padding(std::uint64_t size);
/// What ends an archive.
std::string tar_end();

}  // namespace quoll
