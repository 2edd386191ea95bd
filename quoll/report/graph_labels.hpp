#pragma once
// Places for the labels of arrows, so that no two overlap and none touches a state.

#include <optional>
#include <vector>

#include "quoll/report/graph_arrows.hpp"

namespace quoll {

/// The box an arrow's label needs; its corner is at the origin. Empty for a label without lines.
Box label_size(const Arrow& arrow);

/// A place for each label near its own curve, or nothing where none is free. Short arrows choose
/// first; among free places the one that hides least of other arrows and lies nearest to its
/// curve's middle. `all_or_nothing`: gives up at the first label without a place. Cost: arrows^2 x
/// some hundred.
std::vector<std::optional<Box>> place_labels(const std::vector<Arrow>& arrows,
                                             const std::vector<Box>& nodes, bool all_or_nothing);

}  // namespace quoll
