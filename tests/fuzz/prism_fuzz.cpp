// Transitions, states, labels and two files of rewards, separated by lines of "---".

#include <string>
#include <vector>

#include "quoll/model/formats/prism.hpp"
#include "tests/fuzz/model_fuzz.hpp"

namespace quoll {
namespace {

using Kind = PrismPart::Kind;

Result<MdpArrays> parse(const std::vector<std::string>& texts, const std::vector<Kind>& kinds) {
  std::vector<PrismPart> parts;
  for (std::size_t i = 1; i < texts.size(); ++i) {
    parts.push_back({kinds[i], "part", std::to_string(i), Lines(texts[i])});
  }
  Lines lines(texts[0]);
  return read_prism_parts(lines, "fuzz.tra", parts);
}

std::vector<std::string> pieces(std::string_view text) {
  constexpr std::string_view separator = "---\n";
  constexpr std::size_t most = 5;
  std::vector<std::string> list;
  while (list.size() + 1 < most) {
    const std::size_t at = text.find(separator);
    if (at == std::string_view::npos) break;
    list.emplace_back(text.substr(0, at));
    text.remove_prefix(at + separator.size());
  }
  list.emplace_back(text);
  return list;
}

Kind kind_of(const std::string& path) {
  return path.ends_with(".sta")   ? Kind::states
         : path.ends_with(".lab") ? Kind::labels
                                  : Kind::rewards;
}

void round_trip(const Mdp& mdp) {
  const auto files = write_model(mdp, "fuzz.tra");
  if (!files) return;
  std::vector<std::string> texts;
  std::vector<Kind> kinds;
  for (const WrittenFile& file : *files) {
    texts.push_back(file.content);
    kinds.push_back(kind_of(file.path));
  }
  const auto again = parse(texts, kinds);
  if (!again) std::abort();
  const auto read = Mdp::make(*again);
  if (!read || read->states() != mdp.states() || read->outcomes() != mdp.outcomes()) std::abort();
}

}  // namespace
}  // namespace quoll

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using quoll::PrismPart;
  const auto texts = quoll::pieces({reinterpret_cast<const char*>(data), size});
  const auto arrays = quoll::parse(
      texts, {PrismPart::Kind::states, PrismPart::Kind::states, PrismPart::Kind::labels,
              PrismPart::Kind::rewards, PrismPart::Kind::rewards});
  if (!arrays) {
    if (arrays.error().expected.empty()) std::abort();
    return 0;
  }
  quoll::check_arrays(*arrays);
  const auto mdp = quoll::Mdp::make(*arrays);
  if (mdp) quoll::round_trip(*mdp);
  return 0;
}
