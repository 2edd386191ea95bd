#include "quoll/model/formats/format.hpp"
#include "tests/fuzz/model_fuzz.hpp"

namespace quoll {
namespace {

// Words of the format stand for names with blanks, and rewards of outcomes for their mean, so that
// not every model comes back bit by bit; its shape does.
int fuzz(std::string_view text) {
  const auto arrays = parse_model_arrays(text, "fuzz.drn");
  if (!arrays) {
    if (arrays.error().expected.empty()) std::abort();
    return 0;
  }
  check_arrays(*arrays);
  const auto mdp = Mdp::make(*arrays);
  if (!mdp) return 0;
  const auto written = write_drn(*mdp);
  if (!written) return 0;
  const auto again = parse_model(*written, "fuzz.drn");
  if (!again || again->states() != mdp->states() || again->outcomes() != mdp->outcomes() ||
      again->arrays().reward != mdp->arrays().reward) {
    std::abort();
  }
  return 0;
}

}  // namespace
}  // namespace quoll

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return quoll::fuzz({reinterpret_cast<const char*>(data), size});
}
