// A learned network as a C header: its numbers as arrays, one local array for what each layer
// gives, and sums in the order of Quoll's own.

#include <fmt/format.h>

#include <algorithm>

#include "quoll/base/text.hpp"
#include "quoll/report/c_text.hpp"
#include "quoll/report/network_export.hpp"

namespace quoll {
namespace {

std::string c_float(float x) {
  const std::string text = shortest(x);
  return text + (text.find_first_of(".e") == std::string::npos ? ".0f" : "f");
}

class NetworkHeader {
 public:
  explicit NetworkHeader(const NetworkExport& what)
      : what_(what),
        network_(*what.network),
        name_(c_identifier(what.name)),
        joint_(network_.layout == NetworkLayout::joint) {
    each_layer(network_.network, [&](const std::string&, const nn::PlainLayer& layer, bool) {
      const auto kind = static_cast<std::size_t>(layer.spec.activation);
      activations_[kind] = true;
      normalised_ = normalised_ || !layer.gain.empty();
      convolved_ = convolved_ || layer.spec.convolution();
    });
    mathematics_ = normalised_ || activations_[2] || activations_[3] || !network_.support.empty();
  }

  std::string text() {
    head();
    numbers();
    helpers();
    layers();
    q();
    act();
    self_test();
    out_ += "#endif\n";
    return std::move(out_);
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> text, Parts&&... parts) {
    fmt::format_to(std::back_inserter(out_), text, std::forward<Parts>(parts)...);
  }

  std::string observation() const {
    const nn::Extent& in = network_.observed;
    std::string text;
    if (in.places() > 1) {
      return fmt::format("{} x {} x {} numbers, row by row, channels together", in.height, in.width,
                         in.channels);
    }
    for (const std::string& number : what_.numbers) text += (text.empty() ? ": " : ", ") + number;
    return fmt::format("{} numbers{}", in.size(), text);
  }

  void head() {
    add("/* Q of a network for the world {}, for C99 and C++; needs {}.\n", c_comment(what_.world),
        mathematics_ ? "<math.h>" : "nothing");
    for (const std::string& line : what_.origin) add(" * {}\n", c_comment(line));
    add(" *   {0}_q(observation, q);  writes {0}_actions values\n"
        " *   int a = {0}_act(observation);  the number of the action with the largest one\n"
        " * An observation is {1}.\n"
        " * Self-test: cc -DQUOLL_SELF_TEST -x c THIS_FILE{2} && ./a.out\n */\n",
        name_, c_comment(observation()), mathematics_ ? " -lm" : "");
    add("#ifndef QUOLL_{0}_NETWORK_H\n#define QUOLL_{0}_NETWORK_H\n\n", c_upper(name_));
    if (mathematics_) add("#include <math.h>\n\n");
    add("enum {{ {0}_inputs = {1}, {0}_actions = {2} }};\n\n", name_, network_.observed.size(),
        network_.actions);
    add("static const char *const {}_action_names[{}] = {{\n", name_, network_.actions);
    for (const std::string& action : what_.actions) add("  {},\n", c_string(action));
    add("}};\n\n");
  }

  void array(std::string_view what, std::span<const float> numbers) {
    add("static const float {}_{}[{}] = {{", name_, what, numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      out_ += i % 8 == 0 ? "\n  " : " ";
      out_ += c_float(numbers[i]) + ",";
    }
    add("\n}};\n\n");
  }

  void numbers() {
    if (!network_.scale.empty()) {
      array("middle", network_.middle);
      array("scale", network_.scale);
    }
    add("/* Of each layer: a row of weights for each number that it reads. */\n");
    each_layer(network_.network, [&](const std::string& name, const nn::PlainLayer& layer, bool) {
      const std::string called = under(name);
      array(called + "_weight", layer.weights);
      array(called + "_bias", layer.bias);
      if (layer.gain.empty()) return;
      array(called + "_gain", layer.gain);
      array(called + "_shift", layer.shift);
    });
    if (!network_.support.empty()) array("support", network_.support);
  }

  static std::string under(std::string name) {
    std::replace_if(name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
    return name;
  }
  static std::string name_of(nn::Activation kind) {
    return under(std::string(nn::activation_names[static_cast<std::size_t>(kind)]));
  }

  void helpers() {
    add("/* y += x W. */\n"
        "static inline void {0}_multiply(const float *x, int inputs, const float *w, int outputs,\n"
        "                                float *y) {{\n"
        "  int i, j;\n"
        "  for (i = 0; i < inputs; ++i) {{\n"
        "    const float *row = w + (long)i * outputs;\n"
        "    if (x[i] == 0.0f) continue;\n"
        "    for (j = 0; j < outputs; ++j) y[j] += x[i] * row[j];\n"
        "  }}\n"
        "}}\n\n"
        "static inline void {0}_copy(const float *x, int n, float *y) {{\n"
        "  int i;\n"
        "  for (i = 0; i < n; ++i) y[i] = x[i];\n"
        "}}\n\n",
        name_);
    if (convolved_) convolution();
    if (normalised_) normalisation();
    activation(nn::Activation::relu, "x[i] < 0.0f ? 0.0f : x[i]");
    activation(nn::Activation::elu, "x[i] > 0.0f ? x[i] : expm1f(x[i])");
    activation(nn::Activation::tanh, "tanhf(x[i])");
    activation(nn::Activation::leaky_relu, "x[i] < 0.0f ? 0.01f * x[i] : x[i]");
    if (network_.returns != Returns::mean) mean();
  }

  void convolution() {
    add("/* y of each place = b + what a kernel x kernel window there reads, times W. */\n"
        "static inline void {0}_convolve(const float *x, int width, int channels, const float *w,\n"
        "                                const float *b, int kernel, int stride, int out_height,\n"
        "                                int out_width, int outputs, float *y) {{\n"
        "  int row, column, k;\n"
        "  for (row = 0; row < out_height; ++row) {{\n"
        "    for (column = 0; column < out_width; ++column, y += outputs) {{\n"
        "      const float *at = x + (row * width + column) * stride * channels;\n"
        "      {0}_copy(b, outputs, y);\n"
        "      for (k = 0; k < kernel; ++k) {{\n"
        "        {0}_multiply(at + k * width * channels, kernel * channels,\n"
        "                     w + k * kernel * channels * outputs, outputs, y);\n"
        "      }}\n"
        "    }}\n"
        "  }}\n"
        "}}\n\n",
        name_);
  }

  void normalisation() {
    add("/* Each of `rows` rows of n numbers: mean 0, variance 1, then times gain plus shift. */\n"
        "static inline void {0}_normalise(float *x, int rows, int n, const float *gain,\n"
        "                                 const float *shift) {{\n"
        "  int i;\n"
        "  for (; rows > 0; --rows, x += n) {{\n"
        "    float mean = 0.0f, variance = 0.0f, root;\n"
        "    for (i = 0; i < n; ++i) mean += x[i];\n"
        "    mean /= (float)n;\n"
        "    for (i = 0; i < n; ++i) variance += (x[i] - mean) * (x[i] - mean);\n"
        "    root = sqrtf(variance / (float)n + {1});\n"
        "    for (i = 0; i < n; ++i) x[i] = (x[i] - mean) / root * gain[i] + shift[i];\n"
        "  }}\n"
        "}}\n\n",
        name_, c_float(nn::normalisation_epsilon));
  }

  void activation(nn::Activation kind, std::string_view formula) {
    const auto index = static_cast<std::size_t>(kind);
    if (!activations_[index]) return;
    add("static inline void {}_{}(float *x, int n) {{\n"
        "  int i;\n"
        "  for (i = 0; i < n; ++i) x[i] = {};\n"
        "}}\n\n",
        name_, name_of(kind), formula);
  }

  void mean() {
    if (network_.returns == Returns::quantile) {
      add("/* The mean of the quantiles. */\n"
          "static inline float {0}_mean(const float *x) {{\n"
          "  float sum = 0.0f;\n"
          "  int i;\n"
          "  for (i = 0; i < {1}; ++i) sum += x[i];\n"
          "  return sum / {1}.0f;\n"
          "}}\n\n",
          name_, network_.atoms);
      return;
    }
    add("/* The mean of the support with probabilities in proportion to exp(x). */\n"
        "static inline float {0}_mean(const float *x) {{\n"
        "  float largest = x[0], all = 0.0f, sum = 0.0f;\n"
        "  int i;\n"
        "  for (i = 1; i < {1}; ++i) largest = x[i] > largest ? x[i] : largest;\n"
        "  for (i = 0; i < {1}; ++i) {{\n"
        "    const float p = expf(x[i] - largest);\n"
        "    all += p;\n"
        "    sum += p * {0}_support[i];\n"
        "  }}\n"
        "  return sum / all;\n"
        "}}\n\n",
        name_, network_.atoms);
  }

  // The layers of a chain in order; `use` = what is said of each: its name, the array that it reads
  // and the array that it writes. The last layer of a head writes to its place in `out`.
  template <class Use>
  void each_step(const Use& use) const {
    const nn::PlainNetwork& network = network_.network;
    std::string features = "input";
    for (std::size_t i = 0; i < network.body.size(); ++i) {
      const std::string called = "body_" + std::to_string(i);
      use(called, network.body[i], features, called);
      features = called;
    }
    std::size_t at = 0;
    for (std::size_t h = 0; h < network.heads.size(); ++h) {
      const std::vector<nn::PlainLayer>& head = network.heads[h];
      std::string reads = features;
      for (std::size_t i = 0; i < head.size(); ++i) {
        const std::string called = fmt::format("head_{}_{}", h, i);
        const bool last = i + 1 == head.size();
        use(called, head[i], reads, last ? fmt::format("out + {}", at) : called);
        reads = called;
      }
      at += head.back().out.size();
    }
  }

  void layers() {
    add("/* What the last layers give, one after the other. */\n"
        "static inline void {}_network(const float *input, float *out) {{\n",
        name_);
    each_step([&](const std::string& called, const nn::PlainLayer& layer, const std::string&,
                  const std::string& writes) {
      if (called == writes) add("  float {}[{}];\n", called, layer.out.size());
    });
    each_step([&](const std::string& called, const nn::PlainLayer& layer, const std::string& reads,
                  const std::string& writes) { step(called, layer, reads, writes); });
    add("}}\n\n");
  }

  void step(const std::string& called, const nn::PlainLayer& layer, const std::string& reads,
            const std::string& writes) {
    const nn::Extent &in = layer.in, &out = layer.out;
    const std::string own = name_ + "_" + called;
    if (layer.spec.convolution()) {
      add("  {0}_convolve({1}, {2}, {3}, {4}_weight, {4}_bias, {5}, {6}, {7}, {8}, {9}, {10});\n",
          name_, reads, in.width, in.channels, own, layer.spec.kernel, layer.spec.stride,
          out.height, out.width, out.channels, writes);
    } else {
      add("  {0}_copy({1}_bias, {2}, {3});\n"
          "  {0}_multiply({4}, {5}, {1}_weight, {2}, {3});\n",
          name_, own, out.size(), writes, reads, in.size());
    }
    if (!layer.gain.empty()) {
      const std::size_t rows = out.size() / layer.gain.size();
      add("  {0}_normalise({1}, {2}, {3}, {4}_gain, {4}_shift);\n", name_, writes, rows,
          layer.gain.size(), own);
    }
    if (layer.spec.activation != nn::Activation::none) {
      add("  {}_{}({}, {});\n", name_, name_of(layer.spec.activation), writes, out.size());
    }
  }

  void q() {
    const bool scaled = !network_.scale.empty(), made = scaled || joint_;
    const std::size_t of_actions = std::size_t{network_.actions} * network_.atoms;
    add("/* Q of every action. */\n"
        "static inline void {}_q(const float *observation, float *q) {{\n",
        name_);
    if (made) add("  float input[{}];\n", network_.network.input.size());
    add("  float out[{}];\n  int {};\n", of_actions + (network_.duelling ? network_.atoms : 0),
        made || network_.duelling ? "i, a" : "a");
    if (made) {
      add("  for (i = 0; i < {0}_inputs; ++i) {{\n    input[i] = {1};\n  }}\n", name_,
          scaled ? fmt::format("(observation[i] - {0}_middle[i]) * {0}_scale[i]", name_)
                 : "observation[i]");
    }
    if (joint_) {
      add("  for (a = 0; a < {0}_actions; ++a) {{\n"
          "    for (i = 0; i < {0}_actions; ++i) input[{0}_inputs + i] = i == a ? 1.0f : 0.0f;\n"
          "    {0}_network(input, out + a * {1});\n"
          "  }}\n",
          name_, network_.atoms);
    } else {
      add("  {}_network({}, out);\n", name_, made ? "input" : "observation");
    }
    if (network_.duelling) duel();
    const std::string one =
        network_.returns == Returns::mean
            ? fmt::format("out[{}a]", network_.duelling ? "1 + " : "")
            : fmt::format("{}_mean(out + {}a * {})", name_,
                          network_.duelling ? std::to_string(network_.atoms) + " + " : "",
                          network_.atoms);
    const std::string by = network_.value_scale == 1.0
                               ? ""
                               : " / " + c_float(static_cast<float>(network_.value_scale));
    add("  for (a = 0; a < {}_actions; ++a) q[a] = {}{};\n}}\n\n", name_, one, by);
  }

  // The value stands first in `out`, then the advantages of each action.
  void duel() {
    add("  for (i = 0; i < {1}; ++i) {{\n"
        "    float mean = 0.0f;\n"
        "    for (a = 1; a <= {0}_actions; ++a) mean += out[a * {1} + i];\n"
        "    mean /= (float){0}_actions;\n"
        "    for (a = 1; a <= {0}_actions; ++a) out[a * {1} + i] += out[i] - mean;\n"
        "  }}\n",
        name_, network_.atoms);
  }

  void act() {
    add("/* The action with the largest Q, the first of several. */\n"
        "static inline int {0}_act(const float *observation) {{\n"
        "  float q[{0}_actions];\n"
        "  int a, best = 0;\n"
        "  {0}_q(observation, q);\n"
        "  for (a = 1; a < {0}_actions; ++a) {{\n"
        "    if (q[a] > q[best]) best = a;\n"
        "  }}\n"
        "  return best;\n"
        "}}\n\n"
        "/* The name of an action, or a null pointer. */\n"
        "static inline const char *{0}_action_name(int action) {{\n"
        "  return action < 0 || action >= {0}_actions ? (const char *)0 : {0}_action_names[action];"
        "\n}}\n\n",
        name_);
  }

  void self_test() {
    add("#ifdef QUOLL_SELF_TEST\n#include <stdio.h>\n\n");
    array("test_observations", what_.vectors.observations);
    array("test_q", what_.vectors.q);
    add("int main(void) {{\n"
        "  const int count = {1};\n"
        "  int i, a, failures = 0;\n"
        "  float largest = 0.0f;\n"
        "  for (i = 0; i < count; ++i) {{\n"
        "    const float *observation = {0}_test_observations + i * {0}_inputs;\n"
        "    const float *expected = {0}_test_q + i * {0}_actions;\n"
        "    const int best = {0}_act(observation);\n"
        "    float q[{0}_actions], size = 1.0f;\n"
        "    int right = {0}_action_name(best) != 0;\n"
        "    {0}_q(observation, q);\n"
        "    for (a = 0; a < {0}_actions; ++a) {{\n"
        "      const float all = expected[a] < 0.0f ? -expected[a] : expected[a];\n"
        "      size = all > size ? all : size;\n"
        "    }}\n"
        "    for (a = 0; a < {0}_actions; ++a) {{\n"
        "      const float off = q[a] < expected[a] ? expected[a] - q[a] : q[a] - expected[a];\n"
        "      right = right && off <= 1e-4f * size && q[best] >= q[a];\n"
        "      largest = off > largest ? off : largest;\n"
        "    }}\n"
        "    if (!right) printf(\"input %d: wrong\\n\", i);\n"
        "    failures += !right;\n"
        "  }}\n"
        "  printf(\"%d of %d inputs as expected, largest difference %.2g\\n\", count - failures, "
        "count,\n"
        "         (double)largest);\n"
        "  return failures != 0;\n"
        "}}\n#endif\n\n",
        name_, what_.vectors.count);
  }

  const NetworkExport& what_;
  const LearnedNetwork& network_;
  std::string name_;
  bool joint_;
  bool activations_[std::size(nn::activation_names)] = {};
  bool normalised_ = false, convolved_ = false, mathematics_ = false;
  std::string out_;
};

}  // namespace

std::string network_c(const NetworkExport& what) {
  return NetworkHeader(what).text();
}

}  // namespace quoll
