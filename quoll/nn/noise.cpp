#include "quoll/nn/noise.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/base/ziggurat.hpp"

namespace quoll::nn {
namespace {

bool noisy(const Layer& layer) {
  return !layer.spec.convolution();
}

float factor(Rng& rng) {
  const auto x = static_cast<float>(Ziggurat::normal().draw(rng));
  return std::copysign(std::sqrt(std::fabs(x)), x);
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
  const float* const mu = mu_sigma.data();
  const float* const sigma = mu + weights.size();
  const float* factors = factors_.data();
  for (const Layer& layer : network_.layers()) {
    std::size_t calm = layer.weights;  // what has no noise, from here on
    if (noisy(layer)) {
      rows(layer, factors, [&](std::size_t begin, float by, const float* outputs) {
        arithmetic().perturb(mu + begin, sigma + begin, by, outputs, layer.row,
                             weights.data() + begin);
      });
      calm = layer.bias + layer.row;
    }
    std::copy(mu + calm, mu + layer.end(), weights.data() + calm);
    factors += factors_of(layer);
  }
}

void Noise::pass_on(std::span<float> gradients) const {
  float* const by_sigma = gradients.data() + network_.parameters();
  const float* factors = factors_.data();
  for (const Layer& layer : network_.layers()) {
    std::size_t calm = layer.weights;
    if (noisy(layer)) {
      rows(layer, factors, [&](std::size_t begin, float by, const float* outputs) {
        arithmetic().perturb(nullptr, gradients.data() + begin, by, outputs, layer.row,
                             by_sigma + begin);
      });
      calm = layer.bias + layer.row;
    }
    std::fill(by_sigma + calm, by_sigma + layer.end(), 0.0F);
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
