#pragma once
// What one number of an observation is.

#include <string_view>

namespace quoll {

/// One observed number: what people call it, and between which values it lies in all that matters;
/// bins and tiles divide this range, and what is below or above counts as its first or last one.
struct Measured {
  std::string_view name;
  double low, high;
};

}  // namespace quoll
