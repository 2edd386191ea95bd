#pragma once
// Reads ONNX models and computes them in double precision; shares nothing with the writer. Knows
// the operators that these models use, and fails at any other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quoll::testing {

/// A field of a message: a number, or bytes.
struct WireField {
  std::uint64_t number = 0;
  std::string bytes;
};

class Message {
 public:
  explicit Message(const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::uint64_t key = varint(bytes, at);
      WireField field;
      if ((key & 7) == 0) {
        field.number = varint(bytes, at);
      } else {
        const std::size_t size = (key & 7) == 5 ? 4 : (key & 7) == 1 ? 8 : varint(bytes, at);
        field.bytes = bytes.substr(at, size);
        EXPECT_EQ(field.bytes.size(), size);
        at += size;
      }
      fields_.emplace_back(key >> 3, std::move(field));
    }
  }

  std::vector<WireField> all(std::uint64_t number) const {
    std::vector<WireField> found;
    for (const auto& [key, field] : fields_) {
      if (key == number) found.push_back(field);
    }
    return found;
  }
  /// The last one; nothing if there is none.
  WireField one(std::uint64_t number) const {
    const std::vector<WireField> found = all(number);
    return found.empty() ? WireField() : found.back();
  }
  std::string text(std::uint64_t number) const { return one(number).bytes; }

 private:
  static std::uint64_t varint(const std::string& bytes, std::size_t& at) {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes.at(at++));
      value |= std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return value;
    }
  }
  std::vector<std::pair<std::uint64_t, WireField>> fields_;
};

struct Tensor {
  std::vector<std::int64_t> shape;
  std::vector<double> data;
};

class OnnxModel {
 public:
  explicit OnnxModel(const std::string& file) : model_(file), graph_(model_.text(7)) {
    for (const WireField& field : graph_.all(5)) {
      const Message tensor(field.bytes);
      Tensor& to = constants_[tensor.text(8)];
      for (const WireField& size : tensor.all(1)) {
        to.shape.push_back(static_cast<std::int64_t>(size.number));
      }
      const std::string raw = tensor.text(9);
      const bool real = tensor.one(2).number == 1;
      EXPECT_EQ(tensor.one(2).number, real ? 1u : 7u);
      for (std::size_t at = 0; at < raw.size(); at += real ? 4 : 8) {
        to.data.push_back(real ? double{read<float>(raw, at)}
                               : static_cast<double>(read<std::int64_t>(raw, at)));
      }
    }
  }

  std::uint64_t operators() const { return Message(model_.text(8)).one(2).number; }
  std::string fact(const std::string& key) const {
    for (const WireField& field : model_.all(14)) {
      const Message fact(field.bytes);
      if (fact.text(1) == key) return fact.text(2);
    }
    return "";
  }
  /// "name element shape" of an input (field 11) or output (12), such as "q 1 batch,2".
  std::string declared(std::uint64_t field, std::size_t index) const {
    const Message info(graph_.all(field).at(index).bytes);
    const Message tensor(Message(info.text(2)).text(1));
    std::string text = info.text(1) + " " + std::to_string(tensor.one(1).number) + " ";
    bool first = true;
    for (const WireField& dimension : Message(tensor.text(2)).all(1)) {
      const Message size(dimension.bytes);
      text += first ? "" : ",";
      text += size.all(2).empty() ? std::to_string(size.one(1).number) : size.text(2);
      first = false;
    }
    return text;
  }

  /// All values by name, given the input. Each node is asked for what stands before it.
  std::map<std::string, Tensor> compute(const std::string& name, const Tensor& input) const {
    std::map<std::string, Tensor> values = constants_;
    values[name] = input;
    for (const WireField& field : graph_.all(1)) {
      const Message node(field.bytes);
      std::vector<Tensor> reads;
      for (const WireField& read : node.all(1)) reads.push_back(values.at(read.bytes));
      const std::string makes = node.text(2);
      EXPECT_EQ(values.count(makes), 0u) << makes;
      values[makes] = apply(node, reads);
    }
    return values;
  }

 private:
  template <class T>
  static T read(const std::string& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }

  static std::vector<std::int64_t> attribute(const Message& node, const std::string& name) {
    std::vector<std::int64_t> numbers;
    for (const WireField& field : node.all(5)) {
      const Message attribute(field.bytes);
      if (attribute.text(1) != name) continue;
      const bool list = attribute.one(20).number == 7;
      for (const WireField& number : attribute.all(list ? 8 : 3)) {
        numbers.push_back(static_cast<std::int64_t>(number.number));
      }
    }
    return numbers;
  }

  static std::int64_t size(const std::vector<std::int64_t>& shape, std::size_t from = 0) {
    std::int64_t n = 1;
    for (std::size_t i = from; i < shape.size(); ++i) n *= shape[i];
    return n;
  }

  // The element of `x` where the index `at` of `shape` points to, shapes aligned at their ends.
  static double element(const Tensor& x, const std::vector<std::int64_t>& shape, std::int64_t at) {
    std::int64_t from = 0, step = 1;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const std::int64_t along = at % shape[shape.size() - 1 - i];
      at /= shape[shape.size() - 1 - i];
      if (i >= x.shape.size()) continue;
      const std::int64_t own = x.shape[x.shape.size() - 1 - i];
      if (own > 1) from += along * step;
      step *= own;
    }
    return x.data.at(static_cast<std::size_t>(from));
  }

  template <class Function>
  static Tensor each(const std::vector<Tensor>& reads, const Function& function) {
    Tensor out;
    for (const Tensor& read : reads) {
      if (read.shape.size() > out.shape.size()) {
        out.shape.insert(out.shape.begin(), read.shape.size() - out.shape.size(), 1);
      }
      const std::size_t skip = out.shape.size() - read.shape.size();
      for (std::size_t i = 0; i < read.shape.size(); ++i) {
        std::int64_t& to = out.shape[skip + i];
        EXPECT_TRUE(to == 1 || read.shape[i] == 1 || to == read.shape[i]);
        to = std::max(to, read.shape[i]);
      }
    }
    for (std::int64_t i = 0; i < size(out.shape); ++i) {
      std::vector<double> x;
      for (const Tensor& read : reads) x.push_back(element(read, out.shape, i));
      out.data.push_back(function(x));
    }
    return out;
  }

  // The last axis of `a` times the rows of `b`.
  static Tensor multiply(const Tensor& a, const Tensor& b) {
    const std::int64_t k = a.shape.back(), n = b.shape.at(1);
    EXPECT_EQ(k, b.shape[0]);
    Tensor out{a.shape, {}};
    out.shape.back() = n;
    for (std::int64_t i = 0; i < size(a.shape) / k; ++i) {
      for (std::int64_t j = 0; j < n; ++j) {
        double sum = 0.0;
        for (std::int64_t l = 0; l < k; ++l) {
          sum += a.data[static_cast<std::size_t>(i * k + l)] *
                 b.data[static_cast<std::size_t>(l * n + j)];
        }
        out.data.push_back(sum);
      }
    }
    return out;
  }

  static Tensor convolve(const Message& node, const std::vector<Tensor>& reads) {
    const Tensor &x = reads[0], &w = reads[1];
    const std::int64_t batch = x.shape[0], in = x.shape[1], height = x.shape[2], width = x.shape[3];
    const std::int64_t outputs = w.shape[0], kernel = w.shape[2];
    const std::int64_t stride = attribute(node, "strides").at(0);
    EXPECT_EQ(in, w.shape[1]);
    Tensor out{{batch, outputs, (height - kernel) / stride + 1, (width - kernel) / stride + 1}, {}};
    for (std::int64_t at = 0; at < size(out.shape); ++at) {
      const std::int64_t column = at % out.shape[3], row = at / out.shape[3] % out.shape[2];
      const std::int64_t o = at / (out.shape[2] * out.shape[3]) % outputs;
      const std::int64_t b = at / (out.shape[2] * out.shape[3] * outputs);
      double sum = reads[2].data[static_cast<std::size_t>(o)];
      for (std::int64_t l = 0; l < in * kernel * kernel; ++l) {
        const std::int64_t i = l / (kernel * kernel), y = l / kernel % kernel, z = l % kernel;
        sum += w.data[static_cast<std::size_t>(o * in * kernel * kernel + l)] *
               x.data[static_cast<std::size_t>(((b * in + i) * height + row * stride + y) * width +
                                               column * stride + z)];
      }
      out.data.push_back(sum);
    }
    return out;
  }

  static Tensor transpose(const Tensor& x, const std::vector<std::int64_t>& order) {
    Tensor out;
    for (const std::int64_t axis : order) {
      out.shape.push_back(x.shape[static_cast<std::size_t>(axis)]);
    }
    for (std::int64_t i = 0; i < size(out.shape); ++i) {
      std::vector<std::int64_t> index(x.shape.size());
      std::int64_t rest = i, from = 0;
      for (std::size_t a = order.size(); a-- > 0; rest /= out.shape[a]) {
        index[static_cast<std::size_t>(order[a])] = rest % out.shape[a];
      }
      for (std::size_t a = 0; a < index.size(); ++a) from = from * x.shape[a] + index[a];
      out.data.push_back(x.data[static_cast<std::size_t>(from)]);
    }
    return out;
  }

  static Tensor mean(const Message& node, const Tensor& x) {
    Tensor out{x.shape, {}};
    std::int64_t count = 1;
    for (const std::int64_t axis : attribute(node, "axes")) {
      std::int64_t& at =
          out.shape[static_cast<std::size_t>(axis < 0 ? axis + std::ssize(x.shape) : axis)];
      count *= at;
      at = 1;
    }
    out.data.resize(static_cast<std::size_t>(size(out.shape)));
    for (std::int64_t i = 0; i < size(x.shape); ++i) {
      std::int64_t rest = i, to = 0, step = 1;
      for (std::size_t a = x.shape.size(); a-- > 0; rest /= x.shape[a]) {
        if (out.shape[a] > 1) to += rest % x.shape[a] * step;
        step *= out.shape[a];
      }
      out.data[static_cast<std::size_t>(to)] +=
          x.data[static_cast<std::size_t>(i)] / static_cast<double>(count);
    }
    if (attribute(node, "keepdims").at(0) == 0) out.shape.pop_back();  // of the last axis only
    return out;
  }

  static Tensor gather(const Tensor& x, const Tensor& which) {
    Tensor out{which.shape, {}};
    out.shape.insert(out.shape.end(), x.shape.begin() + 1, x.shape.end());
    const std::int64_t row = size(x.shape, 1);
    for (const double at : which.data) {
      const auto begin = x.data.begin() + static_cast<std::int64_t>(at) * row;
      out.data.insert(out.data.end(), begin, begin + row);
    }
    return out;
  }

  // Rows of the last axis.
  static Tensor softmax(Tensor x) {
    const auto n = static_cast<std::size_t>(x.shape.back());
    for (std::size_t begin = 0; begin < x.data.size(); begin += n) {
      double sum = 0.0;
      for (std::size_t i = begin; i < begin + n; ++i) sum += std::exp(x.data[i]);
      for (std::size_t i = begin; i < begin + n; ++i) x.data[i] = std::exp(x.data[i]) / sum;
    }
    return x;
  }

  static Tensor best(const Tensor& x) {
    Tensor out{{x.shape[0]}, {}};
    for (auto row = x.data.begin(); row != x.data.end(); row += x.shape[1]) {
      out.data.push_back(static_cast<double>(std::max_element(row, row + x.shape[1]) - row));
    }
    return out;
  }

  static Tensor join(const std::vector<Tensor>& reads) {
    Tensor out{{reads[0].shape[0], 0}, {}};
    for (const Tensor& read : reads) out.shape[1] += read.shape[1];
    for (std::int64_t i = 0; i < out.shape[0]; ++i) {
      for (const Tensor& read : reads) {
        const auto begin = read.data.begin() + i * read.shape[1];
        out.data.insert(out.data.end(), begin, begin + read.shape[1]);
      }
    }
    return out;
  }

  static Tensor shaped(Tensor x, std::vector<std::int64_t> shape) {
    const std::int64_t known = -size(shape);
    for (std::int64_t& n : shape) n = n == -1 ? size(x.shape) / known : n;
    x.shape = shape;
    EXPECT_EQ(size(shape), std::ssize(x.data));
    return x;
  }

  static Tensor apply(const Message& node, const std::vector<Tensor>& reads) {
    using Row = std::vector<double>;
    const std::string what = node.text(4);
    const Tensor& x = reads[0];
    if (what == "Add") return each(reads, [](const Row& v) { return v[0] + v[1]; });
    if (what == "Sub") return each(reads, [](const Row& v) { return v[0] - v[1]; });
    if (what == "Mul") return each(reads, [](const Row& v) { return v[0] * v[1]; });
    if (what == "Div") return each(reads, [](const Row& v) { return v[0] / v[1]; });
    if (what == "Less") return each(reads, [](const Row& v) { return v[0] < v[1] ? 1.0 : 0.0; });
    if (what == "Where") return each(reads, [](const Row& v) { return v[0] != 0 ? v[1] : v[2]; });
    if (what == "Sqrt") return each(reads, [](const Row& v) { return std::sqrt(v[0]); });
    if (what == "Relu") return each(reads, [](const Row& v) { return std::max(v[0], 0.0); });
    if (what == "LeakyRelu") {
      EXPECT_TRUE(attribute(node, "alpha").empty());  // of itself 0.01
      return each(reads, [](const Row& v) { return v[0] < 0 ? v[0] * 0.01 : v[0]; });
    }
    if (what == "Tanh") return each(reads, [](const Row& v) { return std::tanh(v[0]); });
    if (what == "Elu") {
      return each(reads, [](const Row& v) { return v[0] > 0 ? v[0] : std::expm1(v[0]); });
    }
    if (what == "MatMul") return multiply(x, reads[1]);
    if (what == "Conv") return convolve(node, reads);
    if (what == "Transpose") return transpose(x, attribute(node, "perm"));
    if (what == "ReduceMean") return mean(node, x);
    if (what == "Gather") return gather(x, reads[1]);
    if (what == "Softmax") return softmax(x);
    if (what == "ArgMax") return best(x);
    if (what == "Concat") return join(reads);
    if (what == "Flatten") return shaped(x, {x.shape[0], size(x.shape, 1)});
    if (what == "Unsqueeze") {
      std::vector<std::int64_t> shape = x.shape;
      shape.insert(shape.begin() + static_cast<std::int64_t>(reads[1].data[0]), 1);
      return shaped(x, shape);
    }
    if (what == "Reshape") return shaped(x, {reads[1].data.begin(), reads[1].data.end()});
    ADD_FAILURE() << "operator " << what;
    return x;
  }

  Message model_, graph_;
  std::map<std::string, Tensor> constants_;
};

}  // namespace quoll::testing
