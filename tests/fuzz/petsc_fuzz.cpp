#include "tests/fuzz/model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return quoll::fuzz_model("fuzz.bin", data, size, {{"discount", "0.5"}});
}
