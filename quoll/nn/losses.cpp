#include "quoll/nn/losses.hpp"

#include <algorithm>

#include "quoll/base/math.hpp"

namespace quoll::nn {

namespace {

// log sum exp(x - largest), and the largest.
struct Partition {
  float largest;
  double log_sum;
};

Partition partition(std::span<const float> logits) {
  const float largest = *std::max_element(logits.begin(), logits.end());
  double sum = 0.0;
  for (const float x : logits) sum += math::exp(double{x} - double{largest});
  return {largest, math::log(sum)};
}

}  // namespace

void softmax(std::span<const float> logits, std::span<float> probabilities) {
  const Partition all = partition(logits);
  for (std::size_t i = 0; i < logits.size(); ++i) {
    probabilities[i] =
        static_cast<float>(math::exp(double{logits[i]} - double{all.largest} - all.log_sum));
  }
}

double cross_entropy(std::span<const float> logits, std::span<const float> target, float weight,
                     std::span<float> gradient) {
  const Partition all = partition(logits);
  double sum = 0.0;
  for (std::size_t i = 0; i < logits.size(); ++i) {
    const double log_p = double{logits[i]} - double{all.largest} - all.log_sum;
    sum -= double{target[i]} * log_p;
    gradient[i] = weight * (static_cast<float>(math::exp(log_p)) - target[i]);
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
