#include <cstdlib>
#include <string_view>

#include "quoll/model/formats/moving_ai.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto problems = quoll::parse_problems(text, "fuzz.scen");
  if (problems ? problems->empty() : problems.error().expected.empty()) std::abort();
  return 0;
}
