// Networks that say Q: the layouts, their gradients, their noise.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../worlds.hpp"
#include "quoll/learn/deep/q_network.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

struct Variant {
  std::string name;
  DeepSettings settings;
};

std::vector<Variant> layouts() {
  std::vector<Variant> all;
  for (std::size_t i = 0; i < std::size(layout_names); ++i) {
    DeepSettings settings;
    settings.layout = static_cast<NetworkLayout>(i);
    all.push_back({std::string(layout_names[i]), settings});
  }
  DeepSettings duelling;
  duelling.duelling = true;
  all.push_back({"duelling", duelling});
  return all;
}

DeepSetup setup_of(const DeepSettings& settings, std::uint32_t atoms) {
  DeepSetup deep;
  deep.settings = settings;
  deep.settings.clip_gradient = 1e30;  // tells the norm
  deep.actions = 3;
  deep.spaces.observation = 5;
  deep.input = {1, 1, 5};
  deep.hidden = {{.units = 20, .activation = nn::Activation::tanh},
                 {.units = 12, .activation = nn::Activation::tanh}};
  deep.optimiser.kind = nn::OptimiserKind::sgd;
  deep.atoms = atoms;
  return deep;
}

std::vector<float> inputs(std::size_t n) {
  Rng rng = stream(5, "inputs");
  std::vector<float> x(n);
  for (float& value : x) value = static_cast<float>(2.0 * rng.uniform() - 1.0);
  return x;
}

// More pairs of a row and an action than the joint layout takes at once.
TEST(QNetwork, ValuesOfManyRowsAreThoseOfEach) {
  constexpr std::size_t rows = 2000;
  for (const Variant& variant : layouts()) {
    const auto q = *make_q_network(setup_of(variant.settings, 2), 1, rows, false);
    const std::vector<float> x = inputs(rows * 5);
    std::vector<float> all(rows * 6), one(6);
    q->values(QFunction::Weights::online, x.data(), rows, all.data());
    for (const std::size_t i : {0u, 1364u, 1365u, 1366u, 1999u}) {
      q->values(QFunction::Weights::online, x.data() + i * 5, 1, one.data());
      for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(all[i * 6 + k], one[k]) << variant.name;
    }
  }
}

TEST(QNetwork, ValuesOfOnesAreThoseOfTheRowWithItsZeros) {
  for (const Variant& variant : layouts()) {
    for (const std::uint32_t atoms : {1u, 7u}) {
      const auto q = *make_q_network(setup_of(variant.settings, atoms), 1, 1, false);
      std::vector<float> told(3 * atoms), written(3 * atoms);
      for (const std::vector<std::uint32_t>& ones :
           {std::vector<std::uint32_t>{4}, {0, 2}, {}, {1}}) {
        std::vector<float> row(5, 0.0F);
        for (const std::uint32_t at : ones) row[at] = 1.0F;
        q->values(ones, told.data());
        q->values(QFunction::Weights::online, row.data(), 1, written.data());
        EXPECT_EQ(told, written) << variant.name;
      }
    }
  }
}

TEST(NameLetters, AreCodePointsAtTheirPlaces) {
  MdpBuilder builder(0.9);
  builder.move("äx1", "go", "öx2").move("öx2", "go", "END", 1).start("äx1");
  const World world = to_world("umlauts", *builder.build());
  const auto letters = *NameLetters::make(world, world.make({})->spaces());
  EXPECT_EQ(letters->size(), 4u);  // ä, ö; x tells nothing; 1, 2
  EXPECT_EQ(std::vector(letters->of(0).begin(), letters->of(0).end()),
            (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(std::vector(letters->of(1).begin(), letters->of(1).end()),
            (std::vector<std::uint32_t>{1, 3}));
}

TEST(NameLetters, OneStateToActInTellsNothing) {
  MdpBuilder builder(0.9);
  builder.move("only", "go", "END", 1).start("only");
  const World world = to_world("one", *builder.build());
  const auto letters = NameLetters::make(world, world.make({})->spaces());
  ASSERT_FALSE(letters);
  EXPECT_EQ(message(letters.error()),
            "--inputs: one has one state to act in: its name tells nothing; did you mean 'auto'?");
}

TEST(QNetwork, PredictsWhatItSaysItsValuesAre) {
  for (const Variant& variant : layouts()) {
    for (const std::uint32_t atoms : {1u, 7u}) {
      const auto q = *make_q_network(setup_of(variant.settings, atoms), 1, 9, true);
      const std::vector<float> x = inputs(9 * 5);
      std::vector<float> values(9 * 3 * atoms), predicted(9 * atoms);
      q->values(QFunction::Weights::online, x.data(), 9, values.data());
      std::vector<Action> actions;
      for (Action i = 0; i < 9; ++i) actions.push_back(i % 3);
      q->predict(x.data(), 9, actions.data(), predicted.data());
      for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t k = 0; k < atoms; ++k) {
          EXPECT_EQ(predicted[i * atoms + k], values[(i * 3 + actions[i]) * atoms + k])
              << variant.name;
        }
      }
    }
  }
}

// A small step against the gradient of an output changes it by -rate |gradient|^2.
TEST(QNetwork, AStepGoesDownTheGradient) {
  for (const Variant& variant : layouts()) {
    for (const std::uint32_t atoms : {1u, 4u}) {
      const auto q = *make_q_network(setup_of(variant.settings, atoms), 1, 4, true);
      const std::vector<float> x = inputs(4 * 5);
      const std::vector<Action> actions = {2, 0, 1, 2};
      std::vector<float> before(4 * atoms), after(4 * atoms), slopes(4 * atoms, 0.0F);
      slopes[1 * atoms + atoms - 1] = 1.0F;
      q->predict(x.data(), 4, actions.data(), before.data());
      constexpr double rate = 1e-3;
      const double norm = q->update(slopes.data(), rate);
      q->predict(x.data(), 4, actions.data(), after.data());
      const double change =
          double{after[1 * atoms + atoms - 1]} - double{before[1 * atoms + atoms - 1]};
      EXPECT_GT(norm, 0.1) << variant.name;
      EXPECT_NEAR(change, -rate * norm * norm, 0.02 * rate * norm * norm) << variant.name;
    }
  }
}

TEST(QNetwork, ABatchInPartsIsTheBatch) {
  for (const Variant& variant : layouts()) {
    const std::vector<float> x = inputs(9 * 5), slopes = {1, -2, 3, -4, 5, -6, 7, -8, 9};
    const std::vector<Action> actions = {0, 1, 2, 0, 1, 2, 2, 1, 0};
    std::vector<float> out(9), whole(27), parts(27);
    for (std::vector<float>* const values : {&whole, &parts}) {
      const auto q = *make_q_network(setup_of(variant.settings, 1), 1, 9, false);
      // The second step tells whether what was kept is forgotten.
      for (int step = 0; step < 2; ++step) {
        for (std::size_t begin = 0; begin < 9; begin += 3) {
          const std::size_t rows = values == &whole ? 9 : 3;
          q->predict(x.data() + begin * 5, rows, &actions[begin], out.data());
          if (begin + rows == 9) {
            q->update(&slopes[begin], 1e-3);
            break;
          }
          q->add(&slopes[begin]);
        }
      }
      q->values(QFunction::Weights::online, x.data(), 9, values->data());
    }
    for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(whole[i], parts[i], 1e-5) << variant.name;
  }
}

TEST(QNetwork, TheTargetStaysUntilItIsMoved) {
  const auto q = *make_q_network(setup_of({}, 1), 1, 2, true);
  const std::vector<float> x = inputs(2 * 5), slopes = {1, -1};
  const std::vector<Action> actions = {0, 1};
  std::vector<float> online(6), target(6), first(6), out(2);
  const auto look = [&](QFunction::Weights which, std::vector<float>& values) {
    q->values(which, x.data(), 2, values.data());
  };
  look(QFunction::Weights::target, first);
  q->predict(x.data(), 2, actions.data(), out.data());
  q->update(slopes.data(), 0.1);
  look(QFunction::Weights::target, target);
  EXPECT_EQ(target, first);
  look(QFunction::Weights::online, online);
  EXPECT_NE(online, first);
  q->sync(1.0);
  look(QFunction::Weights::target, target);
  EXPECT_EQ(target, online);
  const auto copy = q->snapshot();
  q->predict(x.data(), 2, actions.data(), out.data());
  q->update(slopes.data(), 0.1);
  copy->values(QFunction::Weights::online, x.data(), 2, target.data());
  EXPECT_EQ(target, online);
}

// Of a network without a hidden layer, whose values are as its weights.
TEST(QNetwork, TheTargetMovesAPartOfTheWay) {
  DeepSetup deep = setup_of({}, 1);
  deep.hidden.clear();
  const auto q = *make_q_network(deep, 1, 2, true);
  const std::vector<float> x = inputs(2 * 5), slopes = {1, -1};
  const std::vector<Action> actions = {0, 1};
  std::vector<float> first(6), online(6), target(6), out(2);
  q->values(QFunction::Weights::target, x.data(), 2, first.data());
  q->predict(x.data(), 2, actions.data(), out.data());
  q->update(slopes.data(), 0.1);
  q->sync(0.25);
  q->values(QFunction::Weights::online, x.data(), 2, online.data());
  q->values(QFunction::Weights::target, x.data(), 2, target.data());
  EXPECT_NE(online, first);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(target[i], 0.75F * first[i] + 0.25F * online[i], 1e-5F);
  }
}

TEST(QNetwork, NoiseIsDrawnAnewAndNoPartOfASnapshot) {
  for (Variant variant : layouts()) {
    variant.settings.noisy = true;
    const auto noisy = *make_q_network(setup_of(variant.settings, 1), 1, 2, true);
    variant.settings.noisy = false;
    const auto calm = *make_q_network(setup_of(variant.settings, 1), 1, 2, true);
    const std::vector<float> x = inputs(2 * 5), slopes = {1, -1};
    const std::vector<Action> actions = {0, 1};
    std::vector<float> first(6), second(6), target(6), plain(6), out(2);
    using Weights = QFunction::Weights;
    calm->values(Weights::online, x.data(), 2, plain.data());
    // Before any noise, and without it, the means.
    noisy->values(Weights::online, x.data(), 2, first.data());
    EXPECT_EQ(first, plain) << variant.name;
    noisy->redraw(Weights::online);
    noisy->values(Weights::online, x.data(), 2, first.data());
    EXPECT_NE(first, plain) << variant.name;
    noisy->values(Weights::online, x.data(), 2, second.data());
    EXPECT_EQ(first, second) << variant.name;
    noisy->values(Weights::target, x.data(), 2, target.data());
    EXPECT_EQ(target, plain) << variant.name;
    noisy->redraw(Weights::target);
    noisy->values(Weights::target, x.data(), 2, target.data());
    EXPECT_NE(target, plain) << variant.name;
    EXPECT_NE(target, first) << variant.name;
    noisy->predict(x.data(), 2, actions.data(), out.data());
    EXPECT_EQ(out[0], first[0]) << variant.name;
    noisy->redraw(Weights::online);
    noisy->values(Weights::online, x.data(), 2, second.data());
    EXPECT_NE(first, second) << variant.name;
    noisy->snapshot()->values(Weights::online, x.data(), 2, second.data());
    EXPECT_EQ(second, plain) << variant.name;
  }
}

// A step against the gradient: the means and the spreads both move, the noise being the same.
TEST(QNetwork, AStepGoesDownTheGradientOfMeansAndSpreads) {
  DeepSettings settings;
  settings.noisy = true;
  const auto q = *make_q_network(setup_of(settings, 1), 1, 2, true);
  const std::vector<float> x = inputs(2 * 5), slopes = {1, 0};
  const std::vector<Action> actions = {2, 0};
  std::vector<float> before(2), after(2);
  q->redraw(QFunction::Weights::online);
  q->predict(x.data(), 2, actions.data(), before.data());
  constexpr double rate = 1e-3;
  const double norm = q->update(slopes.data(), rate);
  q->predict(x.data(), 2, actions.data(), after.data());
  EXPECT_NEAR(double{after[0]} - double{before[0]}, -rate * norm * norm, 0.02 * rate * norm * norm);
}

}  // namespace
}  // namespace quoll
