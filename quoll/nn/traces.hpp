#pragma once
// Gradients that are remembered: one trace for each parameter, and a step along all of them that is
// kept from going too far. Elsayed, Vasan, Mahmood 2024 ("Streaming deep reinforcement learning
// finally works"), overshooting-bounded gradient descent (ObGD):
//
//   z <- d z + g;  M = a k max(|delta|, 1) sum |z|;  x += min(1, 1 / M) a delta z
//
// x parameters, g the gradient of the value (not of a loss), a step size, k bound.

#include <span>

#include "quoll/base/archive.hpp"
#include "quoll/nn/pass.hpp"

namespace quoll::nn {

struct TraceStep {
  double decay = 0.0;      ///< d: what is left of the traces, any sign
  double delta = 0.0;      ///< how far the value was wrong
  double step_size = 1.0;  ///< a
  double bound = 2.0;      ///< k: a step may correct about 1 / k of delta
};

class Traces {
 public:
  /// For arrays of `parameters` floats, a multiple of vector_width; 0 = none.
  explicit Traces(std::size_t parameters) : traces_(parameters) {}

  /// The step that was taken, at most a.
  double step(std::span<float> parameters, std::span<const float> gradients, const TraceStep& how);
  void clear();
  std::size_t size() const { return traces_.size(); }
  void persist(Archive& archive);

 private:
  Floats traces_;
};

}  // namespace quoll::nn
