#pragma once
// What turns gradients into steps. x are the parameters, g their gradient, a the learning rate, t
// the number of the step from 1; everything else is a running mean kept by the optimiser.
//
// sgd      x -= a g
// rmsprop  v += (1 - d)(g^2 - v); m += (1 - d)(g - m) if centred, else m = 0;
//          x -= a g / (sqrt(v - m^2) + e)   (Tieleman, Hinton 2012; centred: Graves 2013)
// adam     m += (1 - b1)(g - m); v += (1 - b2)(g^2 - v); m' = m / (1 - b1^t), v' = v / (1 - b2^t);
//          x -= a m' / (sqrt(v') + e)   (Kingma, Ba 2015, algorithm 1)
// radam    rectified Adam (Liu et al. 2020, algorithm 2): with r the length of the average of v,
//          x -= a m' while r <= 5, else adam's step times the rectification
// rprop    a step of its own for each parameter, by the signs of g (Riedmiller, Braun 1993)

#include <cstdint>
#include <span>
#include <string_view>

#include "quoll/base/archive.hpp"
#include "quoll/nn/pass.hpp"

namespace quoll::nn {

enum class OptimiserKind : std::uint8_t { sgd, rmsprop, centred_rmsprop, adam, radam, rprop };
inline constexpr std::string_view optimiser_names[] = {"sgd",  "rmsprop", "centred-rmsprop",
                                                       "adam", "radam",   "rprop"};

struct OptimiserSettings {
  OptimiserKind kind = OptimiserKind::adam;
  double beta1 = 0.9, beta2 = 0.999;  ///< adam, radam
  double decay = 0.95;                ///< d of rmsprop
  double epsilon = 1e-8;              ///< e
};

class Optimiser {
 public:
  /// For arrays of `parameters` floats, a multiple of vector_width.
  Optimiser(const OptimiserSettings& settings, std::size_t parameters);

  /// One step; `learning_rate` is the first step of each parameter for rprop, and not used later.
  void step(std::span<float> parameters, std::span<const float> gradients, double learning_rate);
  /// Steps done.
  std::uint64_t steps() const { return steps_; }
  void persist(Archive& archive);

 private:
  AdamStep adam(double learning_rate) const;
  AdamStep rectified(double learning_rate) const;

  OptimiserSettings settings_;
  Floats mean_, square_;
  std::uint64_t steps_ = 0;
  double power1_ = 1.0, power2_ = 1.0;  // b1^t, b2^t
};

/// Scales the gradients so that their Euclidean norm is at most `most` (0 = no limit); their norm
/// before. PyTorch's rule: times most / (norm + 1e-6).
double clip_norm(std::span<float> gradients, double most);

}  // namespace quoll::nn
