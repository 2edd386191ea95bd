#include "quoll/model/formats/words.hpp"

namespace quoll {
namespace {

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t';
}

}  // namespace

void Words::split(std::string_view line) {
  count = 0;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    const char* const begin = at;
    while (at != end && !is_blank(*at)) ++at;
    if (count < most) text[count] = std::string_view(begin, static_cast<std::size_t>(at - begin));
    ++count;
  }
}

std::optional<std::uint64_t> parse_index(std::string_view text) {
  constexpr std::size_t most_digits = 15;
  if (text.empty() || text.size() > most_digits) return std::nullopt;
  std::uint64_t value = 0;
  for (const char letter : text) {
    const auto digit = static_cast<unsigned>(letter) - unsigned{'0'};
    if (digit > 9) return std::nullopt;
    value = 10 * value + digit;
  }
  return value;
}

std::string as_word(std::string_view name) {
  std::string word(name);
  for (char& letter : word) {
    if (is_blank(letter) || letter == '"') letter = '_';
  }
  return word.empty() ? "_" : word;
}

}  // namespace quoll
