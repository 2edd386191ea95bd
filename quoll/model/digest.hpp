#pragma once
// A fingerprint of a model: equal for models with the same numbers and names.

#include <cstdint>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// 64 bits over every array and name; the same on every machine. One pass.
std::uint64_t digest(const Mdp& mdp);

}  // namespace quoll
