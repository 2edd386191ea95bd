// A learned network as a graph of ONNX. Vectors are rows of a batch. Of layout joint the first
// layer's sums are split: what is observed is multiplied once, and each action adds its row of
// weights on a second axis; all later layers work on the last one.

#include <limits>

#include "quoll/base/json.hpp"
#include "quoll/report/network_export.hpp"
#include "quoll/report/onnx_graph.hpp"

namespace quoll {
namespace {

using Numbers = std::vector<std::int64_t>;

// A value of the graph, and how it lies behind the batch.
struct Value {
  std::string name;
  enum class Form : std::uint8_t {
    rows,    // numbers; of layout joint a row of them for each action
    places,  // height, width, channels
    planes   // channels, height, width
  } form = Form::rows;
};

class NetworkGraph {
 public:
  explicit NetworkGraph(const NetworkExport& what) : what_(what), network_(*what.network) {}

  OnnxGraph graph() {
    const Value read = input();
    const std::string outputs = combine(heads(body(read)));
    std::string q = network_.value_scale == 1.0 ? means(outputs, "q") : scaled(means(outputs, ""));
    graph_.output("q", OnnxGraph::Element::real, {-1, network_.actions});
    if (!network_.letters) {
      choose(q);
      graph_.output("action", OnnxGraph::Element::whole, {-1});
    }
    return std::move(graph_);
  }

 private:
  static std::int64_t whole(std::size_t n) { return static_cast<std::int64_t>(n); }
  // A dense layer, or a convolution that reads one place.
  static bool dense(const nn::PlainLayer& layer) {
    return !layer.spec.convolution() || layer.in.places() == 1;
  }
  std::string constant(std::string_view name, const Numbers& shape, std::span<const float> x) {
    return graph_.constant(name, shape, x);
  }
  // A list of whole numbers that an operator reads, by its content.
  std::string list(const Numbers& numbers) {
    std::string name = "list";
    for (const std::int64_t n : numbers) name += "." + std::to_string(n);
    for (const std::string& known : lists_) {
      if (known == name) return name;
    }
    lists_.push_back(name);
    return graph_.constant(name, {whole(numbers.size())}, std::span(numbers));
  }
  std::string scalar(std::string_view name, float x) { return constant(name, {}, {&x, 1}); }

  Value input() {
    if (network_.numbered) {
      graph_.input("state", OnnxGraph::Element::whole, {-1});
      return {"state"};
    }
    const nn::Extent& in = network_.observed;
    const bool planes = in.places() > 1;
    Numbers shape{whole(in.channels)};
    if (planes) shape = {in.height, in.width, in.channels};
    Numbers batch = shape;
    batch.insert(batch.begin(), -1);
    graph_.input("observation", OnnxGraph::Element::real, batch);
    Value x{"observation", planes ? Value::Form::places : Value::Form::rows};
    if (network_.scale.empty()) return x;
    x.name = graph_.node("Sub", {x.name, constant("input.middle", shape, network_.middle)});
    x.name = graph_.node("Mul", {x.name, constant("input.scale", shape, network_.scale)});
    return x;
  }

  Value rows(const Value& x) {
    if (x.form == Value::Form::rows) return x;
    std::string places = x.name;
    if (x.form == Value::Form::planes) {
      places = graph_.node("Transpose", {x.name}, {{"perm", {0, 2, 3, 1}}});
    }
    return {graph_.node("Flatten", {places}, {{"axis", {1}, false}})};
  }
  Value planes(const Value& x) {
    if (x.form == Value::Form::planes) return x;
    return {graph_.node("Transpose", {x.name}, {{"perm", {0, 3, 1, 2}}}), Value::Form::planes};
  }

  // The sums of a dense layer; `first` = it reads the input.
  Value dense_sums(const std::string& name, const nn::PlainLayer& layer, const Value& x,
                   bool first) {
    const std::size_t outputs = layer.out.channels;
    const bool joint = first && network_.layout == NetworkLayout::joint;
    const std::size_t own = layer.weights.size() / outputs - (joint ? network_.actions : 0);
    const auto all = std::span<const float>(layer.weights);
    const std::string weights =
        constant(name + ".weight", {whole(own), whole(outputs)}, all.first(own * outputs));
    const std::string bias = constant(name + ".bias", {whole(outputs)}, layer.bias);
    std::string sums = first && network_.numbered
                           ? graph_.node("Gather", {weights, x.name}, {{"axis", {0}, false}})
                           : graph_.node("MatMul", {rows(x).name, weights});
    sums = graph_.node("Add", {sums, bias});
    if (!joint) return {sums};
    const std::string of_actions = constant(
        name + ".weight.actions", {network_.actions, whole(outputs)}, all.subspan(own * outputs));
    return {graph_.node("Add", {graph_.node("Unsqueeze", {sums, list({1})}), of_actions})};
  }

  Value convolution_sums(const std::string& name, const nn::PlainLayer& layer, const Value& x) {
    const std::size_t k = layer.spec.kernel, in = layer.in.channels, out = layer.out.channels;
    // From kernel rows, kernel columns, inputs, outputs to outputs, inputs, rows, columns.
    std::vector<float> turned;
    turned.reserve(layer.weights.size());
    for (std::size_t o = 0; o < out; ++o) {
      for (std::size_t i = 0; i < in; ++i) {
        for (std::size_t at = 0; at < k * k; ++at) {
          turned.push_back(layer.weights[(at * in + i) * out + o]);
        }
      }
    }
    const std::string weights =
        constant(name + ".weight", {whole(out), whole(in), whole(k), whole(k)}, turned);
    const std::string bias = constant(name + ".bias", {whole(out)}, layer.bias);
    return {graph_.node("Conv", {planes(x).name, weights, bias},
                        {{"kernel_shape", {whole(k), whole(k)}},
                         {"strides", {layer.spec.stride, layer.spec.stride}}}),
            Value::Form::planes};
  }

  // Of operators that every runtime has; LayerNormalization is younger.
  Value normalised(const std::string& name, const nn::PlainLayer& layer, Value x) {
    Numbers axes{-1}, shape{whole(layer.gain.size())};
    std::vector<float> gain = layer.gain, shift = layer.shift;
    if (x.form == Value::Form::planes) {
      const bool sample = layer.spec.normalisation == nn::Normalisation::sample;
      const std::size_t places = sample ? layer.out.places() : 1, channels = layer.out.channels;
      axes = sample ? Numbers{1, 2, 3} : Numbers{1};
      shape = {whole(channels), sample ? layer.out.height : 1, sample ? layer.out.width : 1};
      for (std::size_t i = 0; i < gain.size(); ++i) {
        gain[i % channels * places + i / channels] = layer.gain[i];
        shift[i % channels * places + i / channels] = layer.shift[i];
      }
    }
    const auto mean = [&](const std::string& of) {
      return graph_.node("ReduceMean", {of}, {{"axes", axes}, {"keepdims", {1}, false}});
    };
    if (epsilon_.empty()) epsilon_ = scalar("epsilon", nn::normalisation_epsilon);
    const std::string off = graph_.node("Sub", {x.name, mean(x.name)});
    const std::string variance = mean(graph_.node("Mul", {off, off}));
    const std::string root = graph_.node("Sqrt", {graph_.node("Add", {variance, epsilon_})});
    x.name = graph_.node("Div", {off, root});
    x.name = graph_.node("Mul", {x.name, constant(name + ".norm.weight", shape, gain)});
    x.name = graph_.node("Add", {x.name, constant(name + ".norm.bias", shape, shift)});
    return x;
  }

  Value layer(const std::string& name, const nn::PlainLayer& layer, const Value& x, bool first) {
    Value y = dense(layer) ? dense_sums(name, layer, x, first) : convolution_sums(name, layer, x);
    if (layer.spec.normalisation != nn::Normalisation::none) y = normalised(name, layer, y);
    constexpr std::string_view operators[] = {"", "Relu", "Elu", "Tanh", "LeakyRelu"};
    const std::string_view what = operators[static_cast<std::size_t>(layer.spec.activation)];
    if (!what.empty()) y.name = graph_.node(what, {y.name});
    return y;
  }

  Value chain(const std::string& name, const std::vector<nn::PlainLayer>& layers, Value x,
              bool first) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
      x = layer(name + std::to_string(i), layers[i], x, first && i == 0);
    }
    return x;
  }

  Value body(const Value& x) { return chain("body.", network_.network.body, x, true); }

  std::vector<std::string> heads(const Value& features) {
    std::vector<std::string> outputs;
    for (std::size_t h = 0; h < network_.network.heads.size(); ++h) {
      outputs.push_back(chain("head." + std::to_string(h) + ".", network_.network.heads[h],
                              features, network_.network.body.empty())
                            .name);
    }
    return outputs;
  }

  // [batch, actions, atoms] of what the heads give.
  std::string combine(const std::vector<std::string>& heads) {
    if (network_.layout == NetworkLayout::joint) return heads[0];
    const Numbers shape{-1, network_.actions, network_.atoms};
    if (network_.duelling) {
      const std::string value = graph_.node("Unsqueeze", {heads[0], list({1})});
      const std::string advantage = graph_.node("Reshape", {heads[1], list(shape)});
      const std::string mean =
          graph_.node("ReduceMean", {advantage}, {{"axes", {1}}, {"keepdims", {1}, false}});
      return graph_.node("Sub", {graph_.node("Add", {value, advantage}), mean});
    }
    const std::string all =
        heads.size() == 1 ? heads[0] : graph_.node("Concat", heads, {{"axis", {1}, false}});
    return graph_.node("Reshape", {all, list(shape)});
  }

  // [batch, actions].
  std::string means(const std::string& outputs, std::string_view name) {
    if (network_.returns == Returns::quantile) {
      return graph_.node("ReduceMean", {outputs}, {{"axes", {2}}, {"keepdims", {0}, false}}, name);
    }
    std::string one = outputs;
    if (network_.returns == Returns::categorical) {
      one = graph_.node("MatMul", {graph_.node("Softmax", {outputs}, {{"axis", {2}, false}}),
                                   constant("support", {network_.atoms, 1}, network_.support)});
    }
    return graph_.node("Reshape", {one, list({-1, network_.actions})}, {}, name);
  }

  std::string scaled(const std::string& q) {
    const auto scale = static_cast<float>(network_.value_scale);
    return graph_.node("Div", {q, scalar("value_scale", scale)}, {}, "q");
  }

  // The first of the best ones, of those that the state has.
  void choose(std::string q) {
    const std::vector<Action>& counts = what_.action_counts;
    if (!counts.empty()) {
      const Numbers all(counts.begin(), counts.end());
      Numbers each;
      for (std::uint32_t a = 0; a < network_.actions; ++a) each.push_back(a);
      const std::string of_states =
          graph_.constant("action_counts", {whole(all.size())}, std::span<const std::int64_t>(all));
      const std::string count = graph_.node(
          "Unsqueeze",
          {graph_.node("Gather", {of_states, "state"}, {{"axis", {0}, false}}), list({1})});
      const std::string has = graph_.node("Less", {list(each), count});
      q = graph_.node("Where", {has, q, scalar("none", std::numeric_limits<float>::lowest())});
    }
    graph_.node("ArgMax", {q}, {{"axis", {1}, false}, {"keepdims", {0}, false}}, "action");
  }

  const NetworkExport& what_;
  const LearnedNetwork& network_;
  OnnxGraph graph_;
  std::vector<std::string> lists_;
  std::string epsilon_;
};

// {"inputs": a list of states or of observations, "q": lists}, observations flat.
std::string self_test(const NetworkExport& what) {
  const NetworkVectors& vectors = what.vectors;
  JsonWriter json;
  const auto rows = [&](std::string_view name, const std::vector<float>& numbers) {
    const std::size_t row = numbers.size() / vectors.count;
    json.key(name).begin_array();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i % row == 0) json.begin_array();
      json.value(numbers[i]);
      if (i % row == row - 1) json.end_array();
    }
    json.end_array();
  };
  json.begin_object();
  if (what.network->numbered) {
    json.key("inputs").begin_array();
    for (const State s : vectors.states) json.value(s);
    json.end_array();
  } else {
    rows("inputs", vectors.observations);
  }
  rows("q", vectors.q);
  json.end_object();
  return json.take();
}

}  // namespace

std::string network_onnx(const NetworkExport& what) {
  auto facts = network_facts(what);
  facts.emplace_back("self_test", self_test(what));
  return NetworkGraph(what).graph().model(what.name, facts);
}

}  // namespace quoll
