#pragma once
// Step sizes: how far a value moves towards its target at the N-th visit of its pair.
// Even-Dar, Mansour 2003 (JMLR 5) for 1/N^w; Jin et al. 2018 and Wainwright 2019 for (H+1)/(H+N).

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

/// H: how many steps the future counts for, 1 / (1 - discount); 1000 at discount 1.
inline double horizon(double discount) {
  return discount < 1.0 ? 1.0 / (1.0 - discount) : 1000.0;
}

/// A step size that never changes and is not small, for the loop that needs no other.
struct ConstantStep {
  double value;
  bool whole = value == 1.0;
  bool one() const { return whole; }
  bool small() const { return false; }
  double at(std::uint32_t) const { return value; }
};

struct StepSize {
  enum class Kind : std::uint8_t { constant, power, rescaled_linear };
  Kind kind = Kind::constant;
  double value = 1.0;  ///< constant: the step size; power: w; rescaled_linear: H

  bool constant() const { return kind == Kind::constant; }
  /// Steps with which a float, rounded to nearest, may stand still short of its target.
  bool small() const { return kind != Kind::constant || value < 0x1p-10; }
  bool one() const { return kind == Kind::constant && value == 1.0; }

  /// The step size at the N-th visit, N >= 1.
  double at(std::uint32_t n) const {
    if (kind == Kind::rescaled_linear) return (value + 1.0) / (value + static_cast<double>(n));
    if (kind == Kind::power) return n < powers_->size() ? (*powers_)[n] : power(n);
    return value;
  }

  /// Fills the table of the first powers; call once after setting the fields.
  void prepare();
  /// The words that parse_step_size takes back.
  std::string text() const;

 private:
  double power(std::uint32_t n) const;
  std::shared_ptr<const std::vector<double>> powers_;  // shared, so that a copy is cheap
};

/// "0.1", "1/N^0.8", "rescaled-linear" (H = the horizon), or "auto":
/// 1 in a deterministic world, rescaled-linear in others.
Result<StepSize> parse_step_size(std::string_view text, bool deterministic, double discount);

}  // namespace quoll
