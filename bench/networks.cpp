// Training and acting of small Q-networks, beside the same put together from libraries, in the same
// run, in turn:
//   ./dev bench networks [TARGET]
// prints microseconds of the processor, GFLOP/s, the share of what one core can do, and the ratio
// to the fastest library (below 1: Quoll is faster). TARGET is an instruction set to keep to.
// A training step is a step of DQN: Q of a batch, the target network's Q of what followed, the
// error of the actions taken, all gradients, Adam. Planes are 0 or 1, one in 16 set, as those of
// MinAtar.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/yardstick/library_network.hpp"
#include "bench/yardstick/stopwatch.hpp"
#include "quoll/base/random.hpp"
#include "quoll/nn/optimiser.hpp"

namespace {

using namespace quoll;

struct Case {
  const char* name;
  yardstick::NetworkShape shape;
  double mflop_forward, mflop_train;  // per sample
};

Case make_case(const char* name, yardstick::NetworkShape shape) {
  double first = 0.0, rest = 0.0;
  std::size_t inputs = shape.inputs;
  if (shape.channels > 0) {
    first = 64.0 * 16 * 9 * static_cast<double>(shape.channels);
    inputs = 64 * 16;
  }
  for (const std::size_t outputs : shape.dense) {
    (first == 0.0 ? first : rest) += static_cast<double>(inputs * outputs);
    inputs = outputs;
  }
  return {name, shape, 2e-6 * (first + rest), 2e-6 * (3 * first + 4 * rest)};
}

std::vector<float> numbers(const yardstick::NetworkShape& shape, std::size_t n, Rng& rng) {
  std::vector<float> values(n);
  for (float& value : values) {
    value = shape.channels > 0 ? static_cast<float>(rng.below(16) == 0)
                               : static_cast<float>(2.0 * rng.uniform() - 1.0);
  }
  return values;
}

class QuollNetwork {
 public:
  QuollNetwork(const yardstick::NetworkShape& shape, std::size_t most)
      : network_(*nn::Network::make(spec(shape))),
        parameters_(network_.parameters()),
        target_(network_.parameters()),
        gradients_(network_.parameters()),
        optimiser_({}, network_.parameters()),
        online_(network_, most, true),
        ahead_(network_, most, false),
        targets_(most),
        row_(shape.inputs) {
    Rng rng{1};
    network_.initialise(nn::Initial::uniform, rng, parameters_.span());
    std::copy_n(parameters_.data(), parameters_.size(), target_.data());
  }

  static nn::NetworkSpec spec(const yardstick::NetworkShape& shape) {
    nn::NetworkSpec spec{{1, 1, static_cast<std::uint32_t>(shape.inputs)}, {}, {}};
    if (shape.channels > 0) {
      spec.input = {10, 10, static_cast<std::uint32_t>(shape.channels)};
      spec.body.push_back({.units = 16, .kernel = 3});
    }
    for (const std::size_t n : shape.dense) {
      spec.body.push_back({.units = static_cast<std::uint32_t>(n)});
    }
    spec.heads = {{spec.body.back()}};
    spec.heads[0][0].activation = nn::Activation::none;
    spec.body.pop_back();
    return spec;
  }

  // Without padding: weights and biases, layer after layer.
  std::vector<float> parameters() const {
    std::vector<float> all;
    for (const nn::Layer& layer : network_.layers()) {
      for (std::size_t i = 0; i <= layer.inputs; ++i) {
        const float* const row = parameters_.data() + layer.weights + i * layer.row;
        all.insert(all.end(), row, row + layer.outputs);
      }
    }
    return all;
  }

  const float* act(const float* inputs, std::size_t samples) {
    online_.forward(parameters_.data(), inputs, row_, samples);
    return online_.output(0);
  }

  void train(const yardstick::Transitions& batch) {
    const std::size_t samples = batch.actions.size(), n = network_.outputs(0);
    const std::size_t row = online_.output_row(0);
    ahead_.forward(target_.data(), batch.after.data(), row_, samples);
    for (std::size_t i = 0; i < samples; ++i) {
      const float* const next = ahead_.output(0) + i * row;
      targets_[i] = batch.rewards[i] + 0.99f * *std::max_element(next, next + n);
    }
    online_.forward(parameters_.data(), batch.before.data(), row_, samples);
    float* const by_q = online_.gradient(0);
    std::fill_n(by_q, samples * row, 0.0f);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::size_t at = i * row + batch.actions[i];
      by_q[at] = (online_.output(0)[at] - targets_[i]) / static_cast<float>(samples);
    }
    online_.backward(parameters_.data(), gradients_.data());
    optimiser_.step(parameters_.span(), gradients_.span(), 2.5e-4);
  }

  std::size_t row() const { return online_.output_row(0); }

 private:
  nn::Network network_;
  nn::Floats parameters_, target_, gradients_;
  nn::Optimiser optimiser_;
  nn::Pass online_, ahead_;
  std::vector<float> targets_;
  std::size_t row_;
};

// The shortest of several blocks for each contestant, in turn.
std::vector<double> microseconds(const std::vector<std::function<void()>>& works, double mflop) {
  const auto repeats = static_cast<std::size_t>(1.0 + 400.0 / (mflop + 0.02));
  std::vector<double> best(works.size(), 1e30);
  for (int block = 0; block < 7; ++block) {
    for (std::size_t i = 0; i < works.size(); ++i) {
      const double taken = yardstick::cpu_seconds([&] {
        for (std::size_t r = 0; r < repeats; ++r) works[i]();
      });
      best[i] = std::min(best[i], 1e6 * taken / static_cast<double>(repeats));
    }
  }
  return best;
}

void print(const char* name, std::size_t batch, const std::vector<double>& us, double mflop,
           double bound) {
  const double rate = mflop / us[0] * 1e3;
  std::printf("  %-15s %5zu %9.2f us %7.1f GFLOP/s %4.0f %%  ", name, batch, us[0], rate,
              100.0 * rate / bound);
  double best = 1e30;
  for (std::size_t i = 1; i < us.size(); ++i) {
    std::printf(" %9.2f", us[i]);
    best = std::min(best, us[i]);
  }
  if (us.size() > 1) std::printf("   ratio %.2f", us[0] / best);
  std::printf("\n");
}

// The largest difference between Quoll's Q-values and the others', of the same inputs.
double difference(QuollNetwork& own, auto& others, const Case& what,
                  const std::vector<float>& inputs, std::size_t samples) {
  double most = 0.0;
  const std::size_t n = what.shape.dense.back();
  const float* const q = own.act(inputs.data(), samples);
  for (auto& other : others) {
    const float* const theirs = other->act(inputs.data(), samples);
    for (std::size_t i = 0; i < samples * n; ++i) {
      most = std::max(most, std::fabs(double{q[i / n * own.row() + i % n]} - theirs[i]));
    }
  }
  return most;
}

void measure(const Case& what, std::size_t batch, bool train, double bound) {
  Rng rng{7};
  QuollNetwork own(what.shape, batch);
  auto others = yardstick::library_networks(what.shape, batch, own.parameters());
  yardstick::Transitions data;
  data.before = numbers(what.shape, batch * what.shape.inputs, rng);
  data.after = numbers(what.shape, batch * what.shape.inputs, rng);
  for (std::size_t i = 0; i < batch; ++i) {
    data.rewards.push_back(static_cast<float>(rng.uniform()));
    data.actions.push_back(rng.below(static_cast<std::uint32_t>(what.shape.dense.back())));
  }
  if (train) {
    for (int step = 0; step < 6; ++step) {
      own.train(data);
      for (auto& other : others) other->train(data);
    }
  }
  const double apart = difference(own, others, what, data.before, batch);
  if (!(apart < 1e-3)) std::printf("  %s: Q-values differ by %g\n", what.name, apart);
  const auto work = [&](auto* it) -> std::function<void()> {
    if (train) return [it, &data] { it->train(data); };
    return [it, &data, batch] { it->act(data.before.data(), batch); };
  };
  std::vector<std::function<void()>> works{work(&own)};
  for (auto& other : others) works.push_back(work(other.get()));
  const double mflop = (train ? what.mflop_train : what.mflop_forward) * static_cast<double>(batch);
  print(what.name, batch, microseconds(works, mflop), mflop, bound);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && !nn::use_arithmetic(argv[1])) {
    std::fprintf(stderr, "no instruction set %s here\n", argv[1]);
    return 1;
  }
  const Case cases[] = {make_case("mlp4-120-84-2", {0, 4, {120, 84, 2}}),
                        make_case("mlp8-256-256-4", {0, 8, {256, 256, 4}}),
                        make_case("minatar4", {4, 400, {128, 6}}),
                        make_case("minatar10", {10, 1000, {128, 6}})};
  const double bound = yardstick::core_bound();
  std::printf("%s; one core: %.0f GFLOP/s; columns of the libraries, us:",
              std::string(nn::arithmetic().target).c_str(), bound);
  for (const auto& other : yardstick::library_networks(
           cases[0].shape, 1, QuollNetwork(cases[0].shape, 1).parameters())) {
    std::printf(" %s", other->name().c_str());
  }
  for (const bool train : {true, false}) {
    std::printf("\n%s\n", train ? "training step" : "action selection");
    for (const Case& what : cases) {
      for (const std::size_t batch : {train ? 32u : 1u, train ? 128u : 16u, train ? 1024u : 128u}) {
        measure(what, batch, train, bound);
      }
    }
  }
}
