#pragma once
// The networks of bench/networks.cpp as one would put them together from a library of matrix
// products, one for each library that was found: beside a bias, a rectifier, patches of
// convolutions (im2col) and Adam, written as loops for this processor, only the product differs.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace yardstick {

/// A convolution of 3 x 3 with 16 filters, if `channels` > 0, over 10 x 10 places; then dense
/// layers, all but the last with a rectifier.
struct NetworkShape {
  std::size_t channels = 0, inputs = 0;
  std::vector<std::size_t> dense;
};

struct Transitions {
  std::vector<float> before, after, rewards;
  std::vector<std::size_t> actions;
};

class LibraryNetwork {
 public:
  virtual ~LibraryNetwork() = default;
  virtual std::string name() const = 0;
  /// Q-values of `samples` rows.
  virtual const float* act(const float* inputs, std::size_t samples) = 0;
  /// One step of DQN: discount 0.99, half the squared error, mean over the batch, Adam 2.5e-4.
  virtual void train(const Transitions& batch) = 0;
};

/// `parameters` = weights (inputs x outputs) and biases, layer after layer.
std::vector<std::unique_ptr<LibraryNetwork>> library_networks(const NetworkShape& shape,
                                                              std::size_t most,
                                                              const std::vector<float>& parameters);

/// GFLOP/s of multiply-adds of the widest vectors in registers alone, on this core.
double core_bound();

}  // namespace yardstick
