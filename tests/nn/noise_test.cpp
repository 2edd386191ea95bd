#include "quoll/nn/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

// A convolution whose filters are padded, a dense layer that reads them, two heads.
NetworkSpec planes() {
  const LayerSpec filters{.units = 3, .kernel = 2, .activation = Activation::tanh};
  const LayerSpec hidden{.units = 9, .activation = Activation::tanh};
  const LayerSpec one{.units = 1, .activation = Activation::none};
  const LayerSpec many{.units = 5, .activation = Activation::none};
  return {{3, 4, 2}, {filters, hidden}, {{one}, {many}}};
}

// The noise of each parameter: what weights of mean 0 and spread 1 become.
std::vector<float> noise_of(const Network& network, const Noise& noise) {
  const std::size_t n = network.parameters();
  std::vector<float> mu_sigma(2 * n), weights(n);
  std::fill_n(mu_sigma.begin() + static_cast<std::ptrdiff_t>(n), n, 1.0F);
  noise.compose(mu_sigma, weights);
  return weights;
}

TEST(Noise, SpreadsBeginAsPublishedAndPaddingHasNone) {
  const Network network = *Network::make(planes());
  std::vector<float> sigma(network.parameters(), 9.0F);
  initialise_sigma(network, sigma);
  std::size_t spread = 0;
  for (const float one : sigma) spread += one != 0.0F;
  // 2 x 3 places of 3 filters, read by 9 units; heads of 1 and 5; a bias each.
  EXPECT_EQ(spread, (18u + 1) * 9 + (9u + 1) * 6);
  const Layer& hidden = network.layers()[1];
  EXPECT_EQ(sigma[hidden.weights], static_cast<float>(0.5 / std::sqrt(18.0)));
  EXPECT_EQ(sigma[hidden.bias + 8], static_cast<float>(0.5 / std::sqrt(18.0)));
  EXPECT_EQ(sigma[network.layers()[2].weights], static_cast<float>(0.5 / std::sqrt(9.0)));
}

TEST(Noise, IsAProductOfANumberPerInputAndOnePerOutput) {
  const Network network = *Network::make(planes());
  Noise noise(network);
  Rng rng = stream(3, "noise");
  noise.draw(rng);
  const std::vector<float> e = noise_of(network, noise);
  for (const Layer& layer : network.layers()) {
    if (layer.spec.convolution()) {
      for (std::size_t i = layer.weights; i < layer.bias + layer.row; ++i) EXPECT_EQ(e[i], 0.0F);
      continue;
    }
    for (std::size_t j = 0; j < layer.outputs; ++j) EXPECT_NE(e[layer.bias + j], 0.0F);
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      const float* const row = e.data() + layer.weights + i * layer.row;
      // The bias has the factors of the outputs alone.
      const float by = row[0] / e[layer.bias];
      EXPECT_EQ(by != 0.0F, layer.used(i));
      for (std::size_t j = 0; j < layer.row; ++j) {
        EXPECT_NEAR(row[j], by * e[layer.bias + j], 1e-6F * std::fabs(row[j]));
      }
    }
  }
}

// f(x) = sign(x) sqrt|x| of a standard normal x: mean 0, variance E|x| = sqrt(2 / pi). 4000 draws
// of 9 factors: the bounds are six standard errors.
TEST(Noise, HasMeanZeroAndThePublishedVariance) {
  const Network network = *Network::make({{1, 1, 2}, {}, {{{.units = 9}}}});
  Noise noise(network);
  Rng rng = stream(1, "noise");
  double sum = 0.0, squares = 0.0, product = 0.0;
  const std::size_t bias = network.layers()[0].bias;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    noise.draw(rng);
    const std::vector<float> e = noise_of(network, noise);
    for (std::size_t j = 0; j < 9; ++j) {
      sum += double{e[bias + j]};
      squares += double{e[bias + j]} * double{e[bias + j]};
      product += double{e[network.layers()[0].weights + j]};
    }
  }
  constexpr double count = 9.0 * draws;
  EXPECT_NEAR(sum / count, 0.0, 6 * std::sqrt(0.798 / count));
  EXPECT_NEAR(squares / count, std::sqrt(2.0 / 3.14159265358979), 6 * 0.61 / std::sqrt(count));
  // The nine of a draw share the factor of their input.
  EXPECT_NEAR(product / count, 0.0, 6 * 0.798 / std::sqrt(count));
}

// By central differences of a loss that is linear in all outputs, in double steps of the floats.
TEST(Noise, GradientsBySpreadsAgreeWithFiniteDifferences) {
  const Network network = *Network::make(planes());
  const std::size_t n = network.parameters();
  std::vector<float> mu_sigma(2 * n), weights(n), gradients(2 * n, 9.0F);
  Rng rng = stream(2, "weights");
  network.initialise(Initial::uniform, rng, std::span(mu_sigma).first(n));
  initialise_sigma(network, std::span(mu_sigma).subspan(n));
  Noise noise(network);
  noise.draw(rng);
  const std::vector<float> inputs = random_floats(3 * network.inputs(), 7);
  Pass pass(network, 3, true);
  const auto by_output = [](std::size_t head, std::size_t i) {
    return static_cast<float>(std::sin(static_cast<double>(1 + head * 7 + i * 3)));
  };
  const auto loss = [&] {
    noise.compose(mu_sigma, weights);
    pass.forward(weights.data(), inputs.data(), network.inputs(), 3);
    double sum = 0.0;
    for (std::size_t h = 0; h < 2; ++h) {
      for (std::size_t i = 0; i < 3 * pass.output_row(h); ++i) {
        sum += double{by_output(h, i)} * double{pass.output(h)[i]};
      }
    }
    return sum;
  };
  loss();
  for (std::size_t h = 0; h < 2; ++h) {
    for (std::size_t i = 0; i < 3 * pass.output_row(h); ++i) {
      pass.gradient(h)[i] = i % pass.output_row(h) < network.outputs(h) ? by_output(h, i) : 0.0F;
    }
  }
  pass.backward(weights.data(), gradients.data());
  noise.pass_on(gradients);
  for (std::size_t i = n; i < 2 * n; ++i) {
    const float here = mu_sigma[i];
    if (here == 0.0F) {
      EXPECT_EQ(gradients[i], 0.0F) << i;
      continue;
    }
    mu_sigma[i] = here + 0.02F;
    const double above = loss();
    mu_sigma[i] = here - 0.02F;
    EXPECT_NEAR(gradients[i], (above - loss()) / 0.04, 2e-3) << i;
    mu_sigma[i] = here;
  }
}

}  // namespace
}  // namespace quoll::nn
