#include "quoll/model/formats/fields.hpp"

#include <algorithm>
#include <cstdint>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t';
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

void Fields::push(std::string_view field, std::size_t begin) {
  if (count < most) {
    text[count] = without_blanks(field);
    at[count] = begin + static_cast<std::size_t>(text[count].data() - field.data());
  }
  ++count;
}

std::optional<std::size_t> Fields::split(std::string_view line) {
  count = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ',') {
      push(line.substr(begin, i - begin), begin);
      begin = i + 1;
    } else if (line[i] == '"') {
      return split_quoted(line);
    }
  }
  push(line.substr(begin), begin);
  return std::nullopt;
}

std::optional<std::size_t> Fields::split_quoted(std::string_view line) {
  count = 0;
  unquoted.clear();
  unquoted.reserve(line.size());  // so that views into it stay valid
  std::size_t begin = 0;
  while (true) {
    std::size_t open = begin;
    while (open < line.size() && is_blank(line[open])) ++open;
    std::size_t end = std::min(line.find(',', begin), line.size());
    if (open < line.size() && line[open] == '"') {
      const std::size_t first = unquoted.size();
      std::size_t quote = open + 1;
      while (true) {
        const std::size_t stop = line.find('"', quote);
        if (stop == std::string_view::npos) return open;
        unquoted += line.substr(quote, stop - quote);
        quote = stop + 1;
        if (quote == line.size() || line[quote] != '"') break;
        unquoted += '"';
        ++quote;
      }
      end = std::min(line.find(',', quote), line.size());
      if (!without_blanks(line.substr(quote, end - quote)).empty()) return quote;
      if (count < most) {
        text[count] = std::string_view(unquoted).substr(first);
        at[count] = open;
      }
      ++count;
    } else {
      const std::size_t stray = line.substr(begin, end - begin).find('"');
      if (stray != std::string_view::npos) return begin + stray;
      push(line.substr(begin, end - begin), begin);
    }
    if (end == line.size()) return std::nullopt;
    begin = end + 1;
  }
}

// Up to 15 digits without exponent: the digits and the power of ten are exact doubles, so that one
// division is correctly rounded (Clinger 1990, "How to read floating point numbers accurately").
std::optional<double> parse_short_number(std::string_view text) {
  static constexpr std::array<double, 16> power = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = !text.empty() && text.front() == '-';
  const std::string_view body = text.substr(negative ? 1 : 0);
  if (body.size() > 16) return parse_number(text);
  std::uint64_t digits = 0;
  std::size_t count = 0;
  std::size_t point = body.size();
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto digit = static_cast<unsigned>(body[i]) - unsigned{'0'};
    if (digit < 10) {
      digits = digits * 10 + digit;
      ++count;
    } else if (body[i] == '.' && point == body.size()) {
      point = i;
    } else {
      return parse_number(text);
    }
  }
  if (count == 0 || count > 15) return parse_number(text);
  const std::size_t decimals = point == body.size() ? 0 : body.size() - point - 1;
  const double value = static_cast<double>(digits) / power[decimals];
  return negative ? -value : value;
}

std::string as_field(std::string_view text) {
  const bool plain = !text.empty() && text.find_first_of(",\"") == std::string_view::npos &&
                     without_blanks(text).size() == text.size();
  if (plain) return std::string(text);
  std::string field = "\"";
  for (const char letter : text) {
    if (letter == '"') field += '"';
    field += letter;
  }
  return field + '"';
}

}  // namespace quoll
