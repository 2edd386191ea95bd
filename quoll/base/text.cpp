#include "quoll/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace quoll {
namespace {

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// The letters as they count for likeness: no case, and '-' for '_' as on the command line.
char folded(char letter) {
  if (letter >= 'A' && letter <= 'Z') return static_cast<char>(letter - 'A' + 'a');
  return letter == '-' ? '_' : letter;
}

std::string folded(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = folded(letter);
  return result;
}

/// Cuts the leading digits off `text` and says how many there were.
std::size_t cut_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  text.remove_prefix(count);
  return count;
}

/// digits [. digits] [e [sign] digits], with a digit before or after the point.
bool is_decimal(std::string_view text) {
  std::size_t digits = cut_digits(text);
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    digits += cut_digits(text);
  }
  if (digits == 0) return false;
  if (!text.empty() && (text.front() == 'e' || text.front() == 'E')) {
    text.remove_prefix(1);
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
    if (cut_digits(text) == 0) return false;
  }
  return text.empty();
}

/// An unsigned decimal; nothing when it is too large or too small for a double.
std::optional<double> parse_decimal(std::string_view text) {
  if (!is_decimal(text)) return std::nullopt;
#if defined(__cpp_lib_to_chars)
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc{}) return std::nullopt;
  return value;
#else
  // A library without from_chars for double (libc++ before 20). The letters were checked above, so
  // that only strtod's treatment of the range is left to mend.
  const double value = std::strtod(std::string(text).c_str(), nullptr);
  const bool zero =
      text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == std::string_view::npos;
  if (std::isinf(value) || (value == 0 && !zero)) return std::nullopt;
  return value;
#endif
}

/// Shortest digits in the layout people expect: 100000 rather than 1e+05, as Python and fmt print
/// it.
template <class Real>
std::string shortest_of(Real value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
  std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const std::string sign = text.front() == '-' ? "-" : "";
  text.remove_prefix(sign.size());
  const std::size_t mark = text.find('e');
  int exponent = 0;
  const std::string_view power = text.substr(text[mark + 1] == '+' ? mark + 2 : mark + 1);
  std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (exponent < -4 || exponent >= 16) return sign + std::string(text);

  std::string digits(1, text.front());
  if (mark > 2) digits += text.substr(2, mark - 2);
  if (exponent < 0) return sign + "0." + std::string(-exponent - 1, '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return sign + digits + std::string(whole - digits.size(), '0');
  return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

/// Optimal string alignment: insertions, deletions, changes and swaps of neighbours count 1 each
/// (the restricted edit distance of Damerau 1964 and Wagner, Fischer 1974). Stops early above
/// `limit`.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t smallest = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({change, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
      smallest = std::min(smallest, row[j]);
    }
    if (smallest > limit) return smallest;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

template <class Name>
std::string nearest_of(std::string_view word, std::span<const Name> names) {
  Nearest search(word);
  for (const auto& name : names) search.offer(name);
  return search.best();
}

}  // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t end = text.find(separator);
    pieces.push_back(trim(text.substr(0, end)));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> parse_number(std::string_view text) {
  double sign = 1;
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
    if (text.front() == '-') sign = -1;
    text.remove_prefix(1);
  }
  if (text.size() == 3 || text.size() == 8) {
    const std::string word = folded(text);
    if (word == "inf" || word == "infinity") return sign * HUGE_VAL;
    if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  }
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    const auto value = parse_decimal(text);
    if (!value) return std::nullopt;
    return sign * *value;
  }
  const auto top = parse_decimal(text.substr(0, slash));
  const auto bottom = parse_decimal(text.substr(slash + 1));
  if (!top || !bottom || *bottom == 0) return std::nullopt;
  const double quotient = *top / *bottom;
  if (std::isinf(quotient)) return std::nullopt;
  return sign * quotient;
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
  const std::size_t mark = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, mark);
  std::string digits;
  std::int64_t exponent = 0;
  bool point = false;
  for (std::size_t i = 0; i < mantissa.size(); ++i) {
    const bool between =
        i > 0 && i + 1 < mantissa.size() && is_digit(mantissa[i - 1]) && is_digit(mantissa[i + 1]);
    if (is_digit(mantissa[i])) {
      digits += mantissa[i];
      if (point) --exponent;
    } else if (mantissa[i] == '.' && between && !point && mark != std::string_view::npos) {
      point = true;
    } else if (mantissa[i] != '_' || !between) {
      return std::nullopt;
    }
  }
  if (digits.empty()) return std::nullopt;
  if (mark != std::string_view::npos) {
    std::string_view power = text.substr(mark + 1);
    if (power.size() > 1 && power.front() == '+' && is_digit(power[1])) power.remove_prefix(1);
    int written = 0;
    const auto end = std::from_chars(power.data(), power.data() + power.size(), written);
    if (end.ec != std::errc{} || end.ptr != power.data() + power.size()) return std::nullopt;
    exponent += written;
  }
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  while (!digits.empty() && digits.back() == '0') {
    digits.pop_back();
    ++exponent;
  }
  if (digits.empty()) return 0;
  if (exponent < 0 || exponent > 19) return std::nullopt;
  digits.append(static_cast<std::size_t>(exponent), '0');
  std::uint64_t value = 0;
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end.ec != std::errc{}) return std::nullopt;
  return value;
}

std::string shortest(double value) {
  return shortest_of(value);
}
std::string shortest(float value) {
  return shortest_of(value);
}

std::string nearest(std::string_view word, std::span<const std::string_view> names) {
  return nearest_of(word, names);
}

std::string nearest(std::string_view word, std::span<const std::string> names) {
  return nearest_of(word, names);
}

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string counted(std::uint64_t value, std::string_view noun) {
  return grouped(value) + " " + std::string(noun) + (value == 1 ? "" : "s");
}

Nearest::Nearest(std::string_view word) : word_(folded(word)), distance_(2 + word.size() / 4) {}

void Nearest::offer(std::string_view name) {
  // distance_ is one more than what a better name may cost; the lengths alone exclude most names.
  const std::size_t longer = std::max(word_.size(), name.size());
  const std::size_t shorter = std::min(word_.size(), name.size());
  if (distance_ == 0 || longer - shorter >= distance_) return;
  const std::size_t found = distance(word_, folded(name), distance_ - 1);
  // A distance of the whole length means that no letter is shared.
  if (found >= distance_ || found >= longer) return;
  distance_ = found;
  best_ = name;
}

std::string Nearest::best() const {
  return best_;
}

}  // namespace quoll
