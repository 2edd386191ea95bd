#pragma once
// Losses of one number or one distribution, with their gradients by the prediction. Mean over a
// batch is the caller's business: each function takes the `weight` of its sample.

#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

namespace quoll::nn {

enum class LossKind : std::uint8_t { squared, half_squared, huber };
/// "squared" e^2, "half-squared" e^2 / 2, "huber" e^2 / 2 up to |e| = 1, then |e| - 1/2.
inline constexpr std::string_view loss_names[] = {"squared", "half-squared", "huber"};

struct Loss {
  double value = 0.0;
  float slope = 0.0f;  ///< derivative by the prediction
};

/// Of error = prediction - target.
inline Loss loss(LossKind kind, float error) {
  const double e = double{error};
  if (kind == LossKind::squared) return {e * e, 2.0f * error};
  const float size = std::fabs(error);
  if (kind == LossKind::huber && size > 1.0f) {
    return {std::fabs(e) - 0.5, std::copysign(1.0f, error)};
  }
  return {e * e / 2, error};
}

/// Cross-entropy - sum p log softmax(x), of a target distribution p (Bellemare, Dabney, Munos 2017,
/// section 4). Writes weight * (softmax(x) - p) into `gradient`; returns the loss.
double cross_entropy(std::span<const float> logits, std::span<const float> target, float weight,
                     std::span<float> gradient);

/// softmax(x) into `probabilities`; sizes agree.
void softmax(std::span<const float> logits, std::span<float> probabilities);

/// Quantile Huber loss with threshold 1: sum over i of the mean over j of |tau_i - [u < 0]| L(u), u
/// = target_j - quantile_i, tau_i = (i + 1/2) / N (Dabney, Rowland, Bellemare, Munos 2018, equation
/// 10). Writes weight * gradient; returns the loss. Cost: N x M.
double quantile_huber(std::span<const float> quantiles, std::span<const float> targets,
                      float weight, std::span<float> gradient);

}  // namespace quoll::nn
