#pragma once
// The layers of a network: what people say of one (LayerSpec), and where it lies in the flat arrays
// (Layer). Numbers of a sample lie in rows padded to nn::padded(n); convolutions take and give
// height x width x channels, channels together.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/nn/arithmetic.hpp"

namespace quoll::nn {

/// What a sample looks like: height x width places of `channels` numbers; 1 x 1 = a vector.
struct Extent {
  std::uint32_t height = 1, width = 1, channels = 0;

  std::size_t places() const { return std::size_t{height} * width; }
  std::size_t size() const { return places() * channels; }
  void persist(Archive& archive) {
    archive("height", height);
    archive("width", width);
    archive("channels", channels);
  }
};

/// Layer normalisation before the activation: over all numbers of a sample, or at each place of a
/// convolution over its channels.
enum class Normalisation : std::uint8_t { none, sample, channels };

/// What is added to the variance.
inline constexpr float normalisation_epsilon = 1e-5f;

/// A dense layer (kernel 0) of `units` outputs, or a convolution with `units` filters of kernel x
/// kernel places, every `stride`-th place, no padding of the borders.
struct LayerSpec {
  std::uint32_t units = 0;
  std::uint32_t kernel = 0;
  std::uint32_t stride = 1;
  Activation activation = Activation::relu;
  Normalisation normalisation = Normalisation::none;
  bool gain = true;  ///< whether gain and shift of the normalisation are learned; else 1 and 0

  bool convolution() const { return kernel > 0; }
  void persist(Archive& archive) {
    archive("units", units);
    archive("kernel", kernel);
    archive("stride", stride);
    archive("activation", activation);
    archive("normalisation", normalisation);
    archive("gain", gain);
  }
};

/// A layer of a network that stands: sizes, and offsets into the flat array of parameters. Weights
/// are inputs x outputs, rows padded(outputs) apart; bias, gain and shift follow them (gain and
/// shift of a sample-normalised convolution have one number per place and channel).
struct Layer {
  LayerSpec spec;
  Extent in, out;           ///< channels of convolutions are padded ones
  std::size_t in_used = 0;  ///< channels of `in` that are no padding
  std::size_t inputs = 0;   ///< k: numbers that one output reads
  std::size_t outputs = 0;  ///< n
  std::size_t row = 0;      ///< padded(outputs): floats from one row of outputs to the next
  std::size_t places = 1;   ///< rows per sample
  std::size_t weights = 0, bias = 0, gain = 0, shift = 0;  ///< offsets

  /// Floats of a sample's outputs, padding included.
  std::size_t width() const { return places * row; }
  /// Inputs that are no padding, and whether one is.
  std::size_t fan() const { return inputs / in.channels * in_used; }
  bool used(std::size_t input) const { return input % in.channels < in_used; }
  bool normalised() const { return spec.normalisation != Normalisation::none; }
  /// One more than the offset of its last parameter.
  std::size_t end() const { return normalised() ? shift + normalised_row() : bias + row; }
  /// Numbers that are normalised together.
  std::size_t normalised_row() const {
    return spec.normalisation == Normalisation::sample ? width() : row;
  }
};

}  // namespace quoll::nn
