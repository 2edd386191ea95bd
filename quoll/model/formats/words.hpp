#pragma once
// The words of a line of text, between blanks, as the files of model checkers have them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace quoll {

/// One split line; views lead into it. Of a line with more than `most` words only `count` is right.
struct Words {
  static constexpr std::size_t most = 8;
  std::array<std::string_view, most> text;
  std::size_t count = 0;

  void split(std::string_view line);
  std::string_view operator[](std::size_t i) const { return text[i]; }
  /// Where a word begins in its line, from 1.
  std::size_t column(std::string_view line, std::size_t word) const {
    return static_cast<std::size_t>(text[word].data() - line.data()) + 1;
  }
};

/// The whole of `text` as digits only, below 2^53; nothing otherwise. Fast.
std::optional<std::uint64_t> parse_index(std::string_view text);

/// The name as one word: blanks and quotation marks become '_'; "_" for nothing.
std::string as_word(std::string_view name);

}  // namespace quoll
