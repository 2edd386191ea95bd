#pragma once
// Noisy networks: dense layers whose weights are drawn anew around a mean that is learned, with a
// spread that is learned too. Fortunato et al. 2018 ("Noisy networks for exploration"), section 3:
//
//   w = mu + sigma e,  e(i,j) = f(e_i) f(e_j) for weights, f(e_j) for biases  (equations 9 to 11)
//   f(x) = sign(x) sqrt|x|, e_i and e_j standard normal: one number for each input and output
//   d/d mu = d/dw,  d/d sigma = e d/dw
//
// mu and sigma are one array of 2 x parameters() floats, mu first; convolutions, gains and shifts
// have a sigma of 0 that stays so, as padding has.

#include <cstddef>
#include <span>

#include "quoll/base/random.hpp"
#include "quoll/nn/network.hpp"
#include "quoll/nn/pass.hpp"

namespace quoll::nn {

class Noise {
 public:
  /// None yet: as if every e were 0. The network must stay where it is.
  explicit Noise(const Network& network);

  /// New noise: a normal number for each input and each output of the dense layers.
  void draw(Rng& rng);
  /// Writes the network.parameters() floats of w.
  void compose(std::span<const float> mu_sigma, std::span<float> weights) const;
  /// Writes the gradient by sigma, behind the gradient by w that `gradients` begins with.
  void pass_on(std::span<float> gradients) const;

 private:
  const Network& network_;
  Floats factors_;  // per dense layer: of its inputs, padded, then of its outputs, row floats
};

/// Writes the beginning of sigma: sigma_0 / sqrt(inputs) with sigma_0 = 0.5 (section 3.2).
void initialise_sigma(const Network& network, std::span<float> sigma);

}  // namespace quoll::nn
