#include "quoll/base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#if !defined(__wasi__)
#include <dirent.h>
#include <signal.h>
#endif

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace quoll {
namespace {

/// An open file, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  bool valid() const { return number_ >= 0; }
  int number() const { return number_; }
  /// Some file systems report a failed write only here. False with errno set.
  bool close() { return ::close(std::exchange(number_, -1)) == 0 || errno == EINTR; }

 private:
  int number_;
};

std::string reason(int code) {
  return std::generic_category().message(code);
}

Error unreadable(const std::string& path, int code) {
  if (code == ENOENT) return {.file = path, .expected = "no such file"};
  return {.file = path, .expected = "cannot be read: " + reason(code)};
}

Error unwritable(const std::string& path, std::string_view call, int code) {
  return {.file = path,
          .expected = "cannot be written: " + std::string(call) + ": " + reason(code)};
}

int open_file(const std::string& path, int flags, mode_t mode = 0) {
  while (true) {
    const int number = ::open(path.c_str(), flags | O_CLOEXEC, mode);
    if (number >= 0 || errno != EINTR) return number;
  }
}

/// Reads until `size` bytes or the end of the file; the number read, or -1 with errno set.
std::ptrdiff_t read_up_to(int file, void* data, std::size_t size) {
  auto* const bytes = static_cast<char*>(data);
  std::size_t done = 0;
  while (done < size) {
    const auto count = ::read(file, bytes + done, std::min<std::size_t>(size - done, 1 << 30));
    if (count == 0) break;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    done += static_cast<std::size_t>(count);
  }
  return static_cast<std::ptrdiff_t>(done);
}

/// False with errno set. A disk that takes only a part is asked again for the rest.
bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const auto count =
        ::write(file, content.data(), std::min<std::size_t>(content.size(), 1 << 30));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO;
    if (count <= 0) return false;
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool sync(int file) {
  while (::fsync(file) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

/// Without exceptions a failed allocation ends the program, so it is tried first.
bool fits_in_memory(std::uint64_t size) {
  if (size > static_cast<std::uint64_t>(PTRDIFF_MAX)) return false;
  // Volatile: the compiler may otherwise remove a pair of malloc and free and assume success.
  void* volatile memory = std::malloc(std::max<std::size_t>(size, 1));
  std::free(memory);
  return memory != nullptr;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

/// What a write to `path` would replace.
struct Target {
  std::string path;  ///< behind symbolic links: a rename would replace the link itself
  bool exists = false;
  bool regular = true;  ///< false: a device or pipe, written in place
  struct stat status{};
};

Result<Target> target_of(const std::string& path) {
  if (path.empty()) return Error{.expected = "a file name expected"};
  Target target{.path = path};
  target.exists = ::stat(path.c_str(), &target.status) == 0;
  if (!target.exists) {
    if (errno != ENOENT) return unwritable(path, "stat", errno);
    struct stat link{};
    if (::lstat(path.c_str(), &link) == 0) {
      return Error{.file = path, .expected = "cannot be written: a link that leads nowhere"};
    }
    return target;
  }
  if (S_ISDIR(target.status.st_mode)) {
    return Error{.file = path, .expected = "cannot be written: a folder"};
  }
  target.regular = S_ISREG(target.status.st_mode);
#if !defined(__wasi__)
  if (target.regular) {
    char* const resolved = ::realpath(path.c_str(), nullptr);
    if (resolved == nullptr) return unwritable(path, "realpath", errno);
    target.path = resolved;
    std::free(resolved);
  }
#endif
  return target;
}

/// Removes what processes that are no more left of their writes under this name.
void remove_stale([[maybe_unused]] const std::string& folder,
                  [[maybe_unused]] const std::string& begin) {
#if !defined(__wasi__)
  DIR* const entries = ::opendir(folder.c_str());
  if (entries == nullptr) return;
  while (const dirent* entry = ::readdir(entries)) {
    const std::string_view name = entry->d_name;
    if (!name.starts_with(begin) || !name.ends_with(".tmp")) continue;
    const long process = std::strtol(entry->d_name + begin.size(), nullptr, 10);
    if (process > 0 && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) {
      ::unlink((folder + "/" + entry->d_name).c_str());
    }
  }
  ::closedir(entries);
#endif
}

/// A new file beside `path` under a name no other process or thread uses; -1 with errno set.
int open_temporary(const std::string& path, std::string& name) {
  static std::atomic<unsigned> used{0};
#if defined(__wasi__)
  const std::string process = "wasi";
#else
  const std::string process = std::to_string(::getpid());
#endif
  // A process killed here leaves its file behind: the next write to the same path removes it. The
  // path is in the name, so that nobody else's are touched (another machine's processes may seem
  // dead from here). Process numbers return: hence several tries.
  char target[24];
  std::snprintf(target, sizeof target, "%016llx-",
                static_cast<unsigned long long>(XXH3_64bits(path.data(), path.size())));
  const std::string begin = std::string(".quoll-") + target;
  remove_stale(folder_of(path), begin);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    name = folder_of(path) + "/" + begin + process + "-" + std::to_string(++used) + ".tmp";
    const int number = open_file(name, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (number >= 0 || errno != EEXIST) return number;
  }
  return -1;
}

/// A replaced file keeps its permissions, and its owner where this process may give files away.
bool keep_permissions([[maybe_unused]] int file, [[maybe_unused]] const Target& target) {
#if !defined(__wasi__)
  if (!target.exists) return true;
  if (::fchown(file, target.status.st_uid, target.status.st_gid) != 0 && errno != EPERM) {
    return false;
  }
  return ::fchmod(file, target.status.st_mode & 0777) == 0;
#else
  return true;
#endif
}

Result<void> write_in_place(const std::string& path, std::string_view content) {
  Descriptor file(open_file(path, O_WRONLY));
  if (!file.valid()) return unwritable(path, "open", errno);
  if (!write_all(file.number(), content)) return unwritable(path, "write", errno);
  if (!file.close()) return unwritable(path, "close", errno);
  return {};
}

/// The name of the call that failed with errno set, or nullptr.
const char* fill(Descriptor& file, const Target& target, std::string_view content) {
  if (!keep_permissions(file.number(), target)) return "chmod";
  if (!write_all(file.number(), content)) return "write";
  if (!sync(file.number())) return "fsync";
  if (!file.close()) return "close";
  return nullptr;
}

/// A rename is on disk only once its folder is.
Result<void> sync_folder(const std::string& path) {
  Descriptor folder(open_file(folder_of(path), O_RDONLY | O_DIRECTORY));
  // A folder that may be written but not read cannot be asked; some file systems know no such call.
  if (!folder.valid() && errno == EACCES) return {};
  if (folder.valid() && (sync(folder.number()) || errno == EINVAL || errno == ENOTSUP)) return {};
  const int code = errno;
  return Error{.file = path, .expected = "written, but fsync of its folder: " + reason(code)};
}

constexpr std::string_view magic("QUOLL\r\n\x1a", 8);
constexpr std::uint32_t format_version = 1;
constexpr std::size_t longest_kind = 255;
constexpr std::size_t checksum_size = 8;

void append_number(std::string& text, std::uint64_t value, int size) {
  for (int shift = 0; shift < 8 * size; shift += 8) {
    text += static_cast<char>(value >> shift & 0xff);
  }
}

std::uint64_t number_at(std::string_view text, std::size_t position, int size) {
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(text[position + i])} << (8 * i);
  }
  return value;
}

/// Where the parts of a container lie in its bytes.
struct Layout {
  std::string_view kind;
  std::size_t begin = 0;     ///< first byte of the content
  std::uint64_t length = 0;  ///< bytes of content
};

/// Checks everything but the kind.
Result<Layout> layout_of(const std::string& path, std::string_view bytes) {
  const auto refused = [&](std::string text) {
    return Error{.file = path, .expected = std::move(text)};
  };
  const std::string count = std::to_string(bytes.size());
  if (bytes.empty() || !bytes.starts_with(magic.substr(0, bytes.size()))) {
    return refused("not a Quoll file");
  }
  const std::size_t fixed = magic.size() + 4 + 1;
  if (bytes.size() < fixed) return refused("truncated: " + count + " bytes, less than a head");
  const std::uint64_t version = number_at(bytes, magic.size(), 4);
  if (version > format_version) {
    return refused("written by a newer Quoll (format " + std::to_string(version) +
                   ", this program reads " + std::to_string(format_version) + ")");
  }
  if (version < 1) return refused("damaged: there is no format 0");

  Layout layout;
  const std::size_t letters = static_cast<unsigned char>(bytes[fixed - 1]);
  layout.begin = fixed + letters + 8;
  if (bytes.size() < layout.begin) {
    return refused("truncated: " + count + " bytes, less than a head");
  }
  layout.kind = bytes.substr(fixed, letters);
  layout.length = number_at(bytes, layout.begin - 8, 8);
  const std::uint64_t rest = bytes.size() - layout.begin;
  if (rest < checksum_size || rest - checksum_size < layout.length) {
    // A damaged length can exceed what can be added to.
    if (layout.length > UINT64_MAX / 2) return refused("damaged: its length is impossible");
    return refused("truncated: " + count + " of " +
                   std::to_string(layout.begin + layout.length + checksum_size) + " bytes");
  }
  if (rest - checksum_size > layout.length) {
    return refused("damaged: " + std::to_string(rest - checksum_size - layout.length) +
                   " bytes follow its end");
  }
  const std::size_t checked = bytes.size() - checksum_size;
  if (XXH3_64bits(bytes.data(), checked) != number_at(bytes, checked, checksum_size)) {
    return refused("damaged: checksum differs");
  }
  return layout;
}

Result<Layout> layout_of(const std::string& path, std::string_view bytes, std::string_view kind) {
  auto layout = layout_of(path, bytes);
  if (layout && layout->kind != kind) {
    return Error{
        .file = path,
        .expected = "holds a " + std::string(layout->kind) + ", not a " + std::string(kind)};
  }
  return layout;
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  Descriptor file(open_file(path, O_RDONLY));
  if (!file.valid()) return unreadable(path, errno);
  struct stat status{};
  if (::fstat(file.number(), &status) != 0) return unreadable(path, errno);
  if (S_ISDIR(status.st_mode)) return Error{.file = path, .expected = "a folder, not a file"};
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
    return Error{.file = path, .expected = "not a regular file"};
  }
  // The size is only a first guess: a pipe has none, and another process may append.
  std::string content;
  std::uint64_t size = static_cast<std::uint64_t>(status.st_size) + 1;
  std::size_t done = 0;
  while (true) {
    if (!fits_in_memory(size)) {
      return Error{.file = path,
                   .expected = "too large for the memory: " + std::to_string(size) + " bytes"};
    }
    content.resize(size);
    const auto count = read_up_to(file.number(), content.data() + done, size - done);
    if (count < 0) return unreadable(path, errno);
    done += static_cast<std::size_t>(count);
    if (done < size) break;
    size = 2 * size + 65536;
  }
  content.resize(done);
  return content;
}

Result<void> write_file(const std::string& path, std::string_view content) {
  const auto target = target_of(path);
  if (!target) return target.error();
  if (!target->regular) return write_in_place(path, content);

  std::string temporary;
  Descriptor file(open_temporary(target->path, temporary));
  if (!file.valid()) return unwritable(path, "open", errno);
  const char* failed = fill(file, *target, content);
  if (failed == nullptr && std::rename(temporary.c_str(), target->path.c_str()) != 0) {
    failed = "rename";
  }
  if (failed != nullptr) {
    const int code = errno;
    ::unlink(temporary.c_str());
    return unwritable(path, failed, code);
  }
  return sync_folder(target->path);
}

Result<void> save_archive(const std::string& path, std::string_view kind,
                          std::span<const std::byte> content) {
  // Only an empty file or an intact one of the same kind is replaced: --save must never cost a
  // person the file named by mistake.
  struct stat status{};
  if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    const auto old = read_file(path);
    if (!old) return old.error();
    const auto layout = layout_of(path, *old, kind.substr(0, longest_kind));
    if (!layout) {
      Error error = layout.error();
      error.expected += "; it is kept, choose another name or remove it";
      return error;
    }
  }
  kind = kind.substr(0, longest_kind);
  std::string bytes;
  bytes.reserve(magic.size() + 4 + 1 + kind.size() + 8 + content.size() + checksum_size);
  bytes += magic;
  append_number(bytes, format_version, 4);
  append_number(bytes, kind.size(), 1);
  bytes += kind;
  append_number(bytes, content.size(), 8);
  bytes.append(reinterpret_cast<const char*>(content.data()), content.size());
  append_number(bytes, XXH3_64bits(bytes.data(), bytes.size()), checksum_size);
  return write_file(path, bytes);
}

Result<std::vector<std::byte>> load_archive(const std::string& path, std::string_view kind) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  const auto layout = layout_of(path, *bytes, kind);
  if (!layout) return layout.error();
  const auto* const first = reinterpret_cast<const std::byte*>(bytes->data()) + layout->begin;
  return std::vector<std::byte>(first, first + layout->length);
}

}  // namespace quoll
