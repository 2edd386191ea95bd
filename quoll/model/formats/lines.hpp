#pragma once
// The lines of a text, in memory or read from a file in blocks so that a file larger than memory
// passes through. "\n" and "\r\n" end a line; a byte order mark at the front is skipped.

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

class Lines {
 public:
  /// The text must outlive this.
  explicit Lines(std::string_view text);

  /// A regular file, refused with the reason otherwise. Holds one block of memory, not the file.
  static Result<Lines> open(const std::string& path);

  /// The next line without its end, valid until the next call; false at the end of the text, after
  /// a failed read and at a line longer than `longest` bytes (see error()).
  bool next(std::string_view& line);

  /// Number of the line next() gave last, from 1.
  std::uint64_t number() const { return number_; }

  /// Why next() stopped before the end; empty when it did not.
  const std::string& error() const { return error_; }

  /// Lines in the whole text, counted in a pass of its own; next() begins at the front afterwards.
  std::uint64_t count();

  static constexpr std::size_t longest = std::size_t{1} << 20;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool refill();
  void rewind();

  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> block_;   // what was read of a file
  std::string_view text_;     // all of a text in memory
  const char* at_ = nullptr;  // the part not given out yet
  const char* end_ = nullptr;
  std::uint64_t number_ = 0;
  std::string error_;
};

}  // namespace quoll
