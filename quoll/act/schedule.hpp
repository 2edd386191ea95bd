#pragma once
// A parameter that changes with the step number: constant, or linear between two values.

#include <cstdint>
#include <string>
#include <string_view>

#include "quoll/base/error.hpp"

namespace quoll {

/// value(step) = from + (to - from) * min(1, step / steps). Steps are absolute steps of the run,
/// never fractions of a limit, so that a longer run begins like a shorter one.
struct Schedule {
  double from = 0.0;
  double to = 0.0;
  std::uint64_t steps = 0;  ///< 0 = constant `from`

  bool constant() const { return steps == 0; }
  double at(std::uint64_t step) const {
    if (steps == 0) return from;
    if (step >= steps) return to;
    return from + (to - from) * (static_cast<double>(step) / static_cast<double>(steps));
  }

  template <class Archive>
  void persist(Archive& archive) {
    archive("from", from);
    archive("to", to);
    archive("steps", steps);
  }
};

/// "0.1", or "1:0.05:10000" = from 1 to 0.05 over the first 10000 steps. `low` and `high` bound
/// both values; `place` is the flag or key for the message. Where `whole` is not 0 a value may also
/// be a share of it: "5%", "5%:0.5%:10000".
Result<Schedule> parse_schedule(std::string_view text, double low, double high,
                                std::string_view place, double whole = 0.0);

}  // namespace quoll
