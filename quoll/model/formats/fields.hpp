#pragma once
// The fields of a line of comma-separated values: quoting as in RFC 4180, but a field ends with its
// line. Blanks around a field outside quotes do not count.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace quoll {

/// One split line. Views lead into the line or into `unquoted`. Of a line with more than `most`
/// fields only `count` is right.
struct Fields {
  static constexpr std::size_t most = 16;
  std::array<std::string_view, most> text;
  std::array<std::size_t, most> at;  ///< where the field begins in the line, from 0
  std::size_t count = 0;
  std::string unquoted;  ///< the text of fields that stood in quotes

  Fields() = default;
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;

  /// Splits a line. Nothing on success, or the place (from 0) of a quote that has no partner or is
  /// followed by text.
  std::optional<std::size_t> split(std::string_view line);

 private:
  std::optional<std::size_t> split_quoted(std::string_view line);
  void push(std::string_view field, std::size_t begin);
};

/// parse_number() for columns of short decimals: same value, a fifth of the time.
std::optional<double> parse_short_number(std::string_view text);

/// The text as one field, in quotes if it needs them.
std::string as_field(std::string_view text);

}  // namespace quoll
