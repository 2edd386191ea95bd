#pragma once
// Bounds on the optimal value of a start as words and as JSON: what they are, what they rest on and
// what keeps them apart.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quoll/base/json.hpp"
#include "quoll/learn/certifier.hpp"

namespace quoll {

/// A pair that keeps bounds apart, by name.
struct NamedBlocking {
  std::string state, action;
  std::uint64_t tried = 0, needed = 0;
};

struct BoundsReport {
  double lower = 0.0, upper = 0.0, gap = 0.0;
  bool by_model = false;             ///< else from experience
  std::optional<double> confidence;  ///< none: nothing is left to chance
  std::vector<std::string> assumptions;
  std::optional<bool> reached;          ///< whether the gap is as small as was asked for, if it was
  std::vector<NamedBlocking> blocking;  ///< the first of them, where it was not reached
  std::uint64_t needed = 0;             ///< samples that all of them may still need
};

/// What experience proved; without names, so without what blocks.
BoundsReport bounds_report(const Certifier& certifier);

/// "the world being deterministic", "with 95 % confidence".
std::string certainty_text(const BoundsReport& report);

/// The line "Blocked by ..", with at most five pairs; empty where nothing blocks.
std::string blocking_text(const BoundsReport& report);

/// The line "Assumed: .."; empty where nothing is assumed.
std::string assumed_text(const BoundsReport& report);

/// The member "certificate" (docs/json.md); null without a report.
void write_bounds(JsonWriter& json, const std::optional<BoundsReport>& report);

}  // namespace quoll
