#pragma once
// How the states of a model with a grid layout look: the grid with the agent in its cell.

#include <memory>
#include <string>

#include "quoll/env/drawing.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Rows of letters: @ the agent, # no state, S a start (when there is one only), G an end that can
/// be gained by a reward larger than others', X another end, . the rest. Grids wider than 160 or
/// higher than 100 show the part around the agent.
std::string grid_state_text(const Mdp& mdp, State at);

/// The same as shapes, a cell one unit wide; the part around the agent of large grids.
Drawing grid_state_drawing(const Mdp& mdp, State at);

}  // namespace quoll
