#pragma once
// A model as something to act in: one draw per step and lane, the same draws as the packed tables.

#include <functional>
#include <memory>

#include "quoll/env/environment.hpp"
#include "quoll/env/world.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// The maker of a world's environments. What they share, the packed table among it, is built once,
/// when the first of them needs it, from whichever thread; it lives as long as the maker. Without
/// `looks` states look like their numbers; `episode_steps` is the limit where lanes give none.
std::function<std::unique_ptr<Environment>(Lanes)> mdp_environments(
    std::shared_ptr<const Mdp> mdp, Looks looks = {}, std::uint64_t episode_steps = 0,
    Seeding seeding = Seeding::quoll);

}  // namespace quoll
