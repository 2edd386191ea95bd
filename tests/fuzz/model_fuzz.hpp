#pragma once
// What every model reader promises: any bytes give a model or one Error with a sentence, and what
// it writes it takes back.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "quoll/model/check.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {

/// Aborts when the format of `path` breaks that promise on these bytes; always 0.
inline int fuzz_model(const std::string& path, const std::uint8_t* data, std::size_t size,
                      const Parameters& given = {}) {
  const auto format = format_of(path);
  if (!format) std::abort();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto arrays = parse_model_arrays(text, path, given);
  if (!arrays) {
    if (arrays.error().expected.empty()) std::abort();
    return 0;
  }
  check_arrays(*arrays);
  const auto mdp = Mdp::make(*arrays);
  if (!mdp) return 0;
  if ((*format)->write == nullptr) return 0;
  const auto written = (*format)->write(*mdp);
  if (!written) return 0;
  const auto again = parse_model(*written, path);
  if (!again || digest(*again) != digest(*mdp)) std::abort();
  return 0;
}

}  // namespace quoll
