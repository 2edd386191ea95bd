#pragma once
// Which states can be left for an end with probability 1, and a policy that does so.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

struct Ending {
  std::vector<std::uint8_t>
      live;                    ///< 1 = no end, and some policy ends from here with probability 1
  std::vector<Action> policy;  ///< such a policy on live states; the first action on others
};

/// Cost: one search from the ends backwards; more only where some moves lead into states that
/// cannot end.
Ending find_ending(const Mdp& mdp);

}  // namespace quoll
