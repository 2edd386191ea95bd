// Networks that are taught a table: what they reach, and how it is counted.

#include "quoll/learn/deep/distil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "../resume.hpp"
#include "../worlds.hpp"
#include "quoll/learn/deep/name_letters.hpp"
#include "quoll/solve/optimality.hpp"
#include "quoll/solve/solver.hpp"

namespace quoll {
namespace {

using namespace learn_tests;

// Q* of every pair.
Estimates solved(const World& world) {
  const Mdp& mdp = *world.mdp;
  SolveSettings exactly;
  exactly.discount = world.discount;
  const Solution best = *solve(mdp, exactly);
  Estimates table;
  table.row_begin = mdp.arrays().choice_begin;
  for (std::uint64_t c = 0; c < mdp.choices(); ++c) {
    table.q.push_back(q_star(mdp, best.upper, c, world.discount));
    table.visits.push_back(1);
  }
  return table;
}

LearnSettings fit(const Estimates& table, std::string hidden, std::uint64_t steps) {
  LearnSettings settings;
  settings.method = "distil";
  settings.until_stable = false;
  settings.deep.hidden = std::move(hidden);
  settings.deep.learning_rate = "0.01:0:" + std::to_string(steps);
  settings.deep.reward_scale = scale_of(table);
  return settings;
}

std::unique_ptr<Learner> taught(const LearnSettings& settings, const World& world,
                                const Estimates& table, double share = 1.0) {
  auto one = learner(settings, world);
  teach(*one, table, share);
  return one;
}

double largest_error(const Estimates& table, const Estimates& q) {
  double largest = 0.0;
  for (std::size_t c = 0; c < table.q.size(); ++c) {
    if (table.visits[c] > 0) largest = std::max(largest, std::fabs(q.q[c] - table.q[c]));
  }
  return largest;
}

TEST(Distil, ALinearNetworkOfOneNumberPerStateIsTheTable) {
  const World world = adventure();
  const Estimates table = solved(world);
  for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::separate}) {
    LearnSettings settings = fit(table, "none", 10'000);
    settings.deep.layout = layout;
    const auto one = taught(settings, world, table);
    one->advance(10'000, {});
    // Floats near 100 lie 7.6e-6 apart.
    EXPECT_LT(largest_error(table, one->estimates()), 1e-5);
  }
}

double mean_error(const Estimates& table, const Estimates& q) {
  double sum = 0.0, count = 0.0;
  for (std::size_t c = 0; c < table.q.size(); ++c) {
    if (table.visits[c] == 0) continue;
    sum += std::fabs(q.q[c] - table.q[c]);
    ++count;
  }
  return sum / count;
}

// And where Q fits, whatever stands in the table where nothing was tried.
TEST(Distil, EveryLayoutStopsWhereEveryGreedyActionIsRight) {
  for (const World& world : {adventure(), star(), corridor(7)}) {
    Estimates table = solved(world);
    table.visits[1] = 0;
    table.q[1] = 1e9;
    for (int which = 0; which < 6; ++which) {
      LearnSettings settings = fit(table, "24", 20'000);
      settings.deep.layout = static_cast<NetworkLayout>(which % 3);
      if (which >= 3) settings.deep.inputs = Scaling::letters;
      settings.until_stable = true;
      const auto one = taught(settings, world, table);
      const LearnProgress now = one->advance(20'000, {});
      EXPECT_EQ(now.halt, LearnProgress::Halt::stable) << world.name;
      EXPECT_LT(now.steps, 20'000u);
      const Estimates q = one->estimates();
      for (const std::optional<bool> right : agreement(table, q)) {
        EXPECT_TRUE(right.value_or(true)) << world.name;
      }
      EXPECT_LE(mean_error(table, q), 0.0201 / settings.deep.reward_scale) << world.name;
    }
  }
}

// A network would say something of every state; what the table knows nothing of stays a gap.
TEST(Distil, GapsOfTheTableStayGaps) {
  const World world = corridor(4);
  Estimates table = solved(world);
  table.visits[4] = table.visits[5] = 0;
  const auto one = taught(fit(table, "8", 500), world, table);
  one->advance(500, {});
  const std::vector<Action> policy = greedy_policy(one->estimates());
  for (State s = 0; s < 4; ++s) EXPECT_EQ(policy[s], s == 2 ? no_action : 1u) << s;
}

TEST(Distil, IsContinuedBitForBit) {
  const World world = star();
  const Estimates table = solved(world);
  LearnSettings settings = fit(table, "8", 500);
  settings.deep.batch = 4;
  const auto whole = taught(settings, world, table, 0.7);
  whole->advance(500, {});
  for (const std::uint64_t cut : {0u, 1u, 77u, 499u}) {
    const auto first = taught(settings, world, table, 0.7);
    first->advance(cut, {});
    const auto second = learner(settings, world);
    ASSERT_NO_FATAL_FAILURE(resume(*first, *second));
    second->advance(500 - cut, {});
    EXPECT_EQ(saved(*second), saved(*whole)) << cut;
  }
}

// With a network of its own number for each pair, what is withheld stays as it began.
TEST(Distil, TeachesTheShareOnly) {
  const World world = corridor(10);
  const Estimates table = solved(world);
  LearnSettings settings = fit(table, "none", 3000);
  std::vector<std::vector<std::uint8_t>> drawn;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    settings.seed = seed;
    const auto one = taught(settings, world, table, 0.45);
    drawn.push_back(withheld(*one));
    std::size_t kept = 0;
    for (const std::uint8_t state : drawn.back()) kept += state;
    EXPECT_EQ(kept, 5u);  // ceil(0.45 * 10) are taught
    one->advance(3000, {});
    const Estimates q = one->estimates();
    double taught_error = 0.0, withheld_error = 0.0;
    for (State s = 0; s < 10; ++s) {
      for (std::uint64_t c = table.row_begin[s]; c < table.row_begin[s + 1]; ++c) {
        double& worst = drawn.back()[s] != 0 ? withheld_error : taught_error;
        worst = std::max(worst, std::fabs(q.q[c] - table.q[c]));
      }
    }
    EXPECT_LT(taught_error, 1e-5);
    EXPECT_GT(withheld_error, 0.01);
  }
  EXPECT_TRUE(drawn[0] != drawn[1] || drawn[1] != drawn[2]);
}

TEST(Distil, CountsTiesAndLeavesOutWhatWasNotVisited) {
  Estimates table, q;
  table.row_begin = q.row_begin = {0, 3, 5, 5, 7, 9};
  table.q = {1, 2, 2, 5, 9, 0, 0, -1, -1 - 1e-12};
  table.visits = {1, 1, 1, 1, 0, 0, 0, 1, 1};
  q.visits = table.visits;
  q.q = {0, 1, 3, 1, 100, 0, 0, 0, 1};
  const std::vector<std::optional<bool>> expected{true, true, std::nullopt, std::nullopt, true};
  EXPECT_EQ(agreement(table, q), expected);
  q.q[0] = 3;  // the first of two
  EXPECT_EQ(agreement(table, q)[0], false);
}

TEST(Distil, ScalesByPowersOfTwo) {
  Estimates table;
  table.q = {100, -64, 4096};
  table.visits = {1, 1, 0};
  EXPECT_EQ(scale_of(table), 1.0 / 128);
  table.q = {0.25, -0.3, 1};
  EXPECT_EQ(scale_of(table), 2.0);
  table.q = {0, 0, 1};
  EXPECT_EQ(scale_of(table), 1.0);
}

TEST(Distil, IsNoMethodThatIsOffered) {
  LearnSettings settings;
  settings.method = "distil";
  EXPECT_TRUE(find_learner(settings));
  ASSERT_FALSE(find_offered(settings));
  for (const LearnerEntry& entry : learners()) EXPECT_NE(entry.method, "distil");
  // Without a table there is nothing to do, and it says so.
  settings.until_stable = false;
  const auto one = learner(settings, adventure());
  EXPECT_EQ(one->advance(10, {}).halt, LearnProgress::Halt::stable);
}

// Names "...": three letters at nine places, and who moves.
TEST(NameLetters, ReadsABoard) {
  const World world = *find_world("tic-tac-toe");
  const auto letters = *NameLetters::make(world, world.make({})->spaces());
  EXPECT_EQ(letters->size(), 29u);
  EXPECT_EQ(letters->of(0).size(), 10u);
}

// Every square has an output, whichever squares are free.
TEST(NameLetters, AnActionHasItsOutputWhereverItIsListed) {
  const World world = *find_world("tic-tac-toe");
  const Mdp& mdp = *world.mdp;
  const auto letters = *NameLetters::make(world, world.make({})->spaces());
  EXPECT_EQ(letters->outputs(), 9u);
  std::map<std::string, Action> squares;
  for (State s = 0; s < mdp.states(); ++s) {
    for (Action a = 0; a < mdp.actions(s); ++a) {
      const std::string name = mdp.action_name(mdp.choice_begin(s) + a);
      const Action output = letters->output(s, a);
      EXPECT_LT(output, 9u);
      EXPECT_EQ(squares.emplace(name, output).first->second, output) << name;
    }
    EXPECT_TRUE(!mdp.terminal(s) || letters->output(s, 4) == 4u);
  }
  EXPECT_EQ(squares.size(), 9u);
}

// What is said of an action in one state is of use in others: a board that was never taught is
// played well far more often than by chance (49 %) or by a network that numbers the free squares.
TEST(NameLetters, TellOfStatesThatWereNeverTaught) {
  const World world = *find_world("tic-tac-toe");
  const Estimates table = solved(world);
  LearnSettings settings = fit(table, "64", 2000);
  settings.deep.inputs = Scaling::letters;
  settings.deep.learning_rate = "0.003";
  for (const NetworkLayout layout : {NetworkLayout::shared, NetworkLayout::joint}) {
    settings.deep.layout = layout;
    const auto one = taught(settings, world, table, 0.5);
    one->advance(2000, {});
    const std::vector<std::optional<bool>> agrees = agreement(table, one->estimates());
    int untaught = 0, optimal = 0;
    for (State s = 0; s < agrees.size(); ++s) {
      if (!agrees[s] || withheld(*one)[s] == 0) continue;
      ++untaught;
      optimal += *agrees[s];
    }
    EXPECT_EQ(untaught, 2260);
    EXPECT_GT(optimal, 0.85 * untaught);
  }
}

TEST(NameLetters, TellsShortNamesFromLongOnes) {
  // c0 ... c10: "c", "0".."9", "0" or nothing.
  const World world = corridor(11);
  const auto letters = *NameLetters::make(world, world.make({})->spaces());
  EXPECT_EQ(letters->size(), 10u + 1);
  EXPECT_EQ(letters->of(*world.mdp->find_state("c1")).size(), 1u);
  EXPECT_EQ(letters->of(*world.mdp->find_state("c10")).size(), 2u);
  const World numbers = *find_world("cartpole");
  EXPECT_FALSE(NameLetters::make(numbers, numbers.make({})->spaces()));
}

}  // namespace
}  // namespace quoll
