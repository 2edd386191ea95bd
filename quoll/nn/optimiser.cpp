#include "quoll/nn/optimiser.hpp"

#include <algorithm>
#include <cmath>

namespace quoll::nn {

Optimiser::Optimiser(const OptimiserSettings& settings, std::size_t parameters)
    : settings_(settings) {
  using Kind = OptimiserKind;
  if (settings.kind == Kind::sgd) return;
  square_ = Floats(parameters);
  if (settings.kind != Kind::rmsprop) mean_ = Floats(parameters);
}

AdamStep Optimiser::adam(double learning_rate) const {
  return {static_cast<float>(1.0 - settings_.beta1), static_cast<float>(1.0 - settings_.beta2),
          static_cast<float>(learning_rate / (1.0 - power1_)),
          static_cast<float>(1.0 / std::sqrt(1.0 - power2_)),
          static_cast<float>(settings_.epsilon)};
}

// The epsilon is added to sqrt(v), not to sqrt(v'), as PyTorch does.
AdamStep Optimiser::rectified(double learning_rate) const {
  AdamStep how = adam(learning_rate);
  const double longest = 2.0 / (1.0 - settings_.beta2) - 1.0;
  const double t = static_cast<double>(steps_);
  const double length = longest - 2.0 * t * power2_ / (1.0 - power2_);
  if (length <= 5.0) {
    // x -= a m' : a denominator of 1.
    how.root_scale = 0.0f;
    how.epsilon = 1.0f;
    return how;
  }
  const double rectification = std::sqrt((length - 4.0) * (length - 2.0) * longest /
                                         ((longest - 4.0) * (longest - 2.0) * length));
  how.step = static_cast<float>(learning_rate / (1.0 - power1_) * rectification *
                                std::sqrt(1.0 - power2_));
  how.root_scale = 1.0f;
  return how;
}

void Optimiser::step(std::span<float> parameters, std::span<const float> gradients,
                     double learning_rate) {
  using Kind = OptimiserKind;
  float* const x = parameters.data();
  const float* const g = gradients.data();
  const std::size_t n = parameters.size();
  if (steps_ == 0 && settings_.kind == Kind::rprop) {
    std::fill_n(square_.data(), n, static_cast<float>(learning_rate));
  }
  ++steps_;
  power1_ *= settings_.beta1;
  power2_ *= settings_.beta2;
  const RmsStep rms{static_cast<float>(1.0 - settings_.decay), static_cast<float>(learning_rate),
                    static_cast<float>(settings_.epsilon), settings_.kind == Kind::centred_rmsprop};
  switch (settings_.kind) {
    case Kind::sgd:
      arithmetic().sgd(x, g, n, static_cast<float>(learning_rate));
      break;
    case Kind::rmsprop:
    case Kind::centred_rmsprop:
      arithmetic().rmsprop(x, g, mean_.data(), square_.data(), n, rms);
      break;
    case Kind::adam:
      arithmetic().adam(x, g, mean_.data(), square_.data(), n, adam(learning_rate));
      break;
    case Kind::radam:
      arithmetic().adam(x, g, mean_.data(), square_.data(), n, rectified(learning_rate));
      break;
    case Kind::rprop:
      // Igel, Huesken 2000, section 2: the constants of the paper.
      arithmetic().rprop(x, g, mean_.data(), square_.data(), n, {1.2f, 0.5f, 50.0f, 1e-6f});
      break;
  }
}

void Optimiser::persist(Archive& archive) {
  archive("steps", steps_);
  archive("power1", power1_);
  archive("power2", power2_);
  persist_floats(archive, "mean", mean_);
  persist_floats(archive, "square", square_);
}

double clip_norm(std::span<float> gradients, double most) {
  const double norm = std::sqrt(arithmetic().sum_of_squares(gradients.data(), gradients.size()));
  if (most > 0.0 && norm > most) {
    arithmetic().scale(gradients.data(), gradients.size(),
                       static_cast<float>(most / (norm + 1e-6)));
  }
  return norm;
}

}  // namespace quoll::nn
