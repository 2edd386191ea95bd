// Runs every file of the given folders through a fuzz target's entry, each also cut short at every
// length up to 512 and with every one of its first 512 bytes changed, so that a plain build tests
// what a fuzzer would try first.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** values) {
  std::size_t files = 0;
  for (int i = 1; i < count; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(values[i])) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<char> text((std::istreambuf_iterator<char>(file)), {});
      std::vector<std::uint8_t> bytes(text.begin(), text.end());
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
      const std::size_t tries = std::min<std::size_t>(bytes.size(), 512);
      for (std::size_t at = 0; at < tries; ++at) {
        // A copy of the exact size, so that a sanitizer sees a read behind the end.
        const std::vector<std::uint8_t> front(bytes.begin(),
                                              bytes.begin() + static_cast<std::ptrdiff_t>(at));
        LLVMFuzzerTestOneInput(front.data(), front.size());
        const std::uint8_t kept = bytes[at];
        bytes[at] = static_cast<std::uint8_t>(kept ^ (1u << at % 8));
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
        bytes[at] = kept;
      }
      ++files;
    }
  }
  std::printf("%zu files replayed\n", files);
  return files > 0 ? 0 : 1;
}
