#include "tests/fuzz/model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return quoll::fuzz_model("fuzz.pgm", data, size, {{"goal", "0,0"}, {"unknown", "true"}});
}
