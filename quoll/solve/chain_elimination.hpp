#pragma once
// Total reward of a chain that ends, by elimination instead of sweeps: sweeps take as many rounds
// as episodes are long, which for a walk without aim grows with the square of the distance.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct ChainValues {
  std::vector<double> lower;  ///< per state; 0 where not live
  std::vector<double> upper;
};

/// From -infinity to infinity where `live`.
ChainValues unbounded_values(const std::vector<std::uint8_t>& live);

/// Certified value at discount 1 of a model with one choice per state. `live` marks states whose
/// every way stays among live states and ends, from each of which an end can be reached. Rows are
/// taken to sum to 1. Where episodes take too many moves to prove anything, about 1e14, only what
/// the first moves earn is a bound, and where rewards have two signs there is none. Nothing if
/// elimination would take more than about 2e9 operations, or if `keep_going` (asked now and then
/// with the number of states eliminated) returns false. Cost on planar worlds: about states^1.5.
std::optional<ChainValues> eliminate_chain(
    const Mdp& chain, const std::vector<std::uint8_t>& live,
    const std::function<bool(std::uint64_t)>& keep_going = {});

}  // namespace quoll
