#include <cstdlib>
#include <string_view>

#include "quoll/base/json_tree.hpp"

// What is JSON is written and read back as the same tree.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto tree = quoll::read_json(text, "fuzz.json");
  if (!tree) {
    if (tree.error().expected.empty() || tree.error().line == 0) std::abort();
    return 0;
  }
  const std::string written = quoll::json_text(*tree);
  const auto again = quoll::read_json(written, "fuzz.json");
  if (!again || quoll::json_text(*again) != written) std::abort();
  return 0;
}
