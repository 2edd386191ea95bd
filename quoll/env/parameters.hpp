#pragma once
// What every world file takes from quoll/base/parameters.hpp, and the settings of worlds without.

#include "quoll/base/parameters.hpp"

namespace quoll {

/// For worlds without parameters.
struct NoParameters {
  void describe(Describer&) {}
};

}  // namespace quoll
