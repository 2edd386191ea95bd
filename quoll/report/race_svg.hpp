#pragma once
// A race as a picture: a row per entrant with the band of its quartiles and a mark at its median,
// on logarithmic axes of steps and of seconds.

#include "quoll/experiment/heat.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

/// Never fails: without heats it says so in the picture. Height grows with the entrants.
Picture race_svg(const RaceResult& race);

}  // namespace quoll
