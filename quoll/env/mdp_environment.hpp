#pragma once
// A model as something to act in: one draw per step and lane, the same draws as the packed tables.

#include <memory>

#include "quoll/env/environment.hpp"
#include "quoll/env/world.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Without `looks` states look like their numbers.
std::unique_ptr<Environment> mdp_environment(std::shared_ptr<const Mdp> mdp, const Lanes& lanes,
                                             std::shared_ptr<const Looks> looks = nullptr,
                                             Seeding seeding = Seeding::quoll);

}  // namespace quoll
