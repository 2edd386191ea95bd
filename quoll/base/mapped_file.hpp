#pragma once
// The bytes of a file without a copy: the pages of the file itself.

#include <cstddef>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"

namespace quoll {

/// A regular file mapped into memory, read-only; a pipe, and any file where there is no mapping, is
/// read instead. A file that another process cuts short meanwhile ends the program, as any mapping
/// does. Errors as read_file().
class MappedFile {
 public:
  static Result<MappedFile> open(const std::string& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile();

  /// Valid as long as this.
  std::string_view bytes() const { return mapped_ ? std::string_view(mapped_, size_) : read_; }

 private:
  MappedFile() = default;
  const char* mapped_ = nullptr;
  std::size_t size_ = 0;
  std::string read_;
};

}  // namespace quoll
