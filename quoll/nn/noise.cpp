#include "quoll/nn/noise.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/normal.hpp"

namespace quoll::nn {
namespace {

bool noisy(const Layer& layer) {
  return !layer.spec.convolution();
}

float factor(Rng& rng) {
  const double x = draw_normal(rng);
  return static_cast<float>(std::copysign(std::sqrt(std::fabs(x)), x));
}

// The rows of a layer that have noise, the bias last: calls row(offset, factor of the input,
// factors of the outputs) for each.
template <class Row>
void rows(const Layer& layer, const float* factors, const Row& row) {
  const float* const outputs = factors + padded(layer.inputs);
  for (std::size_t i = 0; i < layer.inputs; ++i) {
    row(layer.weights + i * layer.row, factors[i], outputs);
  }
  row(layer.bias, 1.0F, outputs);
}

std::size_t factors_of(const Layer& layer) {
  return noisy(layer) ? padded(layer.inputs) + layer.row : 0;
}

}  // namespace

Noise::Noise(const Network& network) : network_(network) {
  std::size_t count = 0;
  for (const Layer& layer : network.layers()) count += factors_of(layer);
  factors_ = Floats(count);
}

void Noise::draw(Rng& rng) {
  float* at = factors_.data();
  for (const Layer& layer : network_.layers()) {
    if (!noisy(layer)) continue;
    for (std::size_t i = 0; i < layer.inputs; ++i) at[i] = layer.used(i) ? factor(rng) : 0.0F;
    at += padded(layer.inputs);
    for (std::size_t j = 0; j < layer.outputs; ++j) at[j] = factor(rng);
    at += layer.row;
  }
}

void Noise::compose(std::span<const float> mu_sigma, std::span<float> weights) const {
  std::copy_n(mu_sigma.data(), weights.size(), weights.data());
  const float* const sigma = mu_sigma.data() + weights.size();
  const float* factors = factors_.data();
  for (const Layer& layer : network_.layers()) {
    if (!noisy(layer)) continue;
    rows(layer, factors, [&](std::size_t begin, float by, const float* outputs) {
      float* __restrict const w = weights.data() + begin;
      const float* __restrict const spread = sigma + begin;
      for (std::size_t j = 0; j < layer.row; j += vector_width) {
        for (std::size_t k = j; k < j + vector_width; ++k) w[k] += spread[k] * (by * outputs[k]);
      }
    });
    factors += factors_of(layer);
  }
}

void Noise::pass_on(std::span<float> gradients) const {
  const std::size_t parameters = network_.parameters();
  std::fill_n(gradients.data() + parameters, parameters, 0.0F);
  const float* factors = factors_.data();
  for (const Layer& layer : network_.layers()) {
    if (!noisy(layer)) continue;
    rows(layer, factors, [&](std::size_t begin, float by, const float* outputs) {
      const float* __restrict const by_w = gradients.data() + begin;
      float* __restrict const by_sigma = gradients.data() + parameters + begin;
      for (std::size_t j = 0; j < layer.row; j += vector_width) {
        for (std::size_t k = j; k < j + vector_width; ++k) {
          by_sigma[k] = by_w[k] * (by * outputs[k]);
        }
      }
    });
    factors += factors_of(layer);
  }
}

void initialise_sigma(const Network& network, std::span<float> sigma) {
  std::fill(sigma.begin(), sigma.end(), 0.0F);
  for (const Layer& layer : network.layers()) {
    if (!noisy(layer)) continue;
    const auto spread = static_cast<float>(0.5 / std::sqrt(static_cast<double>(layer.fan())));
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      if (layer.used(i))
        std::fill_n(sigma.data() + layer.weights + i * layer.row, layer.outputs, spread);
    }
    std::fill_n(sigma.data() + layer.bias, layer.outputs, spread);
  }
}

}  // namespace quoll::nn
