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

#include "quoll/env/environment.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// What a world declares of itself; defaults and stopping rules follow these, never a measurement.
struct Traits {
  bool deterministic = false;
  bool settable = false;  ///< can be put into any state: start strategies may choose
  std::uint32_t players = 1;
  std::uint64_t states = 0;  ///< 0 = not enumerable
  std::optional<std::pair<double, double>> reward_bounds;
  enum class StepCost : std::uint8_t { cheap, dear } step_cost = StepCost::cheap;
};

struct World {
  std::string name;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< as given by --with
  Traits traits;
  double discount = 1.0;
  std::uint64_t episode_steps = 0;  ///< the world's own step limit; 0 = none
  std::shared_ptr<const Mdp> mdp;   ///< the model, or null when it is not known
  /// `lanes` environments in one, for a seed.
  std::function<std::unique_ptr<Environment>(std::uint32_t lanes, std::uint64_t seed)> make;
};

/// The world around a model; traits, discount and environment follow from it.
World to_world(std::string name, Mdp mdp);

/// A built-in name or alias, or a file of a known format, with `--with key=value` parameters.
Result<World> find_world(const std::string& name_or_file,
                         const std::vector<std::pair<std::string, std::string>>& parameters = {});

/// One line of `list worlds`.
struct WorldEntry {
  std::string_view name;
  std::string_view aliases;  ///< separated by blanks
  std::string_view summary;
  Result<World> (*make)(const std::vector<std::pair<std::string, std::string>>& parameters);
};
std::span<const WorldEntry> worlds();

}  // namespace quoll
