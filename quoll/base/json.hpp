#pragma once
// A small writer of JSON text (RFC 8259), for every `--json` and every file for other programs.

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quoll {

enum class JsonStyle : std::uint8_t {
  compact,  ///< no blanks
  pretty    ///< one member per line, 2 blanks per level
};

/// A list longer than this is left out of JSON unless all rows are asked for.
inline constexpr std::uint64_t json_complete_rows = 100'000;

/// Writes one JSON text in the order of the calls. Strings are escaped and made valid UTF-8; a
/// float is printed in the shortest form that reads back as the same float, a double as the same
/// double; nan and infinities become null. Nesting must match and each member needs its key: a
/// programmer's promise.
///
///   JsonWriter json;
///   json.begin_object().member("world",
///   "adventure").key("runs").begin_array().value(1).end_array(); json.end_object();
///   print(json.text());
class JsonWriter {
 public:
  explicit JsonWriter(JsonStyle style = JsonStyle::compact) : style_(style) {}

  JsonWriter& begin_object();
  /// Ends the object; says "omitted": N first when rows() left N rows of its lists out.
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(bool truth);
  JsonWriter& value(float number);
  JsonWriter& value(double number);
  template <std::integral T>
    requires(!std::same_as<T, bool> && !std::same_as<T, char>)
  JsonWriter& value(T number) {
    if constexpr (std::signed_integral<T>) return integer(static_cast<std::int64_t>(number));
    return natural(static_cast<std::uint64_t>(number));
  }
  JsonWriter& null();
  /// A number held as double that came from a float table prints as a float.
  JsonWriter& number(double value, bool is_float) {
    return is_float ? this->value(static_cast<float>(value)) : this->value(value);
  }

  template <class T>
  JsonWriter& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }
  JsonWriter& null_member(std::string_view name) { return key(name).null(); }
  /// The value, or null where there is none.
  template <class T>
  JsonWriter& member(std::string_view name, const std::optional<T>& value) {
    return value ? member(name, *value) : null_member(name);
  }

  /// The member `name` as an array of `count` rows, each written by row(i) as one value. Over
  /// json_complete_rows the array is empty, and the enclosing object says "omitted": count at its
  /// end (the sum over its lists), unless `all`. Returns whether the rows were written.
  template <class Row>
  bool rows(std::string_view name, std::uint64_t count, bool all, Row row) {
    key(name).begin_array();
    const bool written = all || count <= json_complete_rows;
    for (std::uint64_t i = 0; written && i < count; ++i) row(i);
    end_array();
    if (!written) levels_.back().omitted += count;
    return written;
  }

  /// The text so far.
  const std::string& text() const { return text_; }
  /// Hands the text so far over and forgets it, so that long output can be written in pieces.
  std::string take();

 private:
  struct Level {
    bool empty = true;
    std::uint64_t omitted = 0;
  };
  JsonWriter& integer(std::int64_t number);
  JsonWriter& natural(std::uint64_t number);
  void before_value();
  void line_break();
  void begin(char bracket);
  void end(char bracket);
  JsonStyle style_;
  bool after_key_ = false;
  std::string text_;
  std::vector<Level> levels_;
};

/// `text` between quotation marks, escaped, valid UTF-8.
std::string json_string(std::string_view text);

}  // namespace quoll
