#include "tests/fuzz/model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  quoll::fuzz_model("fuzz.map", data, size);
  quoll::fuzz_model("fuzz.map", data, size, {{"goal", "0,0"}, {"slip", "0.5"}});
  return quoll::fuzz_model("fuzz.map", data, size, {{"goal", "0,0"}, {"heading", "true"}});
}
