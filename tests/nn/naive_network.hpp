#pragma once
// What a network computes, in double precision and as plainly as can be, to hold passes against.

#include <cmath>
#include <cstddef>
#include <vector>

#include "quoll/nn/network.hpp"

namespace quoll::nn {

class NaiveNetwork {
 public:
  using Row = std::vector<double>;

  explicit NaiveNetwork(const Network& plan) : plan_(plan) {}

  /// The outputs of each head for one sample, without padding.
  std::vector<Row> outputs(const Row& parameters, const Row& input) const {
    Row x = input;
    for (const Layer& layer : plan_.body()) x = forward(layer, parameters, x);
    std::vector<Row> all;
    for (std::size_t h = 0; h < plan_.heads(); ++h) {
      Row y = x;
      for (const Layer& layer : plan_.head(h)) y = forward(layer, parameters, y);
      all.push_back(y);
    }
    return all;
  }

 private:
  // `x` and the result hold no padding: place by place, the channels of a place together.
  static Row forward(const Layer& layer, const Row& p, const Row& x) {
    const LayerSpec& spec = layer.spec;
    const std::size_t kernel = spec.convolution() ? spec.kernel : 0, n = layer.outputs;
    const std::size_t height = kernel > 0 ? (layer.in.height - kernel) / spec.stride + 1 : 1;
    const std::size_t width = kernel > 0 ? (layer.in.width - kernel) / spec.stride + 1 : 1;
    Row sums;
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t z = 0; z < width; ++z) {
        for (std::size_t j = 0; j < n; ++j) {
          double sum = p[layer.bias + j];
          const std::size_t high = kernel > 0 ? kernel : layer.in.height;
          const std::size_t wide = kernel > 0 ? kernel : layer.in.width;
          for (std::size_t a = 0; a < high; ++a) {
            for (std::size_t b = 0; b < wide; ++b) {
              for (std::size_t c = 0; c < layer.in_used; ++c) {
                const std::size_t weight = (a * wide + b) * layer.in.channels + c;
                const std::size_t place =
                    (y * spec.stride + a) * layer.in.width + z * spec.stride + b;
                sum += x[place * layer.in_used + c] * p[layer.weights + weight * layer.row + j];
              }
            }
          }
          sums.push_back(sum);
        }
      }
    }
    normalise(layer, p, sums);
    for (double& one : sums) one = activated(spec.activation, one);
    return sums;
  }

  static void normalise(const Layer& layer, const Row& p, Row& sums) {
    if (!layer.normalised()) return;
    const bool whole = layer.spec.normalisation == Normalisation::sample;
    const std::size_t group = whole ? sums.size() : layer.outputs;
    for (std::size_t begin = 0; begin < sums.size(); begin += group) {
      const auto count = static_cast<double>(group);
      double mean = 0.0, variance = 0.0;
      for (std::size_t i = 0; i < group; ++i) mean += sums[begin + i] / count;
      for (std::size_t i = 0; i < group; ++i) {
        variance += (sums[begin + i] - mean) * (sums[begin + i] - mean) / count;
      }
      for (std::size_t i = 0; i < group; ++i) {
        const double z = (sums[begin + i] - mean) / std::sqrt(variance + 1e-5);
        sums[begin + i] = z * p[layer.gain + i] + p[layer.shift + i];
      }
    }
  }

  static double activated(Activation kind, double x) {
    if (kind == Activation::tanh) return std::tanh(x);
    if (kind == Activation::none || x > 0.0) return x;
    if (kind == Activation::leaky_relu) return double{0.01f} * x;
    return kind == Activation::elu ? std::expm1(x) : 0.0;
  }

  const Network& plan_;
};

}  // namespace quoll::nn
