#include "quoll/nn/network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "quoll/base/normal.hpp"

namespace quoll::nn {

Result<void> Network::add(const LayerSpec& spec, const Layer* before) {
  const auto refuse = [](const std::string& why) { return Error{"network", 0, 0, why, ""}; };
  if (spec.units == 0) return refuse("a layer needs at least one output");
  Layer layer;
  const Extent in = before == nullptr ? spec_.input : before->out;
  layer.spec = spec;
  layer.in = in;
  layer.in_used = before == nullptr ? in.channels : before->outputs;
  layer.inputs = in.size();
  layer.outputs = spec.units;
  layer.row = padded(spec.units);
  layer.out = {1, 1, spec.units};
  if (spec.convolution()) {
    if (spec.stride == 0) return refuse("the stride of a convolution is at least 1");
    if (spec.kernel > in.height || spec.kernel > in.width) {
      return refuse("a kernel of " + std::to_string(spec.kernel) + "x" +
                    std::to_string(spec.kernel) + " does not fit into " +
                    std::to_string(in.height) + "x" + std::to_string(in.width) + " places");
    }
    layer.inputs = std::size_t{spec.kernel} * spec.kernel * in.channels;
    layer.out.height = (in.height - spec.kernel) / spec.stride + 1;
    layer.out.width = (in.width - spec.kernel) / spec.stride + 1;
    layer.out.channels = static_cast<std::uint32_t>(layer.row);
    layer.places = layer.out.places();
    if (spec.normalisation == Normalisation::sample && layer.row != spec.units) {
      return refuse("a convolution is normalised as a whole with a multiple of " +
                    std::to_string(vector_width) + " filters only");
    }
  }
  const auto take = [&](std::size_t floats) {
    const std::size_t at = parameters_;
    parameters_ += floats;
    return at;
  };
  layer.weights = take(layer.inputs * layer.row);
  layer.bias = take(layer.row);
  if (layer.normalised()) {
    layer.gain = take(layer.normalised_row());
    layer.shift = take(layer.normalised_row());
  }
  layers_.push_back(layer);
  return {};
}

Result<Network> Network::make(const NetworkSpec& spec) {
  Network network;
  network.spec_ = spec;
  if (spec.input.size() == 0) return Error{"network", 0, 0, "there is nothing to read", ""};
  if (spec.heads.empty()) return Error{"network", 0, 0, "a network needs a head", ""};
  // Taken by number: the list grows, so pointers into it do not last.
  const auto append = [&](const LayerSpec& layer, std::size_t before) {
    if (before == 0) return network.add(layer, nullptr);
    const Layer copy = network.layers_[before - 1];
    return network.add(layer, &copy);
  };
  for (const LayerSpec& layer : spec.body) {
    const Result<void> added = append(layer, network.layers_.size());
    if (!added) return added.error();
  }
  network.chains_.push_back(network.layers_.size());
  for (const std::vector<LayerSpec>& head : spec.heads) {
    if (head.empty()) return Error{"network", 0, 0, "a head needs a layer", ""};
    if (!spec.body.empty() && head.front().convolution()) {
      return Error{"network", 0, 0, "convolutions stand in the body, before the heads", ""};
    }
    std::size_t before = network.chains_[0];
    for (const LayerSpec& layer : head) {
      const Result<void> added = append(layer, before);
      if (!added) return added.error();
      before = network.layers_.size();
    }
    network.chains_.push_back(before);
  }
  return network;
}

Extent Network::features() const {
  return body().empty() ? spec_.input : body().back().out;
}

namespace {

// Makes columns orthonormal, by modified Gram-Schmidt. Golub, Van Loan 2013, section 5.2.8. Each
// goes from all those after it at once, along the rows: a matrix may be larger than every cache.
void orthogonalise(std::size_t rows, std::size_t columns, double* x) {
  std::vector<double> dots(columns);
  for (std::size_t u = 0; u < columns; ++u) {
    double square = 0.0;
    for (std::size_t i = 0; i < rows; ++i) square += x[i * columns + u] * x[i * columns + u];
    const double norm = std::sqrt(square);
    std::fill(dots.begin(), dots.end(), 0.0);
    for (std::size_t i = 0; i < rows; ++i) {
      double* const row = x + i * columns;
      row[u] /= norm;
      for (std::size_t v = u + 1; v < columns; ++v) dots[v] += row[v] * row[u];
    }
    for (std::size_t i = 0; i < rows; ++i) {
      double* const row = x + i * columns;
      for (std::size_t v = u + 1; v < columns; ++v) row[v] -= dots[v] * row[u];
    }
  }
}

// Orthonormal columns; rows where there are fewer rows than columns.
void orthogonal(std::size_t rows, std::size_t columns, Rng& rng, std::vector<double>& x) {
  for (double& value : x) value = draw_normal(rng);
  if (rows >= columns) return orthogonalise(rows, columns, x.data());
  std::vector<double> turned(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) turned[k % columns * rows + k / columns] = x[k];
  orthogonalise(columns, rows, turned.data());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = turned[k % columns * rows + k / columns];
}

// Of the inputs of each output, in a random order, the first nine in ten become 0.
void thin_out(std::size_t inputs, std::size_t outputs, Rng& rng, std::vector<double>& x) {
  std::vector<std::size_t> order(inputs);
  for (std::size_t j = 0; j < outputs; ++j) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = 0; k < (9 * inputs + 9) / 10; ++k) {
      std::swap(order[k], order[k + rng.below(static_cast<std::uint32_t>(inputs - k))]);
      x[order[k] * outputs + j] = 0.0;
    }
  }
}

}  // namespace

std::size_t Network::free_parameters() const {
  std::size_t sum = 0;
  for (const Layer& layer : layers_) {
    sum += (layer.fan() + 1) * layer.outputs;
    if (!layer.normalised() || !layer.spec.gain) continue;
    const bool whole = layer.spec.normalisation == Normalisation::sample;
    sum += 2 * layer.outputs * (whole ? layer.places : 1);
  }
  return sum;
}

void Network::initialise(Initial how, Rng& rng, std::span<float> parameters) const {
  std::fill(parameters.begin(), parameters.end(), 0.0f);
  for (const Layer& layer : layers_) {
    const std::size_t fan = layer.fan();
    const double bound = 1.0 / std::sqrt(static_cast<double>(fan));
    std::vector<double> weights(fan * layer.outputs);
    if (how == Initial::orthogonal) {
      orthogonal(fan, layer.outputs, rng, weights);
      for (double& value : weights) value *= std::sqrt(2.0);
    } else {
      for (double& value : weights) {
        value = how == Initial::he ? std::sqrt(2.0) * bound * draw_normal(rng)
                                   : bound * (2.0 * rng.uniform() - 1.0);
      }
      if (how == Initial::sparse) thin_out(fan, layer.outputs, rng, weights);
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      if (!layer.used(i)) continue;
      for (std::size_t j = 0; j < layer.outputs; ++j) {
        parameters[layer.weights + i * layer.row + j] = static_cast<float>(weights[next++]);
      }
    }
    if (how == Initial::uniform) {
      for (std::size_t j = 0; j < layer.outputs; ++j) {
        parameters[layer.bias + j] = static_cast<float>(bound * (2.0 * rng.uniform() - 1.0));
      }
    }
    if (!layer.normalised()) continue;
    for (std::size_t i = 0; i < layer.normalised_row(); ++i) {
      parameters[layer.gain + i] = i % layer.row < layer.outputs ? 1.0f : 0.0f;
    }
  }
}

}  // namespace quoll::nn
