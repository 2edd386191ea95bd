#pragma once
// Reads JSON text (RFC 8259) value by value, in one pass and without a tree, so that a file of any
// size needs no memory beside what its reader keeps.

#include <cstdint>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"

namespace quoll {

/// A cursor before the next value. Each function that takes something returns false when it is not
/// there; then the reader has failed and stays where it is. Strict: no comments, no trailing
/// commas, no NaN, well-formed UTF-8; lists and objects at most 100 deep.
///
///   JsonReader json(text);
///   json.begin_list();
///   while (json.next_item()) json.take(number);
///   json.end();
///   if (!json.good()) return json.error(path);
class JsonReader {
 public:
  /// The text must outlive this.
  explicit JsonReader(std::string_view text);

  enum class Kind : std::uint8_t { object, list, text, number, truth, null, nothing };
  /// What the next value is, told by its first letter.
  Kind peek();

  bool begin_object();
  /// Stands before the value of the next member, or behind the object's end: false.
  bool next_member(std::string& name);
  bool begin_list();
  /// Stands before the next item, or behind the list's end: false.
  bool next_item();

  bool take(std::string& text);
  /// A number a double can hold.
  bool take(double& number);
  bool take(bool& truth);
  /// A number's letters, checked; they lead into the text.
  bool take_number(std::string_view& letters);
  bool null();
  /// Any value.
  bool skip();
  /// Nothing but blanks is left.
  bool end();

  bool good() const { return expected_.empty(); }
  /// Fails at the value taken last, or at the next one if none was.
  bool fail(std::string expected);
  /// The failure with line and column, columns counted in bytes; only after one.
  Error error(const std::string& file) const;
  /// Line of the cursor, from 1. Cost: the text since the last call.
  std::uint64_t line();

 private:
  void blanks();
  bool here(char letter);
  bool fail_here(std::string expected);
  bool take_word(std::string_view word, const char* expected);
  bool take_escape(std::string& text);
  bool take_unit(std::uint32_t& unit);
  bool open(char bracket, const char* expected);
  bool next(char bracket);

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t value_ = 0;  // where the value taken last begins
  std::size_t counted_ = 0;
  std::uint64_t line_ = 1;
  int depth_ = 0;
  bool first_ = true;  // no item of the innermost list or object was taken yet
  std::string expected_;
  std::size_t failed_at_ = 0;
};

}  // namespace quoll
