#include "quoll/cli/network_words.hpp"

#include <fmt/format.h>

#include "quoll/base/text.hpp"

namespace quoll::cli {
namespace {

std::string size_of(const nn::LayerSpec& layer) {
  std::string text = "-" + std::to_string(layer.units);
  if (layer.convolution()) text += fmt::format("x{}", layer.kernel);
  if (layer.convolution() && layer.stride > 1) text += fmt::format("/{}", layer.stride);
  return text;
}

std::uint64_t numbers_of(const nn::PlainLayer& layer) {
  return layer.weights.size() + layer.bias.size() + layer.gain.size() + layer.shift.size();
}

}  // namespace

std::uint64_t numbers_of(const nn::PlainNetwork& network) {
  std::uint64_t sum = 0;
  for (const nn::PlainLayer& layer : network.body) sum += numbers_of(layer);
  for (const std::vector<nn::PlainLayer>& head : network.heads) {
    for (const nn::PlainLayer& layer : head) sum += numbers_of(layer);
  }
  return sum;
}

std::string sizes_of(const LearnedNetwork& of) {
  const nn::PlainNetwork& network = of.network;
  const nn::Extent& in = network.input;
  std::string text = in.height * in.width > 1
                         ? fmt::format("{}x{}x{}", in.height, in.width, in.channels)
                         : std::to_string(in.channels);
  for (const nn::PlainLayer& layer : network.body) text += size_of(layer.spec);
  for (const nn::PlainLayer& layer : network.heads[0]) {
    if (of.duelling && &layer == &network.heads[0].back()) break;
    text += size_of(layer.spec);
  }
  if (of.duelling) {
    text += fmt::format("-({}+{})", network.heads[0].back().spec.units,
                        network.heads[1].back().spec.units);
  } else if (of.layout == NetworkLayout::separate) {
    text += fmt::format(" for each of {} actions", network.heads.size());
  }
  return text;
}

std::string network_words(const LearnedNetwork& network) {
  return fmt::format("network {}, layout {}, {} numbers", sizes_of(network),
                     layout_names[static_cast<std::size_t>(network.layout)],
                     grouped(numbers_of(network.network)));
}

}  // namespace quoll::cli
