#include "tests/fuzz/model_fuzz.hpp"

// The format has no place for every name, so only the shape must come back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto arrays = quoll::parse_model_arrays(text, "fuzz.pomdp");
  if (!arrays) {
    if (arrays.error().expected.empty()) std::abort();
    return 0;
  }
  quoll::check_arrays(*arrays);
  const auto mdp = quoll::Mdp::make(*arrays);
  if (!mdp) return 0;
  const auto written = quoll::write_cassandra_pomdp(*mdp);
  if (!written) std::abort();
  const auto again = quoll::parse_model(*written, "fuzz.pomdp");
  if (!again || again->outcomes() != mdp->outcomes() || again->states() != mdp->states() ||
      again->arrays().reward != mdp->arrays().reward) {
    std::abort();
  }
  return 0;
}
