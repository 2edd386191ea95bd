// Networks that were learned, written and read back by readers that share nothing with the writers,
// which compute Q in double precision.

#include "quoll/report/network_export.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "onnx_reader.hpp"
#include "quoll/base/json_tree.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/nn/pass.hpp"
#include "safetensors_reader.hpp"

namespace quoll {
namespace {

using testing::OnnxModel;
using testing::Safetensors;
using testing::Tensor;

struct Learned {
  std::string world;
  std::function<void(LearnSettings&)> say;
  std::uint64_t steps = 300;
};

NetworkExport learned(const Learned& how) {
  const World world = *find_world(how.world);
  LearnSettings settings;
  settings.method = "dqn";
  settings.deep.hidden = "13,9";
  if (how.say) how.say(settings);
  if (settings.method == "dqn") settings.deep.learning_starts = 50;
  const auto learner = make_learner(settings, world);
  EXPECT_TRUE(learner) << message(learner.error());
  (*learner)->advance(how.steps, {});
  Result<NetworkExport> out = network_export(world, (*learner)->network());
  EXPECT_TRUE(out) << message(out.error());
  return *out;
}

// Each layout, way to read, and way to make Q of outputs, and what they meet in each other.
std::vector<Learned> all() {
  return {
      {"cartpole", {}},
      {"mountain-car",
       [](LearnSettings& s) {
         s.deep.hidden = "none";
         s.deep.inputs = Scaling::raw;
       }},
      {"cartpole",
       [](LearnSettings& s) {
         s.deep.layout = NetworkLayout::separate;
         s.deep.activation = "elu";
         s.deep.reward_scale = 0.1;
       }},
      {"cartpole",
       [](LearnSettings& s) {
         s.deep.layout = NetworkLayout::joint;
         s.deep.activation = "tanh";
         s.deep.layer_norm = Switch::on;
       }},
      {"acrobot",
       [](LearnSettings& s) {
         s.deep.duelling = true;
         s.deep.layer_norm = Switch::on;
         s.deep.returns = Returns::categorical;
         s.deep.atoms = 11;
         s.deep.lowest_return = -50;
         s.deep.highest_return = 0;
       }},
      {"tic-tac-toe", [](LearnSettings& s) { s.deep.inputs = Scaling::letters; }},
      {"tic-tac-toe",
       [](LearnSettings& s) {
         s.deep.inputs = Scaling::letters;
         s.deep.layout = NetworkLayout::joint;
       }},
      {"mountain-car",
       [](LearnSettings& s) {
         s.deep.layout = NetworkLayout::joint;
         s.deep.returns = Returns::quantile;
       }},
      {"cartpole",
       [](LearnSettings& s) {
         s.method = "pqn";
         s.deep.walkers = 4;
       }},
      {"minatar-breakout",
       [](LearnSettings& s) {
         s.deep.filters = "5x3,7x2/2";
         s.deep.layer_norm = Switch::on;
         s.deep.activation = "tanh";
       }},
      {"minatar-asterix",
       [](LearnSettings& s) {
         s.deep.filters = "3x3/3";
         s.deep.layout = NetworkLayout::separate;
         s.deep.returns = Returns::quantile;
         s.deep.atoms = 3;
       }},
      {"minatar-freeway",
       [](LearnSettings& s) {
         s.deep.filters = "4x4";
         s.deep.hidden = "none";
         s.deep.duelling = true;
       }},
      {"minatar-breakout", [](LearnSettings& s) { s.deep.filters = "none"; }},
      {"cartpole", [](LearnSettings& s) { s.deep.noisy = true; }},
      {"cartpole", [](LearnSettings& s) { s.method = "stream-q"; }},
      {"minatar-freeway",
       [](LearnSettings& s) {
         s.method = "stream-q";
         s.deep.hidden = "auto";
       },
       40},
      {"adventure", [](LearnSettings& s) { s.deep.layer_norm = Switch::on; }},
      {"adventure", [](LearnSettings& s) { s.deep.layout = NetworkLayout::joint; }},
      {"taxi", [](LearnSettings& s) { s.deep.layout = NetworkLayout::separate; }},
  };
}

// The inputs as a batch of the shape that the file declares.
Tensor batch(const NetworkExport& what) {
  const nn::Extent& in = what.network->observed;
  const auto rows = static_cast<std::int64_t>(what.vectors.count);
  if (what.network->numbered) {
    return {{rows}, {what.vectors.states.begin(), what.vectors.states.end()}};
  }
  Tensor out{{rows, in.channels}, {}};
  if (in.places() > 1) out.shape = {rows, in.height, in.width, in.channels};
  out.data.assign(what.vectors.observations.begin(), what.vectors.observations.end());
  return out;
}

void expect_q(const std::vector<double>& found, const std::vector<float>& expected,
              const std::string& which) {
  ASSERT_EQ(found.size(), expected.size()) << which;
  double size = 1.0;
  for (const float q : expected) size = std::max(size, std::fabs(double{q}));
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_NEAR(found[i], double{expected[i]}, 2e-6 * size) << which << " " << i;
  }
}

std::string input_of(const NetworkExport& what) {
  return what.network->numbered ? "state" : "observation";
}

TEST(NetworkExport, OnnxGivesTheQThatQuollFound) {
  for (std::size_t i = 0; i < all().size(); ++i) {
    const NetworkExport what = learned(all()[i]);
    const OnnxModel model(network_onnx(what));
    const auto values = model.compute(input_of(what), batch(what));
    const std::string which = "network " + std::to_string(i);
    expect_q(values.at("q").data, what.vectors.q, which);
    if (what.network->letters) {
      EXPECT_EQ(values.count("action"), 0u) << which;
      continue;
    }
    // The first best action of those that the state has.
    const std::size_t actions = what.network->actions;
    for (std::size_t row = 0; row < what.vectors.count; ++row) {
      const std::size_t count =
          what.action_counts.empty() ? actions : what.action_counts[what.vectors.states[row]];
      const auto action = static_cast<std::size_t>(values.at("action").data[row]);
      ASSERT_LT(action, count) << which;
      for (std::size_t a = 0; a < count; ++a) {
        EXPECT_LE(values.at("q").data[row * actions + a],
                  values.at("q").data[row * actions + action])
            << which;
      }
    }
  }
}

TEST(NetworkExport, SafetensorsGiveTheQThatQuollFound) {
  for (std::size_t i = 0; i < all().size(); ++i) {
    const NetworkExport what = learned(all()[i]);
    Safetensors file(network_safetensors(what));
    expect_q(file.compute(), what.vectors.q, "network " + std::to_string(i));
  }
}

// A comparison that cannot fail proves nothing.
TEST(NetworkExport, AnotherNumberIsNoticed) {
  NetworkExport what = learned(all().front());
  auto other = std::make_shared<LearnedNetwork>(*what.network);
  other->network.heads[0].back().bias[1] += 0.01F;
  what.network = other;
  const auto values = OnnxModel(network_onnx(what)).compute("observation", batch(what));
  const std::vector<double> read = Safetensors(network_safetensors(what)).compute();
  double onnx = 0.0, tensors = 0.0;
  for (std::size_t i = 0; i < what.vectors.q.size(); ++i) {
    onnx = std::max(onnx, std::fabs(values.at("q").data[i] - double{what.vectors.q[i]}));
    tensors = std::max(tensors, std::fabs(read[i] - double{what.vectors.q[i]}));
  }
  EXPECT_GT(onnx, 1e-4);
  EXPECT_GT(tensors, 1e-4);
}

// A convolution that is normalised over all its places, which no setting of a learner says.
TEST(NetworkExport, AWholeSampleOfPlanesIsNormalised) {
  nn::NetworkSpec spec;
  spec.input = {5, 6, 2};
  spec.body = {{.units = 16,
                .kernel = 2,
                .activation = nn::Activation::elu,
                .normalisation = nn::Normalisation::sample},
               {.units = 3, .kernel = 3, .normalisation = nn::Normalisation::none}};
  spec.heads = {{{.units = 4, .activation = nn::Activation::none}}};
  const nn::Network network = *nn::Network::make(spec);
  nn::Floats weights(network.parameters());
  Rng rng = stream(3, "weights");
  network.initialise(nn::Initial::uniform, rng, weights.span());
  const nn::Layer& first = network.layers()[0];
  for (std::size_t i = 0; i < first.normalised_row(); ++i) {
    weights[first.gain + i] = static_cast<float>(0.5 + rng.uniform());
    weights[first.shift + i] = static_cast<float>(rng.uniform());
  }
  auto learned = std::make_shared<LearnedNetwork>();
  learned->observed = spec.input;
  learned->network = nn::plain(network, weights.span());
  learned->actions = 4;
  NetworkExport what;
  what.world = what.name = "planes";
  what.actions = {"a", "b", "c", "d"};
  what.vectors.count = 3;
  for (std::size_t i = 0; i < 3 * spec.input.size(); ++i) {
    what.vectors.observations.push_back(static_cast<float>(2.0 * rng.uniform() - 1.0));
  }
  nn::Pass pass(network, 3, false);
  pass.forward(weights.data(), what.vectors.observations.data(), spec.input.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const float* const row = pass.output(0) + i * pass.output_row(0);
    what.vectors.q.insert(what.vectors.q.end(), row, row + 4);
  }
  what.network = learned;
  const auto values = OnnxModel(network_onnx(what)).compute("observation", batch(what));
  expect_q(values.at("q").data, what.vectors.q, "onnx");
  expect_q(Safetensors(network_safetensors(what)).compute(), what.vectors.q, "safetensors");
}

TEST(NetworkExport, OnnxSaysWhatItIs) {
  const OnnxModel model(network_onnx(learned({"cartpole", {}})));
  EXPECT_EQ(model.operators(), 13u);
  EXPECT_EQ(model.declared(11, 0), "observation 1 batch,4");
  EXPECT_EQ(model.declared(12, 0), "q 1 batch,2");
  EXPECT_EQ(model.declared(12, 1), "action 7 batch");
  EXPECT_EQ(model.fact("world"), "cartpole");
  EXPECT_EQ(model.fact("actions"), "[\"left\",\"right\"]");
  const Result<Tree> vectors = read_json(model.fact("self_test"), "self_test");
  ASSERT_TRUE(vectors);
  const OnnxModel planes(network_onnx(learned({"minatar-breakout", {}})));
  EXPECT_EQ(planes.declared(11, 0), "observation 1 batch,10,10,4");
  const OnnxModel numbered(network_onnx(learned({"adventure", {}})));
  EXPECT_EQ(numbered.declared(11, 0), "state 7 batch");
  EXPECT_EQ(numbered.fact("states"), R"(["GATE","HALL","POOL","CAVE","WELL","GOAL"])");
  EXPECT_EQ(numbered.fact("actions").substr(0, 36), R"([["To-POOL"],["To-CAVE","To-POOL"],[)");
}

// Of letters every input says which, and every output whose it is.
TEST(NetworkExport, LettersSayWhatTheyAre) {
  const NetworkExport what =
      learned({"tic-tac-toe", [](LearnSettings& s) { s.deep.inputs = Scaling::letters; }});
  const World world = *find_world("tic-tac-toe");
  ASSERT_EQ(what.numbers.size(), what.network->observed.size());
  ASSERT_EQ(what.actions.size(), what.network->actions);
  // A row of the vectors spells the name of a state, one letter at each place that tells something.
  const std::size_t row = what.numbers.size();
  for (std::size_t i = 0; i < what.vectors.count; ++i) {
    std::string name(20, ' ');
    for (std::size_t k = 0; k < row; ++k) {
      if (what.vectors.observations[i * row + k] == 0.0F) continue;
      const std::string& number = what.numbers[k];
      name[std::stoul(number.substr(number.find(' ') + 1))] = number[0];
    }
    std::size_t fitting = 0;
    for (State s = 0; s < world.mdp->states(); ++s) {
      const std::string full = world.mdp->state_name(s);
      bool fits = !world.mdp->terminal(s);
      for (std::size_t k = 0; k < name.size() && fits; ++k) {
        fits = name[k] == ' ' || (k < full.size() && full[k] == name[k]);
      }
      fitting += fits;
    }
    EXPECT_EQ(fitting, 1u) << name;
  }
}

TEST(NetworkExport, WhatIsNotFiniteIsRefused) {
  const World world = *find_world("cartpole");
  auto network = std::make_shared<LearnedNetwork>(*learned({"cartpole", {}}).network);
  network->network.body[1].bias[3] = NAN;
  const Result<NetworkExport> out = network_export(world, network);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().expected, "a number of this network is not finite: it has diverged");
}

}  // namespace
}  // namespace quoll
