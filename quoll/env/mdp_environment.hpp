#pragma once
// A model as something to act in: one draw per step and lane, the same draws as the packed tables.

#include <memory>

#include "quoll/env/environment.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

std::unique_ptr<Environment> mdp_environment(std::shared_ptr<const Mdp> mdp, std::uint32_t lanes,
                                             std::uint64_t seed);

}  // namespace quoll
