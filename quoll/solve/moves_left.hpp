#pragma once
// How many moves an episode may still take.

#include <cstdint>
#include <optional>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Per live state w(s) such that w(s) >= 3/4 + sum of p w(s') for all of its allowed choices; the
/// states of one of `parts` share one w, as if moves inside were none. 0 elsewhere. So 4/3 w bounds
/// the expected number of moves under every policy of allowed choices. Nothing if that is above
/// 1e9 or takes too long to find. Not rounded outward. Cost: sweeps in the order of the components
/// or of the distance to the ends.
std::optional<std::vector<double>> moves_left(const Mdp& mdp, const std::vector<std::uint8_t>& live,
                                              const std::vector<bool>& allowed,
                                              const EndComponents& parts);

}  // namespace quoll
