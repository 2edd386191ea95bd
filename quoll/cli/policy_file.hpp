#pragma once
// A policy as a person hands it over: --policy FILE.

#include <memory>
#include <string>
#include <vector>

#include "quoll/act/policy.hpp"
#include "quoll/base/error.hpp"
#include "quoll/env/world.hpp"

namespace quoll::cli {

/// The action per state that a file gives; no_action where it says nothing. A world whose states
/// cannot be listed takes none. By the file's name:
///   .csv    header state,action, or x,y,state,move,cost as solve and export write of a map; one
///           row per state; an empty action = none
///   .json   what learn, solve and export write: a list "policy" or "values" with state and action
///   .quoll  a saved run of the same model: greedy among the actions its first seed visited
/// In a game against somebody a policy of the same game with another opponent will do, such as one
/// learned by playing oneself: states and actions are found by name.
/// Actions are names or numbers from 0. Errors: one line with the place and the nearest name.
Result<std::vector<Action>> read_policy(const std::string& path, const World& world);

/// The same as something that acts, in every world: a run's policy may be a function of what is
/// observed.
Result<std::unique_ptr<Policy>> read_acting(const std::string& path, const World& world);

/// A saved run: the file itself, or the file run.quoll of a run folder.
std::string run_file(const std::string& path);

}  // namespace quoll::cli
