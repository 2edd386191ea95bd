#pragma once
// How the states of a model with a grid layout look: the grid with the agent in its cell.

#include <string>

#include "quoll/env/drawing.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

class GridLooks {
 public:
  /// Goes through the model once; `mdp` has a layout, and outlives this.
  explicit GridLooks(const Mdp& mdp);

  /// Rows of letters: @ the agent, # no state, S a start (when there is one only), G an end that
  /// can be gained by a reward larger than others', X another end, . the rest. Grids wider than 160
  /// or higher than 100 show the part around the agent.
  std::string text(State at) const;
  /// The same as shapes, a cell one unit wide; the part around the agent of large grids.
  Drawing drawing(State at) const;

 private:
  const Layout& layout_;
  std::string letters_;  // per cell what stands there, the agent apart
};

}  // namespace quoll
