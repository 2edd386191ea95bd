#include "quoll/base/json_reader.hpp"

#include <algorithm>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/base/utf8.hpp"

namespace quoll {
namespace {

constexpr int deepest = 100;

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

}  // namespace

JsonReader::JsonReader(std::string_view text) : text_(text) {}

void JsonReader::blanks() {
  while (at_ < text_.size() &&
         (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t')) {
    ++at_;
  }
}

bool JsonReader::here(char letter) {
  return at_ < text_.size() && text_[at_] == letter;
}

bool JsonReader::fail(std::string expected) {
  at_ = value_;
  return fail_here(std::move(expected));
}

bool JsonReader::fail_here(std::string expected) {
  if (good()) {
    expected_ = std::move(expected);
    failed_at_ = at_;
  }
  return false;
}

Error JsonReader::error(const std::string& file) const {
  const std::string_view before = text_.substr(0, failed_at_);
  const std::size_t line_end = before.rfind('\n');
  const auto lines = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t begin = line_end == std::string_view::npos ? 0 : line_end + 1;
  return Error{file, lines + 1, before.size() - begin + 1, expected_, ""};
}

std::uint64_t JsonReader::line() {
  for (; counted_ < at_; ++counted_) line_ += text_[counted_] == '\n';
  return line_;
}

JsonReader::Kind JsonReader::peek() {
  if (!good()) return Kind::nothing;
  blanks();
  value_ = at_;
  if (at_ == text_.size()) return Kind::nothing;
  switch (text_[at_]) {
    case '{':
      return Kind::object;
    case '[':
      return Kind::list;
    case '"':
      return Kind::text;
    case 't':
    case 'f':
      return Kind::truth;
    case 'n':
      return Kind::null;
    default:
      return text_[at_] == '-' || is_digit(text_[at_]) ? Kind::number : Kind::nothing;
  }
}

bool JsonReader::open(char bracket, const char* expected) {
  peek();
  if (!good()) return false;
  if (!here(bracket)) return fail_here(expected);
  if (depth_ == deepest) return fail_here("JSON nested at most 100 deep expected");
  ++depth_;
  ++at_;
  first_ = true;
  return true;
}

// Whether another item follows; takes the comma before it, or the bracket that ends the list.
bool JsonReader::next(char bracket) {
  if (!good()) return false;
  blanks();
  const bool first = std::exchange(first_, false);
  if (here(bracket)) {
    ++at_;
    --depth_;
    return false;
  }
  if (first) return true;
  if (!here(',')) return fail_here(std::string("',' or '") + bracket + "' expected");
  ++at_;
  return true;
}

bool JsonReader::begin_object() {
  return open('{', "an object in { } expected");
}

bool JsonReader::next_member(std::string& name) {
  if (!next('}') || !take(name)) return false;
  blanks();
  if (!here(':')) return fail_here("':' expected");
  ++at_;
  return true;
}

bool JsonReader::begin_list() {
  return open('[', "a list in [ ] expected");
}

bool JsonReader::next_item() {
  return next(']');
}

bool JsonReader::take_word(std::string_view word, const char* expected) {
  if (text_.substr(at_, word.size()) != word) return fail_here(expected);
  at_ += word.size();
  first_ = false;
  return true;
}

bool JsonReader::take(bool& truth) {
  peek();
  truth = here('t');
  return good() && take_word(truth ? "true" : "false", "true or false expected");
}

bool JsonReader::null() {
  peek();
  return good() && take_word("null", "null expected");
}

bool JsonReader::take_number(std::string_view& letters) {
  if (peek() != Kind::number) return fail_here("a number expected");
  const auto digits = [&] {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    return at_ > begin;
  };
  if (here('-')) ++at_;
  bool proper = true;
  if (here('0')) {
    ++at_;
    proper = at_ == text_.size() || !is_digit(text_[at_]);
  } else {
    proper = digits();
  }
  if (proper && here('.')) {
    ++at_;
    proper = digits();
  }
  if (proper && (here('e') || here('E'))) {
    ++at_;
    if (here('+') || here('-')) ++at_;
    proper = digits();
  }
  letters = text_.substr(value_, at_ - value_);
  first_ = false;
  return proper || fail("a number as JSON writes them expected");
}

bool JsonReader::take(double& number) {
  std::string_view letters;
  if (!take_number(letters)) return false;
  const auto value = parse_number(letters);
  number = value.value_or(0.0);
  return value.has_value() || fail("a number that a double can hold expected");
}

bool JsonReader::take(std::string& text) {
  if (peek() != Kind::text) return fail_here("a text in quotes expected");
  text.clear();
  ++at_;
  while (at_ < text_.size()) {
    const char letter = text_[at_];
    if (letter == '"') {
      ++at_;
      first_ = false;
      return true;
    }
    if (letter == '\\') {
      if (!take_escape(text)) return false;
      continue;
    }
    const CodePoint point = decode(text_.substr(at_));
    if (!point.valid) return fail_here("well-formed UTF-8 expected");
    if (point.value < 0x20) return fail_here("an escape such as \\n expected, not a bare control");
    text += text_.substr(at_, point.length);
    at_ += point.length;
  }
  return fail("a quotation mark at the text's end expected");
}

bool JsonReader::take_unit(std::uint32_t& unit) {
  unit = 0;
  for (int i = 0; i < 4; ++i, ++at_) {
    const char letter = at_ < text_.size() ? text_[at_] : '\0';
    const char small = letter >= 'A' && letter <= 'F' ? static_cast<char>(letter + 32) : letter;
    const bool hex = is_digit(small) || (small >= 'a' && small <= 'f');
    if (!hex) return fail_here("four hexadecimal digits after \\u expected");
    unit = unit * 16 + static_cast<std::uint32_t>(is_digit(small) ? small - '0' : small - 'a' + 10);
  }
  return true;
}

// A backslash and what follows; beyond U+FFFF two units stand for one letter (RFC 8259, section 7).
bool JsonReader::take_escape(std::string& text) {
  static constexpr std::string_view letters = "\"\\/bfnrt";
  static constexpr std::string_view meant = "\"\\/\b\f\n\r\t";
  ++at_;
  const std::size_t plain = at_ < text_.size() ? letters.find(text_[at_]) : std::string_view::npos;
  if (plain != std::string_view::npos) {
    text += meant[plain];
    ++at_;
    return true;
  }
  if (!here('u')) return fail_here("one of \" \\ / b f n r t u after a backslash expected");
  ++at_;
  std::uint32_t unit = 0;
  if (!take_unit(unit)) return false;
  if (unit >= 0xD800 && unit < 0xDC00 && text_.substr(at_, 2) == "\\u") {
    at_ += 2;
    std::uint32_t low = 0;
    if (!take_unit(low)) return false;
    if (low < 0xDC00 || low > 0xDFFF) return fail_here("the second half of a pair \\u expected");
    unit = 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00);
  } else if (unit >= 0xD800 && unit < 0xE000) {
    return fail_here("both halves of a pair \\u expected");
  }
  encode(static_cast<char32_t>(unit), text);
  return true;
}

bool JsonReader::skip() {
  std::string text;
  std::string_view number;
  bool truth = false;
  switch (peek()) {
    case Kind::object:
      begin_object();
      while (next_member(text)) skip();
      return good();
    case Kind::list:
      begin_list();
      while (next_item()) skip();
      return good();
    case Kind::text:
      return take(text);
    case Kind::number:
      return take_number(number);
    case Kind::truth:
      return take(truth);
    case Kind::null:
      return null();
    case Kind::nothing:
      break;
  }
  return fail_here("a JSON value expected");
}

bool JsonReader::end() {
  blanks();
  return good() && (at_ == text_.size() || fail_here("the end of the JSON text expected"));
}

}  // namespace quoll
