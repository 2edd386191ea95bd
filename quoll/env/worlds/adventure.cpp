#include "quoll/env/worlds/adventure.hpp"

#include <utility>

#include "quoll/env/world.hpp"
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

namespace {

Result<World> make(const Parameters& parameters) {
  if (Result<NoParameters> given = read_parameters<NoParameters>("adventure", parameters); !given) {
    return given.error();
  }
  Result<MdpArrays> arrays = read_toml(adventure_toml(), "adventure.toml");
  if (!arrays) return arrays.error();
  Result<Mdp> mdp = Mdp::make(std::move(*arrays));
  if (!mdp) return mdp.error();
  return to_world("adventure", std::move(*mdp));
}

}  // namespace

extern const WorldEntry adventure_world;
const WorldEntry adventure_world{"adventure",
                                 "",
                                 "the lecture's game: six places, two ways to the goal",
                                 "a reconstruction that meets every number of the lecture",
                                 make,
                                 parameters_of<NoParameters>};

}  // namespace quoll
