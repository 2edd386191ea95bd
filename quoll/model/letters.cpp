#include "quoll/model/letters.hpp"

namespace quoll {

std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xc2 || first > 0xf4) return 0;
  const std::size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  // Overlong forms, surrogates, beyond U+10FFFF.
  const unsigned char second = byte(1);
  if (first == 0xe0 && second < 0xa0) return 0;
  if (first == 0xed && second > 0x9f) return 0;
  if (first == 0xf0 && second < 0x90) return 0;
  if (first == 0xf4 && second > 0x8f) return 0;
  return length;
}

std::string_view name_fault(std::string_view name) {
  if (name.empty()) return "expected a name that is not empty";
  while (!name.empty()) {
    const auto first = static_cast<unsigned char>(name.front());
    const std::size_t length = letter_length(name);
    if (length == 0) return "expected a name in UTF-8";
    // U+0080 to U+009F are controls, too.
    const bool high = first == 0xc2 && static_cast<unsigned char>(name[1]) < 0xa0;
    if (first < 0x20 || first == 0x7f || high) {
      return "expected a name without control characters";
    }
    name.remove_prefix(length);
  }
  return "";
}

}  // namespace quoll
