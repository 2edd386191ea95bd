// An archive as it is; or, when the first byte is 0, files that are put into one here, because a
// fuzzer hardly finds a tar head with its checksum. Each file: the number of its name, two bytes of
// length, its content.

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "quoll/model/formats/tar.hpp"
#include "tests/fuzz/model_fuzz.hpp"

namespace {

constexpr std::array<std::string_view, 16> names = {
    "index.json",
    "state-to-choices.bin",
    "choice-to-branches.bin",
    "branch-to-target.bin",
    "branch-to-probability.bin",
    "state-is-initial.bin",
    "actions/choices/values.bin",
    "actions/choices/string-mapping.bin",
    "actions/choices/strings.bin",
    "annotations/rewards/r/choices/values.bin",
    "annotations/rewards/r/states/values.bin",
    "annotations/aps/g/states/values.bin",
    "annotations/quoll/terminal/states/values.bin",
    "annotations/quoll/cell/states/values.bin",
    "valuations/states/valuations.bin",
    "valuations/states/strings.bin",
};

std::string archive(std::string_view files) {
  std::string out;
  while (files.size() >= 3) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(files[i]); };
    const std::string_view name = names[byte(0) % names.size()];
    const std::size_t length = std::min<std::size_t>(byte(1) | byte(2) << 8, files.size() - 3);
    out += quoll::tar_head(name, length);
    out += files.substr(3, length);
    out.append(quoll::tar_padding(length), '\0');
    files.remove_prefix(3 + length);
  }
  return out + quoll::tar_end();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || data[0] != 0) return quoll::fuzz_model("fuzz.umb", data, size);
  const std::string made = archive({reinterpret_cast<const char*>(data) + 1, size - 1});
  return quoll::fuzz_model("fuzz.umb", reinterpret_cast<const std::uint8_t*>(made.data()),
                           made.size());
}
