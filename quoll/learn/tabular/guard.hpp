#pragma once
// The divergence guard: no one-step rule with step size in [0, 1] can leave the interval of values
// that policies can earn, |Q| <= B = max(max |Q0|, R / (1 - discount)). A value beyond it is
// reported with that proof; learning halts at 1e30 or at the first number that is not finite.

#include <algorithm>
#include <cmath>

#include "quoll/base/archive.hpp"
#include "quoll/learn/learner.hpp"

namespace quoll {

class Guard {
 public:
  static constexpr double hopeless = 1e30;

  Guard() = default;
  /// `bound` = B, or 0 when the rewards are not known (then the largest met counts).
  Guard(double bound, double discount, double initial)
      : bound_(bound), discount_(discount), initial_(std::fabs(initial)) {
    limit_ = discount < 1.0 ? bound * (1.0 + 1e-5) : hopeless;
  }

  /// The hot test: false for any value worth a closer look, nan included.
  bool fine(double value) const { return std::fabs(value) <= limit_; }

  /// The closer look. True when learning has to halt.
  bool halts(double value, double largest_reward, Impossible here, Impossible& first) {
    if (discount_ < 1.0 && !first.found) {
      if (bound_ == 0.0 || largest_reward > 0.0) {
        bound_ = std::max({bound_, initial_, largest_reward / (1.0 - discount_)});
        limit_ = bound_ * (1.0 + 1e-5);
        if (fine(value)) return false;
      }
      limit_ = hopeless;
      here.bound = bound_;
    }
    const bool halt = !(std::fabs(value) <= hopeless);
    if (!first.found && (halt || discount_ < 1.0)) {
      first = here;
      first.found = true;
      first.value = value;
    }
    return halt;
  }

  void persist(Archive& archive) {
    archive("bound", bound_);
    archive("limit", limit_);
  }

 private:
  double bound_ = 0.0, limit_ = hopeless, discount_ = 1.0, initial_ = 0.0;
};

}  // namespace quoll
