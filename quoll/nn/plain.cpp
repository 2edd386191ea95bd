#include "quoll/nn/plain.hpp"

namespace quoll::nn {
namespace {

PlainLayer plain(const Layer& layer, std::span<const float> parameters) {
  PlainLayer out;
  out.spec = layer.spec;
  out.in = layer.in;
  out.in.channels = static_cast<std::uint32_t>(layer.in_used);
  out.out = layer.out;
  out.out.channels = static_cast<std::uint32_t>(layer.outputs);
  const auto append = [&](std::vector<float>& to, std::size_t offset) {
    const auto row = parameters.subspan(offset, layer.outputs);
    to.insert(to.end(), row.begin(), row.end());
  };
  for (std::size_t i = 0; i < layer.inputs; ++i) {
    if (layer.used(i)) append(out.weights, layer.weights + i * layer.row);
  }
  append(out.bias, layer.bias);
  for (std::size_t at = 0; layer.normalised() && at < layer.normalised_row(); at += layer.row) {
    append(out.gain, layer.gain + at);
    append(out.shift, layer.shift + at);
  }
  return out;
}

}  // namespace

PlainNetwork plain(const Network& network, std::span<const float> parameters) {
  PlainNetwork out;
  out.input = network.spec().input;
  for (const Layer& layer : network.body()) out.body.push_back(plain(layer, parameters));
  for (std::size_t h = 0; h < network.heads(); ++h) {
    std::vector<PlainLayer>& head = out.heads.emplace_back();
    for (const Layer& layer : network.head(h)) head.push_back(plain(layer, parameters));
  }
  return out;
}

}  // namespace quoll::nn
