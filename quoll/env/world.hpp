#pragma once
// A World is what every verb takes: a problem with its name, its traits, its model if known, and a
// maker of environments.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/dice.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/env/measured.hpp"
#include "quoll/env/parameters.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// What a world declares of itself; defaults and stopping rules follow these, never a measurement.
struct Traits {
  bool deterministic = false;
  bool settable = false;  ///< can be put into any state: start strategies may choose
  std::uint32_t players = 1;
  std::uint64_t states = 0;  ///< 0 = not enumerable
  std::optional<std::pair<double, double>> reward_bounds;
  /// Bounds of the rewards of steps that do not end an episode, where they are narrower.
  std::optional<std::pair<double, double>> running_rewards;
  enum class StepCost : std::uint8_t { cheap, dear } step_cost = StepCost::cheap;
  bool libm = false;  ///< its bits depend on the C library's functions
  /// The mean return from which its source counts it as solved, where it says one.
  std::optional<double> solved;
};

struct World {
  std::string name;
  Parameters parameters;  ///< those of the alias and those given by --with, each name once
  Traits traits;
  double discount = 1.0;
  std::uint64_t episode_steps = 0;        ///< the world's own step limit; 0 = none
  std::shared_ptr<const Mdp> mdp;         ///< the model, or null when it is not known
  std::vector<std::string> action_names;  ///< of worlds without a model; empty = numbers
  std::vector<Measured> measured;         ///< the numbers of an observation; empty = not told
  /// What the numbered states of a world without a model are called; empty = their numbers.
  std::function<std::string(State)> state_name;
  /// Environments in one; never null.
  std::function<std::unique_ptr<Environment>(Lanes)> make;
};

/// How the states of a model look to people. Without text and drawing: the grid with the agent in
/// it where the model has a layout, else the state's name and no picture.
struct Looks {
  std::function<std::string(State)> text;
  std::function<Drawing(State)> drawing;
  std::function<Tree(State)> observation;  ///< empty = the state's number
};

/// The world around a model; traits, discount and environment follow from it. With Gymnasium's
/// seeding a step and a start take one uniform number each, and the first outcome, in the order of
/// the model's arrays, whose running sum exceeds it.
World to_world(std::string name, Mdp mdp, Looks looks = {}, std::uint64_t episode_steps = 0,
               Seeding seeding = Seeding::quoll);

/// A built-in name or alias, or a file of a known format, with `--with key=value` parameters.
Result<World> find_world(const std::string& name_or_file, const Parameters& parameters = {});

/// What a world offers with its standard parameters.
struct Offer {
  Spaces spaces;
  std::uint64_t episode_steps = 0;  ///< the world's own step limit; 0 = none
  double discount = 1.0;
  bool libm = false;
};

/// One line of `list worlds`. An alias may set parameters: "FrozenLake8x8-v1:map=8x8".
struct WorldEntry {
  std::string_view name;
  std::string_view aliases;  ///< separated by blanks
  std::string_view summary;
  std::string_view source;  ///< who describes the world: paper or program
  Result<World> (*make)(const Parameters& parameters);
  std::vector<ParameterText> (*parameters)();
  /// Of worlds that take long to make: what they would offer; nullptr = make one and see.
  Offer (*offer)() = nullptr;
};
std::span<const WorldEntry* const> worlds();

/// What a built-in world offers.
Offer offer_of(const WorldEntry& entry);

/// The built-in world that this is the name or an alias of, or nullptr.
const WorldEntry* find_world_entry(std::string_view name);

}  // namespace quoll
