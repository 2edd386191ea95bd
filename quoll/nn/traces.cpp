#include "quoll/nn/traces.hpp"

#include <algorithm>
#include <cmath>

namespace quoll::nn {

double Traces::step(std::span<float> parameters, std::span<const float> gradients,
                    const TraceStep& how) {
  const Arithmetic& with = arithmetic();
  const double length =
      with.trace(traces_.data(), gradients.data(), traces_.size(), static_cast<float>(how.decay));
  const double reach = how.step_size * how.bound * std::max(std::fabs(how.delta), 1.0) * length;
  const double taken = reach > 1.0 ? how.step_size / reach : how.step_size;
  with.sgd(parameters.data(), traces_.data(), traces_.size(),
           static_cast<float>(-taken * how.delta));
  return taken;
}

void Traces::clear() {
  std::fill_n(traces_.data(), traces_.size(), 0.0F);
}

void Traces::persist(Archive& archive) {
  persist_floats(archive, "traces", traces_);
}

}  // namespace quoll::nn
