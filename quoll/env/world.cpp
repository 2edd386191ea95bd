#include "quoll/env/world.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/env/mdp_environment.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {

World to_world(std::string name, Mdp mdp) {
  World world;
  world.name = std::move(name);
  world.discount = mdp.discount();
  world.traits.deterministic = mdp.deterministic();
  world.traits.settable = true;
  world.traits.states = mdp.states();
  world.traits.reward_bounds = mdp.reward_bounds();
  world.mdp = std::make_shared<const Mdp>(std::move(mdp));
  world.make = [model = world.mdp](std::uint32_t lanes, std::uint64_t seed) {
    return mdp_environment(model, lanes, seed);
  };
  return world;
}

namespace {

const WorldEntry* find_entry(std::string_view name) {
  for (const WorldEntry& entry : worlds()) {
    if (entry.name == name) return &entry;
    for (const std::string_view alias : split(entry.aliases, ' ')) {
      if (!alias.empty() && alias == name) return &entry;
    }
  }
  return nullptr;
}

// "mazes/big.txt" -> "big": what a world from a file is called when the file does not say.
std::string stem(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.find_last_of('.'));
}

bool names_a_file(const std::string& text) {
  return text.find('/') != std::string::npos || text.find('.') != std::string::npos;
}

}  // namespace

Result<World> find_world(const std::string& name_or_file,
                         const std::vector<std::pair<std::string, std::string>>& parameters) {
  if (const WorldEntry* entry = find_entry(name_or_file)) {
    Result<World> world = entry->make(parameters);
    if (world) world->parameters = parameters;
    return world;
  }
  if (!names_a_file(name_or_file)) {
    Nearest nearest(name_or_file);
    for (const WorldEntry& entry : worlds()) nearest.offer(entry.name);
    return Error{"", 0, 0,
                 "no world '" + name_or_file +
                     "'; a built-in name (see 'quoll list worlds') or a file expected",
                 nearest.best()};
  }
  if (!parameters.empty()) {
    return Error{"--with", 0, 0,
                 "a world from a file takes no parameters, not '" + parameters[0].first + "'", ""};
  }
  Result<Mdp> mdp = read_model(name_or_file);
  if (!mdp) return mdp.error();
  return to_world(stem(name_or_file), std::move(*mdp));
}

}  // namespace quoll
