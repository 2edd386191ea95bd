#include "quoll/nn/pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/nn/naive_network.hpp"
#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

LayerSpec dense(std::uint32_t units, Activation activation,
                Normalisation normalisation = Normalisation::none) {
  return {.units = units, .activation = activation, .normalisation = normalisation};
}

LayerSpec convolution(std::uint32_t filters, std::uint32_t kernel, std::uint32_t stride,
                      Activation activation, Normalisation normalisation = Normalisation::none) {
  return {filters, kernel, stride, activation, normalisation};
}

LayerSpec without_gain(LayerSpec layer) {
  layer.gain = false;
  return layer;
}

struct Example {
  std::string name;
  NetworkSpec spec;
};

std::vector<Example> examples() {
  using A = Activation;
  using N = Normalisation;
  const LayerSpec out = dense(3, A::none);
  return {
      {"linear", {{1, 1, 5}, {}, {{out}}}},
      {"one of many", {{1, 1, 50}, {dense(20, A::relu)}, {{out}}}},
      {"planes", {{4, 3, 3}, {dense(7, A::relu, N::sample)}, {{out}}}},
      {"one input, one output", {{1, 1, 1}, {}, {{dense(1, A::none)}}}},
      {"no body, two heads", {{1, 1, 4}, {}, {{dense(5, A::tanh), out}, {dense(2, A::elu)}}}},
      {"relu", {{1, 1, 4}, {dense(20, A::relu), dense(7, A::relu)}, {{out}}}},
      {"elu", {{1, 1, 4}, {dense(9, A::elu), dense(17, A::elu)}, {{out}}}},
      {"tanh", {{1, 1, 4}, {dense(16, A::tanh), dense(3, A::tanh)}, {{out}}}},
      {"duelling",
       {{1, 1, 6},
        {dense(10, A::relu)},
        {{dense(8, A::relu), dense(1, A::none)}, {dense(8, A::relu), out}}}},
      {"three heads", {{1, 1, 6}, {dense(18, A::tanh)}, {{out}, {dense(17, A::none)}, {out}}}},
      {"normalised",
       {{1, 1, 4}, {dense(20, A::relu, N::sample), dense(16, A::tanh, N::channels)}, {{out}}}},
      {"leaky, no gains",
       {{4, 4, 2},
        {without_gain(convolution(16, 3, 1, A::leaky_relu, N::sample)),
         without_gain(dense(9, A::leaky_relu, N::sample))},
        {{out}}}},
      {"convolution", {{5, 4, 3}, {convolution(16, 3, 1, A::relu), dense(8, A::relu)}, {{out}}}},
      {"filters no multiple of 16",
       {{5, 6, 2},
        {convolution(5, 3, 1, A::tanh), convolution(6, 2, 1, A::elu), dense(5, A::relu)},
        {{out}, {dense(4, A::none)}}}},
      {"strides",
       {{7, 8, 2}, {convolution(4, 3, 2, A::relu), convolution(18, 2, 2, A::tanh)}, {{out}}}},
      {"gaps",
       {{7, 5, 1}, {convolution(3, 1, 2, A::tanh), convolution(3, 2, 3, A::tanh)}, {{out}}}},
      {"channels normalised",
       {{4, 5, 2},
        {convolution(5, 2, 1, A::relu, N::channels), convolution(17, 2, 1, A::relu, N::channels)},
        {{out}}}},
      {"samples normalised", {{4, 4, 2}, {convolution(16, 3, 1, A::relu, N::sample)}, {{out}}}},
      {"convolution of a vector",
       {{1, 1, 5}, {dense(7, A::tanh), convolution(4, 1, 1, A::tanh)}, {{out}}}},
      {"convolution as a head", {{3, 3, 2}, {}, {{convolution(3, 2, 1, A::tanh), out}}}},
  };
}

constexpr std::size_t dense_rows = 1000;

// A network with numbers, inputs and the weights of a loss that is linear in all outputs.
struct Work {
  Network network;
  std::vector<float> parameters, inputs;
  std::size_t samples, row;

  /// Of the inputs of the rows from `sparse_from` on about one in eight is not 0.
  Work(const NetworkSpec& spec, std::size_t count, std::size_t sparse_from = dense_rows)
      : network(*Network::make(spec)),
        parameters(network.parameters()),
        inputs(random_floats(count * (spec.input.size() + 3), 17)),
        samples(count),
        row(spec.input.size() + 3) {
    Rng rng{5};
    for (std::size_t i = sparse_from * row; i < inputs.size(); ++i) {
      if (rng.below(8) > 0) inputs[i] = 0.0f;
    }
    network.initialise(Initial::uniform, rng, parameters);
    // Gains and shifts that are not 1 and 0.
    for (const Layer& layer : network.layers()) {
      if (!layer.normalised() || !layer.spec.gain) continue;
      for (std::size_t i = 0; i < layer.normalised_row(); ++i) {
        if (parameters[layer.gain + i] == 0.0f) continue;
        parameters[layer.gain + i] = static_cast<float>(0.5 + rng.uniform());
        parameters[layer.shift + i] = static_cast<float>(rng.uniform() - 0.5);
      }
    }
  }

  static double by_output(std::size_t head, std::size_t sample, std::size_t j) {
    return std::sin(static_cast<double>(1 + head * 7 + sample * 13 + j * 3));
  }

  NaiveNetwork::Row input(std::size_t sample) const {
    const auto begin = inputs.begin() + static_cast<std::ptrdiff_t>(sample * row);
    return {begin, begin + static_cast<std::ptrdiff_t>(network.inputs())};
  }

  double naive_loss(const NaiveNetwork::Row& at) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
      const auto heads = NaiveNetwork(network).outputs(at, input(i));
      for (std::size_t h = 0; h < heads.size(); ++h) {
        for (std::size_t j = 0; j < heads[h].size(); ++j) sum += by_output(h, i, j) * heads[h][j];
      }
    }
    return sum;
  }

  std::vector<float> gradients(Pass& pass) const {
    pass.forward(parameters.data(), inputs.data(), row, samples);
    for (std::size_t h = 0; h < network.heads(); ++h) {
      for (std::size_t i = 0; i < samples; ++i) {
        for (std::size_t j = 0; j < network.outputs(h); ++j) {
          pass.gradient(h)[i * pass.output_row(h) + j] = static_cast<float>(by_output(h, i, j));
        }
      }
    }
    std::vector<float> found(network.parameters(), 99.0f);
    pass.backward(parameters.data(), found.data());
    return found;
  }

  void expect_outputs(const Pass& pass) const {
    const NaiveNetwork::Row exact(parameters.begin(), parameters.end());
    for (std::size_t i = 0; i < samples; ++i) {
      const auto heads = NaiveNetwork(network).outputs(exact, input(i));
      for (std::size_t h = 0; h < heads.size(); ++h) {
        const float* const found = pass.output(h) + i * pass.output_row(h);
        ASSERT_EQ(network.outputs(h), heads[h].size());
        for (std::size_t j = 0; j < heads[h].size(); ++j) EXPECT_NEAR(found[j], heads[h][j], 4e-6);
        for (std::size_t j = heads[h].size(); j < pass.output_row(h); ++j)
          EXPECT_EQ(found[j], 0.0f);
      }
    }
  }
};

// Which floats of the parameters are learned: those an initialisation may give a number.
std::vector<bool> learned(const Network& network) {
  std::vector<bool> is(network.parameters());
  const auto mark = [&](std::size_t begin, std::size_t rows, const Layer& layer, bool inputs) {
    for (std::size_t i = 0; i < rows; ++i) {
      if (inputs && !layer.used(i)) continue;
      for (std::size_t j = 0; j < layer.outputs; ++j) is[begin + i * layer.row + j] = true;
    }
  };
  for (const Layer& layer : network.layers()) {
    mark(layer.weights, layer.inputs, layer, true);
    mark(layer.bias, 1, layer, false);
    if (!layer.normalised() || !layer.spec.gain) continue;
    mark(layer.gain, layer.normalised_row() / layer.row, layer, false);
    mark(layer.shift, layer.normalised_row() / layer.row, layer, false);
  }
  return is;
}

TEST(Pass, OutputsAgreeWithDoublePrecision) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    for (const std::size_t sparse_from : {std::size_t{0}, dense_rows}) {
      const Work work(example.spec, 5, sparse_from);
      on_every_target([&] {
        Pass pass(work.network, 5, false);
        pass.forward(work.parameters.data(), work.inputs.data(), work.row, work.samples);
        work.expect_outputs(pass);
      });
    }
  }
}

void check_gradients(const Work& work) {
  const std::vector<bool> is_learned = learned(work.network);
  std::vector<double> expected(work.network.parameters());
  NaiveNetwork::Row at(work.parameters.begin(), work.parameters.end());
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!is_learned[i]) continue;
    const double here = at[i], h = 1e-6;
    at[i] = here + h;
    const double above = work.naive_loss(at);
    at[i] = here - h;
    expected[i] = (above - work.naive_loss(at)) / (2 * h);
    at[i] = here;
  }
  on_every_target([&] {
    Pass pass(work.network, work.samples, true);
    const std::vector<float> found = work.gradients(pass);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!is_learned[i]) {
        ASSERT_EQ(found[i], 0.0f) << i;
      } else {
        ASSERT_NEAR(found[i], expected[i], 1e-5 * (1.0 + std::fabs(expected[i]))) << i;
      }
    }
  });
}

TEST(Pass, GradientsAgreeWithFiniteDifferencesAndPaddingStaysZero) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    check_gradients(Work(example.spec, 3));
    check_gradients(Work(example.spec, 3, 0));
    const Network network = *Network::make(example.spec);
    const std::vector<bool> all = learned(network);
    EXPECT_EQ(static_cast<std::size_t>(std::count(all.begin(), all.end(), true)),
              network.free_parameters());
  }
}

TEST(Pass, FusedTargetsGiveTheSameBits) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    for (const std::size_t sparse_from : {std::size_t{0}, dense_rows}) {
      const Work work(example.spec, 21, sparse_from);
      same_bits_where_fused([&] {
        Pass pass(work.network, 21, true);
        return work.gradients(pass);
      });
    }
  }
}

TEST(Pass, ABatchLeavesNothingToASmallerOneOrToALargerOne) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    on_every_target([&] {
      const NetworkSpec& spec = example.spec;
      const Network network = *Network::make(spec);
      Pass used(network, 40, true);
      for (const std::size_t samples : {40, 1, 17, 16, 3, 40}) {
        const Work work(spec, samples);
        Pass fresh(work.network, samples, true);
        EXPECT_EQ(work.gradients(used), work.gradients(fresh)) << samples;
        work.expect_outputs(used);
      }
    });
  }
}

// Each row weighs 0 but the sparse ones, so that both ways add up the same terms.
TEST(Pass, MostlyZerosAreReadOneByOneWithTheSameBits) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    on_every_target([&] {
      Work work(example.spec, 300, 0);
      work.samples = 60;
      Pass pass(work.network, 300, true);
      const std::vector<float> alone = work.gradients(pass);
      // The rows after them are dense now, and have no gradient.
      const std::vector<float> full = random_floats(work.inputs.size(), 1);
      std::copy(full.begin() + static_cast<std::ptrdiff_t>(60 * work.row), full.end(),
                work.inputs.begin() + static_cast<std::ptrdiff_t>(60 * work.row));
      pass.forward(work.parameters.data(), work.inputs.data(), work.row, 300);
      for (std::size_t h = 0; h < work.network.heads(); ++h) {
        const std::size_t row = pass.output_row(h);
        std::fill_n(pass.gradient(h) + 60 * row, 240 * row, 0.0f);
        for (std::size_t i = 0; i < 60; ++i) {
          for (std::size_t j = 0; j < work.network.outputs(h); ++j) {
            pass.gradient(h)[i * row + j] = static_cast<float>(Work::by_output(h, i, j));
          }
        }
      }
      std::vector<float> among(work.network.parameters());
      pass.backward(work.parameters.data(), among.data());
      EXPECT_EQ(among, alone);
    });
  }
}

// What one row gives does not depend on the rows beside it.
TEST(Pass, ARowOfABatchHasTheBitsOfTheRowAlone) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    on_every_target([&] {
      // Enough dense rows that the whole batch is read densely, and sparse ones alone are not.
      const Work work(example.spec, 37, 30);
      Pass many(work.network, 37, false), one(work.network, 1, false);
      many.forward(work.parameters.data(), work.inputs.data(), work.row, 37);
      for (std::size_t i = 0; i < 37; ++i) {
        one.forward(work.parameters.data(), work.inputs.data() + i * work.row, work.row, 1);
        for (std::size_t h = 0; h < work.network.heads(); ++h) {
          const std::size_t row = one.output_row(h);
          const std::vector<float> alone(one.output(h), one.output(h) + row);
          const float* const among = many.output(h) + i * row;
          EXPECT_EQ(alone, std::vector<float>(among, among + row)) << i;
        }
      }
    });
  }
}

// Also the second time, when the ones of the first have to be gone.
TEST(Pass, ARowToldByItsOnesHasTheBitsOfTheRowWritten) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    on_every_target([&] {
      const Work work(example.spec, 3);
      Pass told(work.network, 1, false), written(work.network, 1, false);
      const auto inputs = static_cast<std::uint32_t>(work.network.inputs());
      for (const std::uint32_t step : {inputs, 5u, 1u, 3u}) {  // the third is dense
        std::vector<std::uint32_t> ones;
        std::vector<float> row(inputs, 0.0f);
        for (std::uint32_t at = inputs - 1; at < inputs; at -= step) ones.insert(ones.begin(), at);
        for (const std::uint32_t at : ones) row[at] = 1.0f;
        told.forward(work.parameters.data(), ones);
        written.forward(work.parameters.data(), row.data(), inputs, 1);
        for (std::size_t h = 0; h < work.network.heads(); ++h) {
          const std::size_t width = told.output_row(h);
          EXPECT_EQ(std::vector<float>(told.output(h), told.output(h) + width),
                    std::vector<float>(written.output(h), written.output(h) + width))
              << step;
        }
      }
    });
  }
}

TEST(Pass, NoSampleHasNoGradient) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    Work work(example.spec, 4);
    Pass pass(work.network, 4, true);
    work.gradients(pass);
    work.samples = 0;
    EXPECT_EQ(work.gradients(pass), std::vector<float>(work.network.parameters(), 0.0f));
  }
}

TEST(Pass, WhatIsNoNumberReachesTheOutputs) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    Work work(example.spec, 2);
    work.parameters[work.network.layers()[0].weights] = std::nanf("");
    on_every_target([&] {
      Pass pass(work.network, 2, false);
      pass.forward(work.parameters.data(), work.inputs.data(), work.row, 2);
      for (std::size_t i = 0; i < 2; ++i) {
        bool any = false;
        for (std::size_t h = 0; h < work.network.heads(); ++h) {
          for (std::size_t j = 0; j < work.network.outputs(h); ++j) {
            any = any || std::isnan(pass.output(h)[i * pass.output_row(h) + j]);
          }
        }
        EXPECT_TRUE(any);
      }
    });
  }
}

TEST(Floats, BeginWhereACacheLineDoes) {
  for (const std::size_t n : {1, 17, 1000}) {
    const Floats floats(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(floats.data()) % 64, 0u);
    for (const float one : floats.span()) EXPECT_EQ(one, 0.0f);
  }
  EXPECT_EQ(Floats(0).size(), 0u);
}

}  // namespace
}  // namespace quoll::nn
