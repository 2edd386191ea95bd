#include "quoll/base/mapped_file.hpp"

#include <utility>

#include "quoll/base/file.hpp"

#if !defined(__wasi__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace quoll {

Result<MappedFile> MappedFile::open(const std::string& path) {
  MappedFile file;
#if !defined(__wasi__)
  // Whatever cannot be mapped is left to read_file(), which says why it cannot be read either.
  const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status{};
  if (number >= 0 && ::fstat(number, &status) == 0 && S_ISREG(status.st_mode) &&
      status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const pages = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, number, 0);
    if (pages != MAP_FAILED) {
      ::madvise(pages, size, MADV_SEQUENTIAL);
      file.mapped_ = static_cast<const char*>(pages);
      file.size_ = size;
    }
  }
  if (number >= 0) ::close(number);
  if (file.mapped_) return file;
#endif
  Result<std::string> content = read_file(path);
  if (!content) return content.error();
  file.read_ = *std::move(content);
  return file;
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : mapped_(std::exchange(other.mapped_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      read_(std::move(other.read_)) {}

MappedFile::~MappedFile() {
#if !defined(__wasi__)
  if (mapped_) ::munmap(const_cast<char*>(mapped_), size_);
#endif
}

}  // namespace quoll
