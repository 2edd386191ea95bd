#pragma once
// The states and actions of a world that has numbered states but no model.

#include <memory>

#include "quoll/env/world.hpp"

namespace quoll {

/// The world's model; or, without one, its states and actions by name as a model of which nothing
/// else is true: every action stays where it is and earns nothing. For tables, files and whatever
/// only needs names. Error: the states cannot be listed.
Result<std::shared_ptr<const Mdp>> listed(const World& world);

}  // namespace quoll
