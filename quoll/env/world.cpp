#include "quoll/env/world.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/env/explore.hpp"
#include "quoll/env/mdp_environment.hpp"
#include "quoll/model/formats/format.hpp"
#include "quoll/model/goal.hpp"

namespace quoll {

World to_world(std::string name, Mdp mdp, Looks looks, std::uint64_t episode_steps,
               Seeding seeding) {
  World world;
  world.name = std::move(name);
  world.discount = mdp.discount();
  world.episode_steps = episode_steps;
  world.traits.deterministic = mdp.deterministic();
  world.traits.settable = true;
  world.traits.players = mdp.alternating() ? 2 : 1;
  world.traits.states = mdp.states();
  world.traits.reward_bounds = mdp.reward_bounds();
  world.mdp = std::make_shared<const Mdp>(std::move(mdp));
  world.make = mdp_environments(world.mdp, std::move(looks), episode_steps, seeding);
  return world;
}

namespace {

// "FrozenLake8x8-v1:map=8x8,slippery=false": a name, and the parameters it stands for.
struct Alias {
  std::string_view name;
  Parameters parameters;
};

Alias parse_alias(std::string_view text) {
  const std::size_t colon = text.find(':');
  Alias alias{text.substr(0, colon), {}};
  if (colon == std::string_view::npos) return alias;
  for (const std::string_view pair : split(text.substr(colon + 1), ',')) {
    const std::size_t equals = pair.find('=');
    alias.parameters.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return alias;
}

struct Found {
  const WorldEntry* entry = nullptr;
  Parameters parameters;
};

Found find_entry(std::string_view name) {
  for (const WorldEntry* const entry : worlds()) {
    if (entry->name == name) return {entry, {}};
    for (const std::string_view text : split(entry->aliases, ' ')) {
      Alias alias = parse_alias(text);
      if (!alias.name.empty() && alias.name == name) return {entry, std::move(alias.parameters)};
    }
  }
  return {};
}

// Each name once, with the text given last.
Parameters merged(Parameters first, const Parameters& second) {
  for (const auto& [name, text] : second) {
    std::erase_if(first, [&](const auto& one) { return gives({one}, name); });
    first.emplace_back(name, text);
  }
  return first;
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

Result<World> find_unaimed(const std::string& name_or_file, const Parameters& parameters) {
  if (Found found = find_entry(name_or_file); found.entry) {
    const Parameters all = merged(std::move(found.parameters), parameters);
    Result<World> world = found.entry->make(all);
    if (world) world->parameters = all;
    return world;
  }
  if (!names_a_file(name_or_file)) {
    Nearest nearest(name_or_file);
    for (const WorldEntry* const entry : worlds()) {
      nearest.offer(entry->name);
      for (const std::string_view alias : split(entry->aliases, ' ')) {
        if (!alias.empty()) nearest.offer(parse_alias(alias).name);
      }
    }
    return Error{"", 0, 0,
                 "no world '" + name_or_file +
                     "'; a built-in name (see 'quoll list worlds') or a file expected",
                 nearest.best()};
  }
  Result<Mdp> mdp = read_model(name_or_file, parameters);
  if (!mdp) return mdp.error();
  World world = to_world(stem(name_or_file), std::move(*mdp));
  world.parameters = merged({}, parameters);
  return world;
}

// Takes what is asked of the model, which is kept among the parameters, out of them.
Goal take_goal(Parameters& parameters) {
  Goal goal;
  std::erase_if(parameters, [&](const auto& one) {
    const auto& [key, value] = one;
    if (key == "--goal") goal.states = value;
    if (key == "--reward") goal.rewards = value;
    if (key == "--minimise") goal.minimise = value == "true";
    return key == "--goal" || key == "--reward" || key == "--minimise";
  });
  return goal;
}

Result<World> aimed(World world, const Goal& goal) {
  if (!world.mdp) {
    return Error{goal.states.empty() ? "--reward" : "--goal", 0, 0,
                 "expected a world with a model, which " + world.name + " has not", ""};
  }
  Result<Mdp> mdp = aim(*world.mdp, goal);
  if (!mdp) return mdp.error();
  return to_world(std::move(world.name), *std::move(mdp), {}, world.episode_steps);
}

}  // namespace

const WorldEntry* find_world_entry(std::string_view name) {
  return find_entry(name).entry;
}

Offer offer_of(const WorldEntry& entry) {
  if (entry.offer) return entry.offer();
  const Result<World> world = entry.make({});
  if (!world) return {};
  Offer offer{{}, world->episode_steps, world->discount, world->traits.libm};
  if (!world->mdp) {
    offer.spaces = world->make({})->spaces();
    return offer;
  }
  const Mdp& mdp = *world->mdp;
  offer.spaces.states = static_cast<std::uint32_t>(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    offer.spaces.actions = std::max(offer.spaces.actions, mdp.actions(s));
  }
  return offer;
}

namespace {

Result<World> find(const std::string& name_or_file, const Parameters& parameters,
                   const ExploreSettings* exploration) {
  Parameters of_world = parameters;
  const Goal goal = take_goal(of_world);
  Result<World> world = find_unaimed(name_or_file, of_world);
  if (world && exploration) world = explored(*std::move(world), *exploration);
  if (!world || (goal.states.empty() && goal.rewards.empty())) return world;
  Parameters all = world->parameters;
  for (const auto& one : parameters) {
    if (one.first.starts_with("--")) all.push_back(one);
  }
  world = aimed(*std::move(world), goal);
  if (world) world->parameters = std::move(all);
  return world;
}

}  // namespace

Result<World> find_world(const std::string& name_or_file, const Parameters& parameters) {
  return find(name_or_file, parameters, nullptr);
}

Result<World> find_explored(const std::string& name_or_file, const Parameters& parameters,
                            const ExploreSettings& exploration) {
  return find(name_or_file, parameters, &exploration);
}

}  // namespace quoll
