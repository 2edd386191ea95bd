#pragma once
// A model of a world described by code: its positions are gone through breadth first from the
// start, and each of its draws by all it can give (branches.hpp). What is told apart by its saved
// bytes is a state of its own; so is a position in which an episode has ended, which has no
// actions. A step limit is no part of a state, as it is none of a position.

#include <cstdint>
#include <functional>

#include "quoll/env/world.hpp"

namespace quoll {

struct ExploreSettings {
  std::uint64_t max_states = 1'000'000;
  /// Called now and then: states found, and those of them not yet gone through.
  std::function<void(std::uint64_t found, std::uint64_t open)> progress;
};

/// The model, in the order in which its states are found. States are called by their numbers' names
/// where the world can be put into its numbered states, else by their data ("y=9 cars=[1,2]"); an
/// end whose position is also met before the end, "... (end)". Where a name would be longer than
/// 100 letters or stand twice, all are called by their place in that order. Probabilities are
/// products of those of the draws, summed over equal outcomes. Error: more states than allowed;
/// more than 2^20 outcomes of one step; a real number drawn for itself, not only compared; a step
/// that is not the same function each time; a turn that passes in some steps only; a world that is
/// not described by code. Cost: a call of the world's step per outcome; memory for a position, 12
/// to 24 bytes and a name per state, and the model.
Result<Mdp> explore(const World& world, const ExploreSettings& exploration = {});

/// The world around that model; a world that has a model, as it is.
Result<World> explored(World world, const ExploreSettings& exploration = {});

/// As find_world of env/world.hpp, but a world without a model gets one, or it is an error.
Result<World> find_explored(const std::string& name_or_file, const Parameters& parameters,
                            const ExploreSettings& exploration);

}  // namespace quoll
