#include "quoll/nn/losses.hpp"

#include <algorithm>
#include <array>

#include "quoll/base/math.hpp"
#include "quoll/nn/arithmetic.hpp"

namespace quoll::nn {

namespace {

// Writes e^(x - largest) of each.
struct Partition {
  float largest;
  double sum;
};

Partition partition(std::span<const float> logits, std::span<float> powers) {
  Partition all{*std::max_element(logits.begin(), logits.end()), 0.0};
  std::array<float, 4 * vector_width> part;
  for (std::size_t begin = 0; begin < logits.size(); begin += part.size()) {
    const std::size_t count = std::min(part.size(), logits.size() - begin);
    for (std::size_t i = 0; i < count; ++i) part[i] = logits[begin + i] - all.largest;
    std::fill(part.begin() + static_cast<std::ptrdiff_t>(count), part.end(), 0.0f);
    arithmetic().exponentials(part.data(), padded(count));
    for (std::size_t i = 0; i < count; ++i) {
      powers[begin + i] = part[i];
      all.sum += double{part[i]};
    }
  }
  return all;
}

}  // namespace

void softmax(std::span<const float> logits, std::span<float> probabilities) {
  const auto share = static_cast<float>(1.0 / partition(logits, probabilities).sum);
  for (float& p : probabilities) p *= share;
}

double cross_entropy(std::span<const float> logits, std::span<const float> target, float weight,
                     std::span<float> gradient) {
  const Partition all = partition(logits, gradient);
  const auto share = static_cast<float>(1.0 / all.sum);
  const double log_sum = math::log(all.sum);
  double sum = 0.0;
  for (std::size_t i = 0; i < logits.size(); ++i) {
    sum -= double{target[i]} * (double{logits[i]} - double{all.largest} - log_sum);
    gradient[i] = weight * (gradient[i] * share - target[i]);
  }
  return sum;
}

double quantile_huber(std::span<const float> quantiles, std::span<const float> targets,
                      float weight, std::span<float> gradient) {
  const auto n = static_cast<float>(quantiles.size());
  const auto m = static_cast<float>(targets.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const float tau = (static_cast<float>(i) + 0.5f) / n;
    float slope = 0.0f;
    for (const float target : targets) {
      const float u = target - quantiles[i];
      const float share = u < 0.0f ? 1.0f - tau : tau;
      const Loss one = loss(LossKind::huber, -u);
      sum += double{share} * one.value / double{m};
      slope += share * one.slope / m;
    }
    gradient[i] = weight * slope;
  }
  return sum;
}

}  // namespace quoll::nn
