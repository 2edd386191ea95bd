#pragma once
// A network and its numbers without padding, for other programs: what a Network lays out for speed,
// as people would write it down.

#include <span>
#include <vector>

#include "quoll/nn/network.hpp"

namespace quoll::nn {

struct PlainLayer {
  LayerSpec spec;
  Extent in, out;
  /// A row of out.channels numbers for each number that an output reads: of a dense layer in.size()
  /// rows, of a convolution kernel x kernel x in.channels, channels together.
  std::vector<float> weights;
  std::vector<float> bias;
  /// Of a normalised layer: out.channels numbers, or those of every place where a sample is
  /// normalised as a whole.
  std::vector<float> gain, shift;
};

struct PlainNetwork {
  Extent input;
  std::vector<PlainLayer> body;
  std::vector<std::vector<PlainLayer>> heads;  ///< all read what the body gives
};

/// `parameters` = as the network lays them out.
PlainNetwork plain(const Network& network, std::span<const float> parameters);

}  // namespace quoll::nn
