#pragma once
// Reads safetensors files of networks and computes their Q of the self-test inputs as PyTorch's
// layers would, in double precision; shares nothing with the writer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "quoll/base/json_tree.hpp"

namespace quoll::testing {

class Safetensors {
 public:
  struct Array {
    std::vector<std::size_t> shape;
    std::vector<double> data;
  };

  explicit Safetensors(const std::string& file) {
    std::uint64_t length = 0;
    std::memcpy(&length, file.data(), 8);
    EXPECT_EQ(length % 8, 0u);
    const Tree head = *read_json(file.substr(8, length), "head");
    const std::string data = file.substr(8 + length);
    std::size_t end = 0;  // tensors stand in order, without gaps
    for (const auto& [name, about] : std::get<Tree::Object>(head.value)) {
      if (name == "__metadata__") {
        for (const auto& [key, text] : std::get<Tree::Object>(about.value)) {
          facts[key] = std::get<std::string>(text.value);
        }
        continue;
      }
      Array& to = arrays[name];
      std::size_t size = 1;
      for (const Tree& n : list(member(about, "shape"))) {
        to.shape.push_back(natural(n));
        size *= to.shape.back();
      }
      const std::string type = std::get<std::string>(member(about, "dtype").value);
      const std::size_t bytes = type == "I64" ? 8 : 4;
      EXPECT_EQ(natural(list(member(about, "data_offsets"))[0]), end) << name;
      for (std::size_t i = 0; i < size; ++i) {
        to.data.push_back(type == "I64" ? static_cast<double>(read<std::int64_t>(data, end + i * 8))
                                        : double{read<float>(data, end + i * 4)});
      }
      end += size * bytes;
      EXPECT_EQ(natural(list(member(about, "data_offsets"))[1]), end) << name;
    }
    EXPECT_EQ(end, data.size());
    layers_ = *read_json(facts["layers"], "layers");
  }

  /// Q of each row of self_test.inputs.
  std::vector<double> compute() {
    const Array& inputs = arrays.at("self_test.inputs");
    const std::size_t actions = arrays.at("self_test.q").shape[1], rows = inputs.shape[0];
    const bool joint = facts["layout"] == "joint";
    std::vector<double> q;
    for (std::size_t i = 0; i < rows; ++i) {
      const Array x = input(inputs, i, joint ? actions : 0);
      Array outputs = joint ? Array() : network(x);
      for (std::size_t a = 0; joint && a < actions; ++a) {
        Array pair = x;
        for (std::size_t b = 0; b < actions; ++b) pair.data.push_back(a == b ? 1.0 : 0.0);
        const Array one = network(pair);
        outputs.data.insert(outputs.data.end(), one.data.begin(), one.data.end());
      }
      for (const double value : values(outputs.data, actions)) q.push_back(value);
    }
    return q;
  }

  std::map<std::string, Array> arrays;
  std::map<std::string, std::string> facts;

 private:
  static const std::vector<Tree>& list(const Tree& tree) {
    return std::get<Tree::List>(tree.value);
  }
  static const Tree& member(const Tree& tree, const std::string& name) {
    for (const auto& [key, value] : std::get<Tree::Object>(tree.value)) {
      if (key == name) return value;
    }
    ADD_FAILURE() << "no " << name;
    return tree;
  }
  static std::size_t natural(const Tree& tree) {
    return static_cast<std::size_t>(std::get<std::int64_t>(tree.value));
  }
  template <class T>
  static T read(const std::string& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }

  // A row of numbers as they are shown; for convolutions planes, channels first.
  Array input(const Array& inputs, std::size_t row, std::size_t actions) {
    const Array& first =
        arrays.at(arrays.contains("body.0.weight") ? "body.0.weight" : "head.0.0.weight");
    if (inputs.shape.size() == 1) {
      Array out{{}, std::vector<double>(first.shape[1] - actions, 0.0)};
      out.data[static_cast<std::size_t>(inputs.data[row])] = 1.0;
      return out;
    }
    const std::size_t size = inputs.data.size() / inputs.shape[0];
    Array x{{inputs.shape.begin() + 1, inputs.shape.end()},
            {inputs.data.begin() + static_cast<std::ptrdiff_t>(row * size),
             inputs.data.begin() + static_cast<std::ptrdiff_t>((row + 1) * size)}};
    for (std::size_t i = 0; arrays.contains("input.scale") && i < size; ++i) {
      x.data[i] =
          (x.data[i] - arrays.at("input.middle").data[i]) * arrays.at("input.scale").data[i];
    }
    if (first.shape.size() < 4) return x;
    const std::size_t channels = x.shape[2], places = x.shape[0] * x.shape[1];
    Array planes{{channels, x.shape[0], x.shape[1]}, std::vector<double>(size)};
    for (std::size_t i = 0; i < size; ++i) {
      planes.data[i % channels * places + i / channels] = x.data[i];
    }
    return planes;
  }

  // What the heads give, one after the other.
  Array network(const Array& x) {
    Array features = x, out;
    std::map<std::string, Array> heads;
    for (const auto& [name, about] : std::get<Tree::Object>(layers_.value)) {
      if (name.starts_with("body")) {
        features = layer(name, about, features);
        continue;
      }
      const std::string head = name.substr(0, name.rfind('.'));
      heads[head] = layer(name, about, name.ends_with(".0") ? features : heads[head]);
    }
    for (std::size_t h = 0; h < heads.size(); ++h) {
      const Array& head = heads.at("head." + std::to_string(h));
      out.data.insert(out.data.end(), head.data.begin(), head.data.end());
    }
    return out;
  }

  Array layer(const std::string& name, const Tree& about, const Array& x) {
    const Array &w = arrays.at(name + ".weight"), &b = arrays.at(name + ".bias");
    Array y = w.shape.size() == 4 ? convolution(w, b, natural(member(about, "stride")), x)
                                  : dense(w, b, x);
    const std::string normalisation = std::get<std::string>(member(about, "normalisation").value);
    if (normalisation != "none") normalise(name, normalisation == "channels", y);
    const std::string activation = std::get<std::string>(member(about, "activation").value);
    for (double& v : y.data) {
      if (activation == "relu") v = std::max(v, 0.0);
      if (activation == "elu") v = v > 0 ? v : std::expm1(v);
      if (activation == "tanh") v = std::tanh(v);
      if (activation == "leaky-relu") v = v < 0 ? v / 100 : v;
    }
    return y;
  }

  static Array dense(const Array& w, const Array& b, const Array& x) {
    EXPECT_EQ(w.shape[1], x.data.size());
    Array y{{w.shape[0]}, b.data};
    for (std::size_t o = 0; o < w.shape[0]; ++o) {
      for (std::size_t i = 0; i < w.shape[1]; ++i) {
        y.data[o] += w.data[o * w.shape[1] + i] * x.data[i];
      }
    }
    return y;
  }

  static Array convolution(const Array& w, const Array& b, std::size_t stride, const Array& x) {
    const std::size_t in = x.shape[0], kernel = w.shape[2];
    EXPECT_EQ(w.shape[1], in);
    Array y{{w.shape[0], (x.shape[1] - kernel) / stride + 1, (x.shape[2] - kernel) / stride + 1},
            {}};
    for (std::size_t o = 0; o < y.shape[0]; ++o) {
      for (std::size_t r = 0; r < y.shape[1]; ++r) {
        for (std::size_t c = 0; c < y.shape[2]; ++c) {
          double sum = b.data[o];
          for (std::size_t l = 0; l < in * kernel * kernel; ++l) {
            const std::size_t i = l / (kernel * kernel), dy = l / kernel % kernel, dx = l % kernel;
            sum += w.data[o * in * kernel * kernel + l] *
                   x.data[(i * x.shape[1] + r * stride + dy) * x.shape[2] + c * stride + dx];
          }
          y.data.push_back(sum);
        }
      }
    }
    return y;
  }

  void normalise(const std::string& name, bool channels, Array& y) {
    const Array &gain = arrays.at(name + ".norm.weight"), &shift = arrays.at(name + ".norm.bias");
    const std::size_t places = channels ? y.data.size() / y.shape[0] : 1;
    const std::size_t together = y.data.size() / places;
    for (std::size_t at = 0; at < places; ++at) {
      double mean = 0.0, variance = 0.0;
      for (std::size_t i = 0; i < together; ++i) mean += y.data[i * places + at];
      mean /= static_cast<double>(together);
      for (std::size_t i = 0; i < together; ++i) {
        variance += (y.data[i * places + at] - mean) * (y.data[i * places + at] - mean);
      }
      const double root = std::sqrt(variance / static_cast<double>(together) +
                                    std::stod(facts["normalisation_epsilon"]));
      for (std::size_t i = 0; i < together; ++i) {
        double& v = y.data[i * places + at];
        v = (v - mean) / root * gain.data[i] + shift.data[i];
      }
    }
  }

  // Q of each action.
  std::vector<double> values(std::vector<double> out, std::size_t actions) {
    if (facts["duelling"] == "true") {
      const std::size_t atoms = out.size() / (actions + 1);
      for (std::size_t k = 0; k < atoms; ++k) {
        double mean = 0.0;
        for (std::size_t a = 1; a <= actions; ++a) mean += out[a * atoms + k];
        mean /= static_cast<double>(actions);
        for (std::size_t a = 1; a <= actions; ++a) out[a * atoms + k] += out[k] - mean;
      }
      out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(atoms));
    }
    const std::size_t atoms = out.size() / actions;
    std::vector<double> q;
    for (std::size_t a = 0; a < actions; ++a) {
      double all = 0.0, sum = 0.0;
      for (std::size_t k = 0; k < atoms; ++k) {
        const double x = out[a * atoms + k];
        const bool categorical = facts["returns"] == "categorical";
        all += categorical ? std::exp(x) : 1.0;
        sum += categorical ? std::exp(x) * arrays.at("support").data[k] : x;
      }
      q.push_back(sum / all / std::stod(facts["value_scale"]));
    }
    return q;
  }

  Tree layers_;
};

}  // namespace quoll::testing
