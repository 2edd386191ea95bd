#include "quoll/base/settings.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "quoll/base/text.hpp"

namespace quoll {
namespace {

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double two_to_64 = 0x1p64;

/// The value in an error message: one line, of bearable length.
std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result = "'";
  for (const char letter : text.substr(0, longest)) {
    result += static_cast<unsigned char>(letter) < ' ' ? '?' : letter;
  }
  return result + (text.size() > longest ? "...'" : "'");
}

/// An open end is written as the neighbour of the number it excludes: low = denorm_min is "(0".
bool is_open(double bound, double outwards) {
  const double neighbour = std::nextafter(bound, outwards);
  return std::isfinite(neighbour) && shortest(neighbour).size() < shortest(bound).size();
}

std::string interval(const Setting& setting, bool whole) {
  const bool from = setting.low > -infinity;
  const bool to = setting.high < infinity;
  if (!from && !to) return "";
  const bool open_low = from && !whole && is_open(setting.low, -infinity);
  const bool open_high = to && !whole && is_open(setting.high, infinity);
  const std::string low = shortest(open_low ? std::nextafter(setting.low, -infinity) : setting.low);
  const std::string high =
      shortest(open_high ? std::nextafter(setting.high, infinity) : setting.high);
  if (!to) return (open_low ? " above " : " of at least ") + low;
  if (!from) return (open_high ? " below " : " of at most ") + high;
  return std::string(" in ") + (open_low ? "(" : "[") + low + ", " + high + (open_high ? ")" : "]");
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const auto name : names) {
    if (!text.empty()) text += " | ";
    text += name;
  }
  return text;
}

/// low <= value <= high without rounding the whole number to a double.
bool inside(const Setting& setting, bool negative, std::uint64_t magnitude) {
  const auto at_most = [](std::uint64_t value, double bound) {
    return bound >= two_to_64 || (bound >= 0 && value <= static_cast<std::uint64_t>(bound));
  };
  const auto at_least = [](std::uint64_t value, double bound) {
    if (bound <= 0) return true;
    return bound < two_to_64 && value >= static_cast<std::uint64_t>(std::ceil(bound));
  };
  if (!negative) return at_least(magnitude, setting.low) && at_most(magnitude, setting.high);
  return at_most(magnitude, -setting.low) && at_least(magnitude, -setting.high);
}

std::optional<bool> parse_bool(std::string_view text) {
  if (text == "true" || text == "yes" || text == "on" || text == "1") return true;
  if (text == "false" || text == "no" || text == "off" || text == "0") return false;
  return std::nullopt;
}

bool assign_bool(bool& field, std::string_view text) {
  const auto value = parse_bool(text);
  if (value) field = *value;
  return value.has_value();
}

bool assign_signed(const Setting& setting, std::int64_t& field, std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  const auto magnitude = parse_count(negative ? text.substr(1) : text);
  constexpr std::uint64_t limit = std::uint64_t{1} << 63;
  if (!magnitude || *magnitude > (negative ? limit : limit - 1)) return false;
  if (!inside(setting, negative, *magnitude)) return false;
  field = static_cast<std::int64_t>(negative ? 0 - *magnitude : *magnitude);
  return true;
}

bool assign_unsigned(const Setting& setting, std::uint64_t& field, std::string_view text) {
  const auto value = parse_count(text);
  if (!value || !inside(setting, false, *value)) return false;
  field = *value;
  return true;
}

bool assign_number(const Setting& setting, double& field, std::string_view text) {
  const auto value = parse_number(text);
  // A nan fails both comparisons.
  if (!value || !(*value >= setting.low && *value <= setting.high)) return false;
  field = *value;
  return true;
}

bool assign_choice(const Choice& choice, std::string_view text) {
  for (std::size_t index = 0; index < choice.names.size(); ++index) {
    if (choice.names[index] != text) continue;
    *choice.value = static_cast<std::uint8_t>(index);
    return true;
  }
  return false;
}

/// What is expected, with its article, for a sentence.
std::string expectation(const Setting& setting) {
  if (std::holds_alternative<Choice>(setting.field)) return "one of " + range_of(setting);
  if (std::holds_alternative<bool*>(setting.field)) return range_of(setting);
  return "a " + range_of(setting);
}

}  // namespace

std::string text_of(const Setting& setting) {
  return std::visit(Overload{
                        [](const bool* field) { return std::string(*field ? "true" : "false"); },
                        [](const std::int64_t* field) { return std::to_string(*field); },
                        [](const std::uint64_t* field) { return std::to_string(*field); },
                        [](const double* field) { return shortest(*field); },
                        [](const std::string* field) { return *field; },
                        [](const Choice& choice) {
                          const std::size_t index = *choice.value;
                          if (index >= choice.names.size()) return std::string();
                          return std::string(choice.names[index]);
                        },
                    },
                    setting.field);
}

std::string sentence_of(const Setting& setting) {
  const std::string sentence(setting.sentence);
  return setting.readers.empty() ? sentence : std::string(setting.readers) + ": " + sentence;
}

std::string range_of(const Setting& setting) {
  return std::visit(
      Overload{
          [](const bool*) { return std::string("true | false"); },
          [&](const std::int64_t*) { return "whole number" + interval(setting, true); },
          [&](const std::uint64_t*) {
            Setting counted = setting;
            if (!(counted.low > 0)) counted.low = 0;
            return "whole number" + interval(counted, true);
          },
          [&](const double*) { return "number" + interval(setting, false); },
          [](const std::string*) { return std::string("text"); },
          [](const Choice& choice) { return joined(choice.names); },
      },
      setting.field);
}

Result<void> assign(const Setting& setting, std::string_view text, std::string_view place) {
  const std::string_view word = trim(text);
  std::string near;
  const bool fits =
      std::visit(Overload{
                     [&](bool* field) { return assign_bool(*field, word); },
                     [&](std::int64_t* field) { return assign_signed(setting, *field, word); },
                     [&](std::uint64_t* field) { return assign_unsigned(setting, *field, word); },
                     [&](double* field) { return assign_number(setting, *field, word); },
                     [&](std::string* field) {
                       *field = text;
                       return true;
                     },
                     [&](const Choice& choice) {
                       if (assign_choice(choice, word)) return true;
                       near = nearest(word, choice.names);
                       return false;
                     },
                 },
                 setting.field);
  if (fits) return {};
  return Error{.file = std::string(place),
               .expected = expectation(setting) + " expected, not " + quoted(text),
               .nearest = std::move(near)};
}

const Setting* find(std::span<const Setting> settings, std::string_view name) {
  const auto same = [](std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const char x = a[i] == '-' ? '_' : a[i];
      const char y = b[i] == '-' ? '_' : b[i];
      if (x != y) return false;
    }
    return true;
  };
  for (const Setting& setting : settings) {
    if (same(setting.name, name)) return &setting;
  }
  return nullptr;
}

}  // namespace quoll
