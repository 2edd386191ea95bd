// Networks that learn Q: the layouts, and small worlds whose values are known.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../resume.hpp"
#include "../worlds.hpp"
#include "quoll/learn/deep/q_network.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

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

LearnSettings network(const std::string& method) {
  LearnSettings settings;
  settings.method = method;
  settings.explore = "uniform";
  settings.until_stable = false;
  settings.deep.hidden = "none";
  settings.deep.optimiser = "sgd";
  settings.deep.loss = "half-squared";
  settings.deep.clip_gradient = 0.0;
  settings.deep.learning_rate = "2";
  if (settings.method != "dqn") return settings;
  settings.deep.batch = 32;
  settings.deep.learning_starts = 100;
  settings.deep.train_every = 1;
  settings.deep.target_every = 50;
  return settings;
}

// Largest difference from Q*, in units of the largest reward.
double error_of(const World& world, const Learner& learner) {
  SolveSettings exactly;
  exactly.discount = world.discount;
  const Solution best = *solve(*world.mdp, exactly);
  const Estimates estimates = learner.estimates();
  double worst = 0.0, scale = 0.0;
  for (State s = 0; s < world.mdp->states(); ++s) {
    scale = std::max(scale, std::fabs(best.upper[s]));
    if (world.mdp->terminal(s)) continue;
    for (Action a = 0; a < world.mdp->actions(s); ++a) {
      const std::uint64_t c = world.mdp->choice_begin(s) + a;
      const double q = q_star(*world.mdp, best.upper, c, world.discount);
      worst = std::max(worst, std::fabs(estimates.q[c] - q));
    }
  }
  return worst / scale;
}

TEST(Dqn, ALinearNetworkOfOneNumberPerStateFindsTheTable) {
  for (const World& world : {adventure(), star(), corridor(5)}) {
    for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::separate}) {
      LearnSettings settings = network("dqn");
      settings.deep.layout = layout;
      const auto one = learner(settings, world);
      one->advance(10'000, {});
      EXPECT_LT(error_of(world, *one), 1e-4) << world.name;
    }
  }
}

TEST(Dqn, ANetworkThatReadsTheActionFindsItToo) {
  LearnSettings settings = network("dqn");
  settings.deep.layout = NetworkLayout::joint;
  settings.deep.hidden = "32";
  settings.deep.optimiser = "adam";
  settings.deep.learning_rate = "0.005:0.0001:15000";
  settings.deep.reward_scale = 0.01;
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(15'000, {});
  EXPECT_LT(error_of(world, *one), 0.02);
}

TEST(Dqn, SwitchesThatKeepTheFixedPointReachIt) {
  const World world = adventure();
  for (int which = 0; which < 16; ++which) {
    LearnSettings settings = network("dqn");
    settings.deep.double_q = (which & 1) != 0;
    settings.deep.duelling = (which & 2) != 0;
    settings.deep.prioritised = (which & 4) != 0;
    settings.deep.noisy = (which & 8) != 0;
    if (settings.deep.prioritised) settings.deep.priority_correction = "1";
    settings.deep.learning_rate = "0.5";
    const auto one = learner(settings, world);
    one->advance(20'000, {});
    EXPECT_LT(error_of(world, *one), 1e-3) << which;
  }
}

// Noise explores alone, and every cut continues it bit for bit.
TEST(Dqn, NoiseExploresAndIsContinued) {
  const World world = adventure();
  LearnSettings settings = network("dqn");
  settings.explore = "auto";
  settings.deep.noisy = true;
  settings.deep.hidden = "16";
  settings.deep.optimiser = "adam";
  settings.deep.learning_rate = "0.002";
  settings.deep.reward_scale = 0.01;
  settings.deep.double_q = settings.deep.duelling = settings.deep.prioritised = true;
  settings.deep.multi_step = 3;
  const auto whole = learner(settings, world);
  whole->advance(3000, {});
  const Estimates estimates = whole->estimates();
  const std::vector<Action> policy = greedy_policy(estimates);
  EXPECT_EQ(world.mdp->action_name(world.mdp->choice_begin(1) + policy[1]), "To-CAVE");
  for (const std::uint64_t cut : {50u, 101u, 1777u}) {
    const auto first = learner(settings, world);
    first->advance(cut, {});
    const auto second = learner(settings, world);
    ASSERT_NO_FATAL_FAILURE(resume(*first, *second));
    second->advance(3000 - cut, {});
    EXPECT_EQ(saved(*second), saved(*whole)) << cut;
  }
}

// What the target network said of a frame counts until either changes: a learner that goes on from
// what is saved knows nothing of it, and learns the same.
TEST(Dqn, ValuesOfTheTargetAreThoseItWouldSayNow) {
  for (const World& world : {adventure(), corridor(5)}) {
    for (const bool munchausen : {false, true}) {
      LearnSettings settings = network("dqn");
      settings.deep.munchausen = munchausen;
      settings.deep.hidden = "8";
      settings.deep.optimiser = "adam";
      settings.deep.learning_rate = "0.002";
      settings.deep.reward_scale = 0.01;
      settings.deep.walkers = 2;
      settings.deep.multi_step = 2;
      settings.deep.replay = 60;
      settings.deep.learning_starts = 10;
      settings.deep.target_every = 500;
      const auto whole = learner(settings, world);
      whole->advance(1400, {});
      auto part = learner(settings, world);
      for (int cut = 0; cut < 100; ++cut) {
        part->advance(14, {});
        auto next = learner(settings, world);
        ASSERT_NO_FATAL_FAILURE(resume(*part, *next));
        part = std::move(next);
      }
      EXPECT_EQ(saved(*part), saved(*whole)) << world.name << " " << munchausen;
    }
  }
}

TEST(Dqn, DistributionsHaveTheRightMean) {
  const World world = adventure();
  for (const Returns returns : {Returns::categorical, Returns::quantile}) {
    LearnSettings settings = network("dqn");
    settings.deep.returns = returns;
    settings.deep.loss = "auto";
    settings.deep.atoms = 21;
    if (returns == Returns::categorical) {
      settings.deep.lowest_return = 0.0;
      settings.deep.highest_return = 1.0;
    }
    settings.deep.reward_scale = 0.01;
    settings.deep.optimiser = "adam";
    settings.deep.learning_rate = "0.02:0.0005:15000";
    const auto one = learner(settings, world);
    one->advance(15'000, {});
    EXPECT_LT(error_of(world, *one), 0.03) << returns_names[static_cast<int>(returns)];
  }
}

// One-step returns, many passes: the table's values, up to the steps that go on for ever.
// A prize of 20 one time in ten is worth 2, not the 0 of nearly always.
TEST(Dqn, FindsTheMeanOfWhatFollows) {
  MdpBuilder builder(0.5);
  builder.move("A", "gamble", "END", 0.0, 0.9).move("A", "gamble", "END", 20.0, 0.1);
  builder.move("A", "sure", "END", 1.0);
  const World world = to_world("prize", *builder.start("A").build());
  LearnSettings settings;
  settings.method = "dqn";
  settings.until_stable = false;
  const auto one = learner(settings, world);
  one->advance(30'000, {});
  const Estimates estimates = one->estimates();
  EXPECT_NEAR(estimates.q[0], 2.0, 0.5);
  EXPECT_NEAR(estimates.q[1], 1.0, 0.25);
}

// The atoms of C51 reach as far as values do, if nobody says.
TEST(Dqn, DistributionsCoverWhatRewardsAllow) {
  LearnSettings settings = network("dqn");
  settings.deep.returns = Returns::categorical;
  settings.deep.hidden = "16";
  settings.deep.optimiser = "adam";
  settings.deep.loss = "auto";
  settings.deep.learning_rate = "0.005";
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(5000, {});
  EXPECT_LT(error_of(world, *one), 0.05);
}

// What a network says of what was never tried is an answer, too; in an end nobody acts.
TEST(Network, ActsWhereNothingWasTried) {
  for (const char* const method : {"dqn", "pqn", "nfq", "stream-q"}) {
    for (const World& world : {adventure(), without_model(slippery(5))}) {
      LearnSettings settings;
      settings.method = method;
      settings.until_stable = false;
      const auto one = learner(settings, world);
      const Estimates estimates = one->estimates();
      const std::vector<Action> policy = greedy_policy(estimates);
      const auto environment = world.make({});
      for (State s = 0; s < policy.size(); ++s) {
        EXPECT_EQ(policy[s] == no_action, environment->actions(s) == 0) << world.name << " " << s;
      }
    }
  }
}

TEST(Pqn, ALinearNetworkFindsTheTable) {
  for (const World& world : {adventure(), corridor(5)}) {
    LearnSettings settings = network("pqn");
    settings.deep.layer_norm = Switch::off;
    settings.deep.learning_rate = "2:0.1:60000";
    settings.deep.return_decay = 0.0;
    const auto one = learner(settings, world);
    one->advance(60'000, {});
    EXPECT_LT(error_of(world, *one), 1e-3) << world.name;
  }
}

// Named outputs reach the table too, where states list other actions in other orders.
TEST(Dqn, OutputsOfNamesFindTheTable) {
  for (const World& world : {adventure(), star(), game()}) {
    for (const char* const method : {"dqn", "nfq", "pqn", "stream-q"}) {
      LearnSettings settings = network(method);
      settings.deep.inputs = Scaling::letters;
      if (settings.method == "dqn") {
        settings.deep.double_q = true;
        settings.deep.train_every = 4;
      } else if (settings.method == "nfq") {
        settings.deep.train_every = 1000;
        settings.deep.fits = 5;
      } else if (settings.method == "pqn") {
        settings.deep.return_decay = 0.0;
      } else {
        settings.deep.optimiser = settings.deep.loss = "auto";
        settings.deep.clip_gradient = -1.0;
      }
      settings.deep.hidden = "32";
      settings.deep.activation = "tanh";
      settings.deep.layer_norm = Switch::off;
      if (settings.method != "stream-q") settings.deep.optimiser = "adam";
      settings.deep.learning_rate = "0.01:0.0001:8000";
      settings.deep.reward_scale = 0.01;
      const auto one = learner(settings, world);
      one->advance(8000, {});
      EXPECT_LT(error_of(world, *one), 0.05) << world.name << ", " << method;
    }
  }
}

// Two who move in turn: values from the mover's view, as the table's.
TEST(Dqn, TakesTurns) {
  const World world = game();
  const auto one = learner(network("dqn"), world);
  one->advance(20'000, {});
  EXPECT_LT(error_of(world, *one), 1e-3);
}

LearnSettings fitted() {
  LearnSettings settings = network("nfq");
  settings.deep.optimiser = "rprop";
  settings.deep.learning_rate = "0.1";
  settings.deep.train_every = 500;
  settings.deep.fits = 10;
  settings.deep.epochs = 40;
  return settings;
}

// What settles within a thousandth of the targets is within a few of Q*.
constexpr double one_in_200 = 0.005;

// Rprop leaves what is not asked as it was, whatever is asked more often.
TEST(Nfq, ALinearNetworkOfOneNumberPerStateFindsTheTable) {
  for (const World& world : {adventure(), star(), corridor(5), game()}) {
    for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::separate}) {
      LearnSettings settings = fitted();
      settings.deep.layout = layout;
      const auto one = learner(settings, world);
      one->advance(1000, {});
      EXPECT_LT(error_of(world, *one), one_in_200) << world.name;
    }
  }
}

TEST(Nfq, ANetworkThatReadsTheActionFindsItToo) {
  LearnSettings settings = fitted();
  settings.deep.layout = NetworkLayout::joint;
  settings.deep.hidden = "32";
  settings.deep.learning_rate = "0.01";
  settings.deep.epochs = 300;
  settings.deep.reward_scale = 0.01;
  const World world = adventure();
  const auto one = learner(settings, world);
  one->advance(1000, {});
  EXPECT_LT(error_of(world, *one), 0.02);
}

// Of one step each, cut off: what follows counts, and what was forgotten does not.
TEST(Nfq, ACutCountsWhatFollows) {
  const World world = adventure();
  LearnSettings settings = fitted();
  settings.episode_steps = 1;
  settings.deep.replay = 400;
  const auto one = learner(settings, world);
  one->advance(1000, {});
  EXPECT_LT(error_of(world, *one), one_in_200);
}

// Fits that nobody wants to wait for are left, saved and gone on with.
TEST(Nfq, GoesOnWithWhatItLeft) {
  const World world = adventure();
  LearnSettings settings = fitted();
  settings.deep.epochs = 7;
  const auto whole = learner(settings, world);
  whole->advance(1200, {});
  auto parts = learner(settings, world);
  std::uint64_t asked = 0, left = 0, steps = 0;
  while (steps < 1200) {
    parts->ask([&] { return ++asked % 5 != 0; });
    const std::uint64_t goal = std::min<std::uint64_t>(1200, steps + 300);
    steps = parts->advance(goal - steps, {}).steps;
    left += steps < goal;
    auto next = learner(settings, world);
    ASSERT_NO_FATAL_FAILURE(resume(*parts, *next));
    parts = std::move(next);
  }
  EXPECT_GT(left, 10u);
  EXPECT_EQ(saved(*parts), saved(*whole));
}

// Rewards of three steps and a third as many fits: as good.
TEST(Nfq, SeveralRewardsComeSooner) {
  double error[2];
  for (const bool several : {false, true}) {
    LearnSettings settings = fitted();
    settings.deep.fits = 2;
    settings.deep.multi_step = several ? 3 : 1;
    const World world = corridor(7, 0.99);
    const auto one = learner(settings, world);
    one->advance(500, {});
    error[several] = error_of(world, *one);
  }
  EXPECT_LT(error[1], error[0]);
}

}  // namespace
}  // namespace quoll
