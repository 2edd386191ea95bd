#include "quoll/model/letters.hpp"

#include "quoll/base/utf8.hpp"

namespace quoll {

std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  const CodePoint point = decode(text);
  return point.valid ? point.length : 0;
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
