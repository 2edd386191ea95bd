#pragma once
// What the outputs of one action say of its return: a mean, probabilities of fixed values (C51:
// Bellemare, Dabney, Munos 2017), or values at fixed probabilities (QR-DQN: Dabney, Rowland,
// Bellemare, Munos 2018).

#include <span>

#include "quoll/learn/deep/deep_settings.hpp"

namespace quoll {

class Distribution {
 public:
  Distribution(Returns kind, std::size_t atoms, double low, double high)
      : kind_(kind), atoms_(atoms), low_(low), high_(high) {}

  std::size_t atoms() const { return atoms_; }
  /// The value that an atom of C51 stands for.
  float atom(std::size_t i) const {
    return static_cast<float>(low_ + (high_ - low_) * static_cast<double>(i) /
                                         static_cast<double>(atoms_ - 1));
  }
  /// The mean return that an action's outputs stand for.
  float mean(std::span<const float> outputs) const;
  /// The target of r + carry * Z, with Z as `outputs` say: a number, the probabilities of the
  /// atoms, or values. The projection of C51 keeps the mass also where an atom meets another.
  void target(std::span<const float> outputs, float reward, float carry,
              std::span<float> out) const;
  /// The same where the mean of Z was found otherwise; kind mean only.
  static float target(float mean, float reward, float carry) { return reward + carry * mean; }

 private:
  Returns kind_;
  std::size_t atoms_;
  double low_, high_;
};

}  // namespace quoll
