#pragma once
// The learning curves of a run: of each seed, and of all of them together.

#include <vector>

#include "quoll/experiment/run.hpp"
#include "quoll/report/curve.hpp"

namespace quoll::cli {

/// The mean returns of one seed; a bin without the end of an episode is left out.
Curve curve_of(const Training& training);

/// Over all seeds: the mean and its 95 % bootstrap interval, bin by bin, as far as every seed
/// walked, in the widest bins that one of them has. A bin in which no episode of a seed ended
/// counts as its last one that had an end.
Curve curve_over_seeds(const Run& run);

/// What a picture shows: each seed of a few, else all together.
std::vector<Curve> curves_of(const Run& run);

}  // namespace quoll::cli
