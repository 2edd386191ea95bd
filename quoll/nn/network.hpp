#pragma once
// Feed-forward networks: a body of layers and one or several heads that all read what the body
// gives (or the input, without a body). Knows nothing of learning from rewards.
//
// A Network is only a plan. Its numbers are flat arrays of parameters() floats that belong to the
// caller: the weights of an online and of a target network, gradients, and what an optimiser
// remembers, so that copying, blending, clipping, stepping and saving are one loop each. Padding
// in them is 0 and stays so.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/base/random.hpp"
#include "quoll/nn/layer.hpp"

namespace quoll::nn {

struct NetworkSpec {
  Extent input;
  std::vector<LayerSpec> body;
  std::vector<std::vector<LayerSpec>> heads;  ///< each with at least one layer
};

/// How weights begin (fan = inputs of a layer; biases 0 unless said):
/// uniform: all numbers, biases too, uniform in +-1/sqrt(fan), as PyTorch's layers do by
/// themselves; he: normal with variance 2/fan (He et al. 2015, equation 10); orthogonal: rows or
/// columns orthogonal, times sqrt(2) (Saxe et al. 2014); sparse: nine in ten inputs of each output,
/// rounded up, weigh 0, the others uniform in +-1/sqrt(fan) (Elsayed, Vasan, Mahmood 2024).
enum class Initial : std::uint8_t { uniform, he, orthogonal, sparse };
inline constexpr std::string_view initial_names[] = {"uniform", "he", "orthogonal", "sparse"};

class Network {
 public:
  /// Error: a layer without outputs, a kernel larger than what it reads.
  static Result<Network> make(const NetworkSpec& spec);

  /// Floats in an array of parameters, padding included; a multiple of vector_width.
  std::size_t parameters() const { return parameters_; }
  /// Numbers that are learned, without padding.
  std::size_t free_parameters() const;
  std::size_t inputs() const { return spec_.input.size(); }
  std::size_t heads() const { return spec_.heads.size(); }
  std::size_t outputs(std::size_t head) const { return layers_[chains_[head + 1] - 1].outputs; }

  const NetworkSpec& spec() const { return spec_; }
  /// The body's layers, then those of each head.
  std::span<const Layer> layers() const { return layers_; }
  std::span<const Layer> body() const { return std::span(layers_).first(chains_[0]); }
  std::span<const Layer> head(std::size_t head) const {
    return std::span(layers_).subspan(chains_[head], chains_[head + 1] - chains_[head]);
  }
  /// The shape that heads read.
  Extent features() const;

  /// Writes parameters() floats.
  void initialise(Initial how, Rng& rng, std::span<float> parameters) const;

 private:
  Result<void> add(const LayerSpec& spec, const Layer* before);

  NetworkSpec spec_;
  std::vector<Layer> layers_;
  std::vector<std::size_t> chains_;  // [0] = end of the body, [h + 1] = end of head h
  std::size_t parameters_ = 0;
};

}  // namespace quoll::nn
