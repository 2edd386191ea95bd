#pragma once
// The maps of the frozen lake: letters S start, F frozen, H hole, G goal.

#include <cstdint>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

/// Rows of equal length.
using LakeMap = std::vector<std::string>;

/// A random square map on which the goal, bottom right, can be reached from the start, top left:
/// every other cell is frozen with probability p. Board after board is drawn, cell by cell in
/// reading order, one uniform number each, until one has a path: number for number what Gymnasium's
/// generate_random_map makes with NumPy's generator of the same seed. Error: no path in 10^7 cells.
Result<LakeMap> generated_lake(std::uint64_t size, double p, std::uint64_t seed);

/// The map in a file: one line per row, all of one length, at least one S. Error: file, line,
/// column.
Result<LakeMap> read_lake(const std::string& path);

}  // namespace quoll
