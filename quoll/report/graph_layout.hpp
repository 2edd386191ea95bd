#pragma once
// Where the states of a small graph stand.

#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct GraphPoint {
  double x = 0, y = 0;
};

/// Positions in units of one move, ends to the right: stress majorization (Gansner, Koren, North,
/// Graph Drawing 2004) from several beginnings, the one with fewest crossings kept. Deterministic.
/// Cost: states^2 x some thousand; for up to graph_states states.
std::vector<GraphPoint> graph_layout(const Mdp& mdp);

}  // namespace quoll
