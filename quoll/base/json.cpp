#include "quoll/base/json.hpp"

#include <charconv>
#include <cmath>

#include "quoll/base/utf8.hpp"

namespace quoll {

namespace {

template <class Number>
void append_shortest(std::string& out, Number number) {
  if (!std::isfinite(number)) {  // JSON has no word for these
    out += "null";
    return;
  }
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, number);
  out.append(digits, end.ptr);
}

void append_string(std::string& out, std::string_view text) {
  static constexpr char hex[] = "0123456789abcdef";
  out += '"';
  while (!text.empty()) {
    const CodePoint point = decode(text);
    const char c = text.front();
    if (!point.valid) {
      encode(point.value, out);
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c == '\r') {
      out += "\\r";
    } else if (point.value < 0x20 || point.value == 0x7F) {
      out += "\\u00";
      out += hex[point.value >> 4];
      out += hex[point.value & 15];
    } else {
      out += text.substr(0, point.length);
    }
    text.remove_prefix(point.length);
  }
  out += '"';
}

}  // namespace

void JsonWriter::line_break() {
  if (style_ == JsonStyle::compact) return;
  text_ += '\n';
  text_.append(2 * levels_.size(), ' ');
}

void JsonWriter::before_value() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  if (!levels_.back().empty) text_ += ',';
  levels_.back().empty = false;
  line_break();
}

void JsonWriter::begin(char bracket) {
  before_value();
  text_ += bracket;
  levels_.emplace_back();
}

void JsonWriter::end(char bracket) {
  const bool empty = levels_.back().empty;
  levels_.pop_back();
  if (!empty) line_break();
  text_ += bracket;
}

JsonWriter& JsonWriter::begin_object() {
  begin('{');
  return *this;
}

JsonWriter& JsonWriter::end_object() {
  if (const std::uint64_t omitted = levels_.back().omitted) member("omitted", omitted);
  end('}');
  return *this;
}

JsonWriter& JsonWriter::begin_array() {
  begin('[');
  return *this;
}

JsonWriter& JsonWriter::end_array() {
  end(']');
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  before_value();
  append_string(text_, name);
  text_ += style_ == JsonStyle::pretty ? ": " : ":";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  before_value();
  append_string(text_, text);
  return *this;
}

JsonWriter& JsonWriter::value(bool truth) {
  before_value();
  text_ += truth ? "true" : "false";
  return *this;
}

JsonWriter& JsonWriter::value(float number) {
  before_value();
  append_shortest(text_, number);
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  before_value();
  append_shortest(text_, number);
  return *this;
}

JsonWriter& JsonWriter::null() {
  before_value();
  text_ += "null";
  return *this;
}

JsonWriter& JsonWriter::integer(std::int64_t number) {
  before_value();
  text_ += std::to_string(number);
  return *this;
}

JsonWriter& JsonWriter::natural(std::uint64_t number) {
  before_value();
  text_ += std::to_string(number);
  return *this;
}

std::string JsonWriter::take() {
  std::string out;
  out.swap(text_);
  return out;
}

std::string json_string(std::string_view text) {
  std::string out;
  append_string(out, text);
  return out;
}

}  // namespace quoll
