// The weights of a network in the safetensors format (github.com/huggingface/safetensors): 8 bytes
// with the length of a JSON text, the text, which says where each tensor lies, and the tensors
// without gaps, least significant byte first.

#include <bit>

#include "quoll/base/bytes.hpp"
#include "quoll/base/json.hpp"
#include "quoll/base/text.hpp"
#include "quoll/report/network_export.hpp"

namespace quoll {
namespace {

class Tensors {
 public:
  using Shape = std::vector<std::size_t>;

  void add(const std::string& name, const Shape& shape, std::span<const float> numbers) {
    begin(name, "F32", shape);
    for (const float x : numbers) append_little(data_, std::bit_cast<std::uint32_t>(x));
    end();
  }
  void add(const std::string& name, const Shape& shape, std::span<const State> numbers) {
    begin(name, "I64", shape);
    for (const State x : numbers) append_little(data_, std::uint64_t{x});
    end();
  }

  std::string file(std::span<const std::pair<std::string, std::string>> facts) {
    json_.key("__metadata__").begin_object();
    for (const auto& [key, text] : facts) json_.member(key, text);
    json_.end_object().end_object();
    std::string head = json_.take(), out;
    head.resize((head.size() + 7) / 8 * 8, ' ');
    append_little(out, std::uint64_t{head.size()});
    return out + head + data_;
  }

 private:
  void begin(const std::string& name, std::string_view type, const Shape& shape) {
    json_.key(name).begin_object().member("dtype", type).key("shape").begin_array();
    for (const std::size_t size : shape) json_.value(size);
    json_.end_array().key("data_offsets").begin_array().value(data_.size());
  }
  void end() { json_.value(data_.size()).end_array().end_object(); }

  JsonWriter json_ = std::move(JsonWriter().begin_object());
  std::string data_;
};

// From `places` rows of `channels` numbers to channels of places.
std::vector<float> channels_first(std::span<const float> x, std::size_t places,
                                  std::size_t channels) {
  std::vector<float> out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i % channels * places + i / channels] = x[i];
  return out;
}

// Outputs x inputs; inputs that a convolution gave channels first, as a convolution's own.
void add_layer(Tensors& tensors, const std::string& name, const nn::PlainLayer& layer,
               bool after_convolution) {
  const std::size_t outputs = layer.out.channels, inputs = layer.weights.size() / outputs;
  const std::size_t channels = layer.in.channels, places = inputs / channels;
  const bool turned = layer.spec.convolution() || after_convolution;
  std::vector<float> weights;
  weights.reserve(layer.weights.size());
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) {
      const std::size_t from = turned ? i % places * channels + i / places : i;
      weights.push_back(layer.weights[from * outputs + o]);
    }
  }
  const std::size_t kernel = layer.spec.kernel;
  tensors.add(name + ".weight",
              layer.spec.convolution() ? Tensors::Shape{outputs, channels, kernel, kernel}
                                       : Tensors::Shape{outputs, inputs},
              weights);
  tensors.add(name + ".bias", {outputs}, layer.bias);
  if (layer.gain.empty()) return;
  const std::size_t normalised = layer.gain.size() / outputs;
  Tensors::Shape shape{outputs};
  if (normalised > 1) shape = {outputs, layer.out.height, layer.out.width};
  tensors.add(name + ".norm.weight", shape, channels_first(layer.gain, normalised, outputs));
  tensors.add(name + ".norm.bias", shape, channels_first(layer.shift, normalised, outputs));
}

// What each layer does besides its sums, in the order of the layers.
std::string layers(const nn::PlainNetwork& network) {
  constexpr std::string_view normalisations[] = {"none", "sample", "channels"};
  JsonWriter json;
  json.begin_object();
  each_layer(network, [&](const std::string& name, const nn::PlainLayer& layer, bool) {
    json.key(name).begin_object();
    json.member("stride", layer.spec.stride);
    json.member("normalisation",
                normalisations[static_cast<std::size_t>(layer.spec.normalisation)]);
    json.member("activation",
                nn::activation_names[static_cast<std::size_t>(layer.spec.activation)]);
    json.end_object();
  });
  json.end_object();
  return json.take();
}

Tensors::Shape row_of(const nn::Extent& in) {
  if (in.places() > 1) return {in.height, in.width, in.channels};
  return {in.channels};
}

void add_vectors(Tensors& tensors, const NetworkExport& what) {
  const NetworkVectors& vectors = what.vectors;
  Tensors::Shape shape = row_of(what.network->observed);
  shape.insert(shape.begin(), vectors.count);
  if (what.network->numbered) {
    tensors.add("self_test.inputs", {vectors.count}, std::span<const State>(vectors.states));
  } else {
    tensors.add("self_test.inputs", shape, vectors.observations);
  }
  tensors.add("self_test.q", {vectors.count, what.network->actions}, vectors.q);
}

}  // namespace

std::string network_safetensors(const NetworkExport& what) {
  const LearnedNetwork& network = *what.network;
  Tensors tensors;
  add_vectors(tensors, what);
  if (!network.scale.empty()) {
    const Tensors::Shape shape = row_of(network.observed);
    tensors.add("input.middle", shape, network.middle);
    tensors.add("input.scale", shape, network.scale);
  }
  if (!network.support.empty()) tensors.add("support", {network.support.size()}, network.support);
  each_layer(network.network,
             [&](const std::string& name, const nn::PlainLayer& layer, bool first) {
               // Several places are what a convolution gave, or the input.
               add_layer(tensors, name, layer, layer.in.places() > 1 && !first);
             });
  auto facts = network_facts(what);
  facts.emplace_back("format", "pt");
  facts.emplace_back("layers", layers(network.network));
  facts.emplace_back("normalisation_epsilon", shortest(nn::normalisation_epsilon));
  facts.emplace_back("duelling", network.duelling ? "true" : "false");
  return tensors.file(facts);
}

}  // namespace quoll
