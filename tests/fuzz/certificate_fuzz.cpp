// A certificate of one small model: whatever is accepted as speaking of it is checked, and comes
// back when it is written.

#include "quoll/verify/certificate.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

Mdp small_model() {
  MdpBuilder builder(0.5);
  builder.move("here", "go", "far away", 1.0, 0.75).move("here", "go", "here", 0.0, 0.25);
  builder.move("here", "stay", "here", -1.0).move("far away", "go, then rest", "end", 2.0);
  Result<Mdp> mdp = builder.terminal("end").build();
  if (!mdp) std::abort();
  return std::move(*mdp);
}

int fuzz(std::string_view text) {
  static const Mdp mdp = small_model();
  Result<OpenCertificate> open = open_certificate(text, "fuzz.cert");
  if (!open) {
    if (open.error().expected.empty()) std::abort();
    return 0;
  }
  const Result<Verdict> claims = read_claims(*open, mdp);
  if (!claims ? claims.error().expected.empty() : !claims->accepted && claims->reason.empty()) {
    std::abort();
  }
  if (!claims || !claims->accepted) return 0;
  const Certificate& read = open->content;
  const Result<Verdict> verdict =
      verify(mdp, read.lower, read.upper, read.policy, read.discount, read.maximise);
  if (verdict && !verdict->accepted && verdict->reason.empty()) std::abort();
  const Result<std::string> written = certificate_text(read, mdp);
  if (!written) return 0;
  Result<OpenCertificate> again = open_certificate(*written, "fuzz.cert");
  if (!again) std::abort();
  const Result<Verdict> same = read_claims(*again, mdp);
  if (!same || !same->accepted || again->content.lower != read.lower ||
      again->content.upper != read.upper || again->content.discount != read.discount) {
    std::abort();
  }
  return 0;
}

}  // namespace
}  // namespace quoll

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return quoll::fuzz({reinterpret_cast<const char*>(data), size});
}
