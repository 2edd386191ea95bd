// The toml reader must answer any bytes with a model or one Error, and take back what it writes.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "quoll/model/check.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quoll;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto arrays = read_toml(text, "fuzz.toml");
  if (!arrays) {
    if (arrays.error().expected.empty()) std::abort();
    return 0;
  }
  check_arrays(*arrays);
  const auto mdp = Mdp::make(*arrays);
  if (!mdp) return 0;
  const auto written = write_toml(*mdp);
  if (!written) return 0;
  const auto again = parse_model(*written, "fuzz.toml");
  if (!again || digest(*again) != digest(*mdp)) std::abort();
  return 0;
}
