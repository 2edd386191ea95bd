#include "quoll/env/worlds/adventure.hpp"

#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

struct Embedded {
  std::string_view name, text;
};
constexpr Embedded embedded[] = {
#include "embedded_worlds.inc"
};

}  // namespace

std::string_view adventure_toml() {
  for (const Embedded& world : embedded) {
    if (world.name == "adventure") return world.text;
  }
  return {};
}

Result<World> adventure(const std::vector<std::pair<std::string, std::string>>& parameters) {
  if (!parameters.empty()) {
    return Error{"--with", 0, 0,
                 "the world adventure takes no parameters, not '" + parameters[0].first + "'", ""};
  }
  Result<MdpArrays> arrays = read_toml(adventure_toml(), "adventure.toml");
  if (!arrays) return arrays.error();
  Result<Mdp> mdp = Mdp::make(std::move(*arrays));
  if (!mdp) return mdp.error();
  return to_world("adventure", std::move(*mdp));
}

}  // namespace quoll
