#include "quoll/model/formats/lines.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace quoll {
namespace {

// Line feeds in a block, eight bytes at a time.
std::uint64_t line_feeds(const char* at, const char* end) {
  constexpr std::uint64_t low = 0x7f7f7f7f7f7f7f7fULL;
  constexpr std::uint64_t ones = 0x0101010101010101ULL;
  std::uint64_t count = 0;
  for (; end - at >= 8; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, 8);
    word ^= ones * '\n';
    // The top bit of each byte that is now zero, moved to the bottom; the product adds them up.
    const std::uint64_t zero = ~(((word & low) + low) | word | low);
    count += ((zero >> 7) * ones) >> 56;
  }
  for (; at != end; ++at) count += *at == '\n';
  return count;
}

}  // namespace

Lines::Lines(std::string_view text) : text_(text) {
  rewind();
}

Result<Lines> Lines::open(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    return Error{path, 0, 0, "expected a readable file: " + why, ""};
  };
  struct stat status = {};
  if (stat(path.c_str(), &status) != 0) return refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) return refuse("this is a folder");
  if (!S_ISREG(status.st_mode)) return refuse("this is not a regular file");
  Lines lines{std::string_view()};
  lines.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!lines.file_) return refuse(std::strerror(errno));
  std::setvbuf(lines.file_.get(), nullptr, _IONBF, 0);
  lines.block_.resize(2 * longest);
  lines.rewind();
  return lines;
}

bool Lines::next(std::string_view& line) {
  if (!error_.empty()) return false;
  const auto* found = static_cast<const char*>(
      at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
  if (found == nullptr && file_ && refill()) {
    found = static_cast<const char*>(
        at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
  }
  if (!error_.empty() || (found == nullptr && at_ == end_)) return false;
  const char* const stop = found == nullptr ? end_ : found;
  line = std::string_view(at_, static_cast<std::size_t>(stop - at_));
  at_ = found == nullptr ? end_ : found + 1;
  ++number_;
  if (line.size() > longest) {
    error_ = "expected a line of at most 1 MiB, found a longer one";
    return false;
  }
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  if (number_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
  return true;
}

// Moves the unfinished line to the front of the block and fills the rest. A block is twice the
// longest line, so a line that still has no end is too long or the last.
bool Lines::refill() {
  const auto kept = static_cast<std::size_t>(end_ - at_);
  std::memmove(block_.data(), at_, kept);
  const std::size_t read = std::fread(block_.data() + kept, 1, block_.size() - kept, file_.get());
  if (read == 0 && std::ferror(file_.get()) != 0) {
    error_ = std::string("the file cannot be read: ") + std::strerror(errno);
  }
  at_ = block_.data();
  end_ = at_ + kept + read;
  return read > 0;
}

std::uint64_t Lines::count() {
  std::uint64_t lines = 0;
  char last = '\n';
  do {
    if (at_ == end_) continue;
    lines += line_feeds(at_, end_);
    last = end_[-1];
    at_ = end_;
  } while (file_ && refill());
  rewind();
  return lines + (last == '\n' ? 0 : 1);
}

void Lines::rewind() {
  number_ = 0;
  if (file_) {
    std::rewind(file_.get());
    at_ = end_ = block_.data();
  } else {
    at_ = text_.data();
    end_ = at_ + text_.size();
  }
}

}  // namespace quoll
