#include "quoll/nn/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace quoll::nn {
namespace {

LayerSpec dense(std::uint32_t units) {
  return {.units = units};
}

LayerSpec convolution(std::uint32_t filters, std::uint32_t kernel, std::uint32_t stride = 1) {
  return {.units = filters, .kernel = kernel, .stride = stride};
}

std::string refusal(const NetworkSpec& spec) {
  const Result<Network> made = Network::make(spec);
  return made ? "made" : message(made.error());
}

TEST(Network, RefusesWhatCannotStand) {
  const std::vector<std::vector<LayerSpec>> head{{dense(2)}};
  EXPECT_NE(refusal({{1, 1, 0}, {}, head}).find("nothing to read"), std::string::npos);
  EXPECT_NE(refusal({{1, 1, 4}, {}, {}}).find("needs a head"), std::string::npos);
  EXPECT_NE(refusal({{1, 1, 4}, {}, {{}}}).find("a head needs a layer"), std::string::npos);
  EXPECT_NE(refusal({{1, 1, 4}, {dense(0)}, head}).find("at least one output"), std::string::npos);
  EXPECT_NE(refusal({{4, 3, 1}, {convolution(2, 4)}, head}).find("4x4 does not fit into 4x3"),
            std::string::npos);
  EXPECT_NE(refusal({{4, 4, 1}, {convolution(2, 2, 0)}, head}).find("stride"), std::string::npos);
  EXPECT_NE(refusal({{4, 4, 1}, {dense(2)}, {{convolution(2, 1)}}}).find("stand in the body"),
            std::string::npos);
  NetworkSpec whole{{4, 4, 1}, {convolution(5, 2)}, head};
  whole.body[0].normalisation = Normalisation::sample;
  EXPECT_NE(refusal(whole).find("a multiple of 16 filters"), std::string::npos);
}

TEST(Network, CountsWhatIsLearned) {
  // 4-120-84-2, the network of a well-known DQN.
  const Network mlp = *Network::make({{1, 1, 4}, {dense(120), dense(84)}, {{dense(2)}}});
  EXPECT_EQ(mlp.free_parameters(), 4u * 120 + 120 + 120 * 84 + 84 + 84 * 2 + 2);
  EXPECT_EQ(mlp.parameters(), 5u * 128 + 121 * 96 + 85 * 16);
  EXPECT_EQ(mlp.inputs(), 4u);
  EXPECT_EQ(mlp.outputs(0), 2u);
  EXPECT_EQ(mlp.features().size(), 84u);

  // 16 filters of 3 x 3 on 10 x 10 x 4, 128 units, 6 outputs: the network of MinAtar.
  const Network minatar =
      *Network::make({{10, 10, 4}, {convolution(16, 3), dense(128)}, {{dense(6)}}});
  EXPECT_EQ(minatar.free_parameters(), 36u * 16 + 16 + 1024 * 128 + 128 + 128 * 6 + 6);
  EXPECT_EQ(minatar.body()[0].out.height, 8u);
  EXPECT_EQ(minatar.body()[0].places, 64u);

  const Network strided = *Network::make({{9, 6, 3}, {convolution(5, 3, 2)}, {{dense(1)}}});
  EXPECT_EQ(strided.body()[0].out.height, 4u);
  EXPECT_EQ(strided.body()[0].out.width, 2u);
  EXPECT_EQ(strided.free_parameters(), 27u * 5 + 5 + 8 * 5 + 1);
}

TEST(Network, HeadsReadTheBody) {
  const Network network =
      *Network::make({{1, 1, 3}, {dense(8)}, {{dense(5), dense(1)}, {dense(7)}}});
  EXPECT_EQ(network.heads(), 2u);
  EXPECT_EQ(network.head(0).size(), 2u);
  EXPECT_EQ(network.head(1)[0].inputs, 8u);
  EXPECT_EQ(network.outputs(0), 1u);
  EXPECT_EQ(network.outputs(1), 7u);
  const Network bare = *Network::make({{1, 1, 3}, {}, {{dense(5)}}});
  EXPECT_EQ(bare.features().size(), 3u);
}

// The weights of a layer without padding.
std::vector<double> weights(const Layer& layer, const std::vector<float>& parameters) {
  std::vector<double> all;
  for (std::size_t i = 0; i < layer.inputs; ++i) {
    for (std::size_t j = 0; j < layer.outputs && layer.used(i); ++j) {
      all.push_back(double{parameters[layer.weights + i * layer.row + j]});
    }
  }
  return all;
}

std::vector<float> initialised(const Network& network, Initial how, std::uint64_t seed) {
  std::vector<float> parameters(network.parameters(), 77.0f);
  Rng rng{seed};
  network.initialise(how, rng, parameters);
  return parameters;
}

const NetworkSpec mixed{
    {6, 6, 3}, {convolution(20, 3), convolution(24, 2), dense(40)}, {{dense(3)}, {dense(50)}}};

TEST(Initial, VarianceBoundsAndBiases) {
  const Network network = *Network::make(mixed);
  for (const Initial how : {Initial::uniform, Initial::he}) {
    const std::vector<float> parameters = initialised(network, how, 1);
    for (const Layer& layer : network.layers()) {
      const auto fan = static_cast<double>(layer.fan());
      double squares = 0.0, largest = 0.0;
      const std::vector<double> all = weights(layer, parameters);
      EXPECT_EQ(all.size(), layer.fan() * layer.outputs);
      for (const double w : all) squares += w * w, largest = std::max(largest, std::fabs(w));
      const double variance = squares / static_cast<double>(all.size());
      const double expected = how == Initial::he ? 2.0 / fan : 1.0 / (3.0 * fan);
      // Five standard deviations of the estimate.
      const double spread =
          5.0 * std::sqrt((how == Initial::he ? 2.0 : 0.8) / static_cast<double>(all.size()));
      EXPECT_NEAR(variance / expected, 1.0, spread);
      EXPECT_LE(how == Initial::uniform ? largest : 0.0, 1.0000001 / std::sqrt(fan));
      for (std::size_t j = 0; j < layer.outputs; ++j) {
        const float bias = parameters[layer.bias + j];
        EXPECT_TRUE(how == Initial::he ? bias == 0.0f : bias != 0.0f);
      }
    }
  }
}

TEST(Initial, OrthogonalRowsOrColumns) {
  const Network network = *Network::make(mixed);
  const std::vector<float> parameters = initialised(network, Initial::orthogonal, 1);
  for (const Layer& layer : network.layers()) {
    const std::vector<double> w = weights(layer, parameters);
    const std::size_t rows = layer.fan(), columns = layer.outputs;
    const bool tall = rows >= columns;
    for (std::size_t a = 0; a < std::min(rows, columns); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double dot = 0.0;
        for (std::size_t i = 0; i < std::max(rows, columns); ++i) {
          dot += tall ? w[i * columns + a] * w[i * columns + b]
                      : w[a * columns + i] * w[b * columns + i];
        }
        ASSERT_NEAR(dot, a == b ? 2.0 : 0.0, 1e-6);
      }
    }
  }
}

// Nine in ten inputs of each output, rounded up, weigh nothing.
TEST(Initial, SparseKeepsOneInputInTen) {
  const Network network = *Network::make(mixed);
  const std::vector<float> parameters = initialised(network, Initial::sparse, 1);
  for (const Layer& layer : network.layers()) {
    const std::vector<double> w = weights(layer, parameters);
    std::vector<std::size_t> per_input(layer.fan());
    for (std::size_t j = 0; j < layer.outputs; ++j) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < layer.fan(); ++i) {
        const double one = w[i * layer.outputs + j];
        kept += one != 0.0;
        per_input[i] += one != 0.0;
        EXPECT_LE(std::fabs(one), 1.0000001 / std::sqrt(static_cast<double>(layer.fan())));
      }
      EXPECT_EQ(kept, layer.fan() / 10);
      EXPECT_EQ(parameters[layer.bias + j], 0.0f);
    }
    if (layer.fan() >= 10) {
      EXPECT_NE(*std::min_element(per_input.begin(), per_input.end()),
                *std::max_element(per_input.begin(), per_input.end()));
    }
  }
}

TEST(Initial, IsDecidedByTheSeedAndLeavesPaddingAtZero) {
  NetworkSpec spec = mixed;
  spec.body[1].normalisation = Normalisation::channels;
  const Network network = *Network::make(spec);
  for (const Initial how : {Initial::uniform, Initial::he, Initial::orthogonal}) {
    const std::vector<float> parameters = initialised(network, how, 4);
    EXPECT_EQ(parameters, initialised(network, how, 4));
    EXPECT_NE(parameters, initialised(network, how, 5));
    std::size_t numbers = 0;
    for (const float x : parameters) numbers += x != 0.0f ? 1 : 0;
    std::size_t zeros = network.layers()[1].outputs;  // the shifts
    if (how != Initial::uniform) {
      for (const Layer& layer : network.layers()) zeros += layer.outputs;
    }
    EXPECT_EQ(numbers, network.free_parameters() - zeros);
    for (std::size_t j = 0; j < 24; ++j) {
      EXPECT_EQ(parameters[network.layers()[1].gain + j], 1.0f);
    }
  }
}

}  // namespace
}  // namespace quoll::nn
