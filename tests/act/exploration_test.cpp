// Frequencies over 100,000 draws with fixed seeds. A share p is accepted within 5 standard
// deviations, sqrt(p (1 - p) / 100000): for a right program a fresh seed would fail one check
// in 1.7 million.
#include "quoll/act/exploration.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace quoll {
namespace {

constexpr int draws_made = 100'000;
using Kind = Exploration::Kind;
using Four = std::array<double, 4>;

Exploration kind(Kind of) {
  Exploration exploration;
  exploration.kind = of;
  return exploration;
}

struct Seen {
  Four share{};
  double explored = 0.0;
};

Seen frequencies(const Exploration& exploration, const std::array<float, 4>& q,
                 std::array<std::uint32_t, 4> visits = {}, std::uint64_t step = 0) {
  const FourRows<float> rows;
  Rng rng = stream(7, "behaviour");
  Seen seen;
  for (int i = 0; i < draws_made; ++i) {
    const Chosen chosen = exploration.choose(rows, q.data(), visits.data(), 0,
                                             rows.view(q.data(), 0), ChoiceDraws::of(rng), step);
    seen.share[chosen.action] += 1.0 / draws_made;
    seen.explored += chosen.explored ? 1.0 / draws_made : 0.0;
  }
  return seen;
}

void expect_shares(const Seen& seen, const Four& expected) {
  for (int a = 0; a < 4; ++a) {
    const double sigma = std::sqrt(expected[a] * (1 - expected[a]) / draws_made);
    EXPECT_NEAR(seen.share[a], expected[a], 5 * sigma + 1e-9) << "action " << a;
  }
}

constexpr float no = -std::numeric_limits<float>::infinity();

TEST(Exploration, TakesTwoDrawsWhateverItDoes) {
  Rng rng = stream(1, "behaviour"), other = rng;
  const ChoiceDraws draws = ChoiceDraws::of(rng);
  const std::uint64_t first = other.next(), second = other.next();
  EXPECT_EQ(rng.state, other.state);
  EXPECT_EQ(draws.coin(), first >> 32);
  EXPECT_EQ(draws.action(), first & 0xffffffff);
  EXPECT_EQ(draws.tie(), second >> 32);
  EXPECT_EQ(draws.rounding(), second & 0xffffffff);
}

TEST(Exploration, UniformTakesEachLegalActionEqually) {
  const Seen seen = frequencies(kind(Kind::uniform), {5, 1, 1, no});
  expect_shares(seen, {1.0 / 3, 1.0 / 3, 1.0 / 3, 0});
  EXPECT_NEAR(seen.explored, 1.0, 1e-9);
}

TEST(Exploration, GreedyBreaksTiesUniformlyOrByTheLowestIndex) {
  Exploration greedy = kind(Kind::greedy);
  expect_shares(frequencies(greedy, {1, 3, 3, 3}), {0, 1.0 / 3, 1.0 / 3, 1.0 / 3});
  EXPECT_EQ(frequencies(greedy, {1, 3, 3, 3}).explored, 0.0);
  greedy.first_tie = true;
  expect_shares(frequencies(greedy, {1, 3, 3, 3}), {0, 1, 0, 0});
}

// epsilon 0.2 over 4 actions: 0.8 + 0.05 for the best, 0.05 for the others.
TEST(Exploration, EpsilonGreedyMixesBoth) {
  Exploration mixed = kind(Kind::epsilon_greedy);
  mixed.epsilon = {0.2, 0.2, 0};
  const Seen seen = frequencies(mixed, {0, 0, 1, 0});
  expect_shares(seen, {0.05, 0.05, 0.85, 0.05});
  EXPECT_NEAR(seen.explored, 0.2, 5 * std::sqrt(0.16 / draws_made));
}

TEST(Exploration, EpsilonFollowsItsScheduleToNeverAndAlways) {
  Exploration mixed = kind(Kind::epsilon_greedy);
  mixed.epsilon = {1.0, 0.0, 100};
  expect_shares(frequencies(mixed, {0, 0, 1, 0}, {}, 0), {0.25, 0.25, 0.25, 0.25});
  expect_shares(frequencies(mixed, {0, 0, 1, 0}, {}, 100), {0, 0, 1, 0});
}

// Q = 0, ln 2, ln 4 at temperature 1: weights 1 : 2 : 4, shares 1/7, 2/7, 4/7.
TEST(Exploration, SoftmaxIsProportionalToTheExponential) {
  Exploration soft = kind(Kind::softmax);
  soft.temperature = {1, 1, 0};
  const float ln2 = 0.6931472f;
  expect_shares(frequencies(soft, {0, ln2, 2 * ln2, no}), {1.0 / 7, 2.0 / 7, 4.0 / 7, 0});
}

TEST(Exploration, SoftmaxSurvivesHugeValuesAndTinyTemperatures) {
  Exploration soft = kind(Kind::softmax);
  soft.temperature = {1e-9, 1e-9, 0};
  expect_shares(frequencies(soft, {-1e30f, 1e30f, 0, 1e30f}), {0, 0.5, 0, 0.5});
}

TEST(Exploration, UcbTriesTheUntriedFirst) {
  Exploration ucb = kind(Kind::ucb);
  expect_shares(frequencies(ucb, {9, 0, 9, 0}, {5, 0, 7, 0}), {0, 0.5, 0, 0.5});
  ucb.first_tie = true;
  expect_shares(frequencies(ucb, {9, 0, 9, 0}, {5, 0, 7, 0}), {0, 1, 0, 0});
}

// N = 16, c * span = 2, ln 16 = 2.7726. Bonus of n visits: 2 sqrt(2.7726 / n): n = 1: 3.330, n =
// 4: 1.665, n = 10: 1.053. Scores: 0 + 3.330; 1 + 1.665; 2.2 + 1.053 = 3.253; so action 0 by 0.077.
TEST(Exploration, UcbAddsTheBonusOfRareness) {
  Exploration ucb = kind(Kind::ucb);
  ucb.ucb_scale = 2.0;
  expect_shares(frequencies(ucb, {0, 1, 2.2f, no}, {1, 5, 10, 0}), {1, 0, 0, 0});
  // With 2.3 the score of action 2 is 3.353 > 3.330.
  expect_shares(frequencies(ucb, {0, 1, 2.3f, no}, {1, 5, 10, 0}), {0, 0, 1, 0});
  // Equal values and visits tie uniformly.
  expect_shares(frequencies(ucb, {1, 1, 1, 1}, {3, 3, 3, 4}), {1.0 / 3, 1.0 / 3, 1.0 / 3, 0});
}

TEST(Exploration, CountBonusTriesTheUntriedFirst) {
  Exploration bonus = kind(Kind::count_bonus);
  expect_shares(frequencies(bonus, {9, 0, 9, 0}, {5, 0, 7, 0}), {0, 0.5, 0, 0.5});
  EXPECT_NEAR(frequencies(bonus, {9, 0, 9, 0}, {5, 0, 7, 0}).explored, 1.0, 1e-9);
}

// c * span = 2: 0 + 2/1 = 2; 1 + 2/2 = 2; 1.5 + 2/5 = 1.9. The first two tie.
TEST(Exploration, CountBonusFallsWithTheRootOfTheVisits) {
  Exploration bonus = kind(Kind::count_bonus);
  bonus.count_scale = 2.0;
  expect_shares(frequencies(bonus, {0, 1, 1.5f, no}, {1, 4, 25, 0}), {0.5, 0.5, 0, 0});
  // Fewer visits of the third: 1.5 + 2/3 = 2.17.
  expect_shares(frequencies(bonus, {0, 1, 1.5f, no}, {1, 4, 9, 0}), {0, 0, 1, 0});
  bonus.first_tie = true;
  expect_shares(frequencies(bonus, {0, 1, 1.5f, no}, {1, 4, 25, 0}), {1, 0, 0, 0});
}

// Q = 0 and 1, omega = ln 4: mm = ln((1 + 4) / 2) / ln 4 = ln 2.5 / ln 4 = 0.660964. The mean of
// the policy is to be mm, and with two actions that is the share of the better one.
TEST(Exploration, MellowmaxHasItsOwnMean) {
  Exploration mellow = kind(Kind::mellowmax);
  mellow.omega = std::log(4.0);
  expect_shares(frequencies(mellow, {0, 1, no, no}), {1 - 0.660964, 0.660964, 0, 0});
  // Shifted and scaled, with omega to match, it stays the same.
  mellow.omega = std::log(4.0) / 8;
  expect_shares(frequencies(mellow, {-16, -8, no, no}), {1 - 0.660964, 0.660964, 0, 0});
}

// Of all policies with mean mm the one of largest entropy is Boltzmann's: log shares are linear in
// Q. Q = 0, 1, 3, omega = 1: mm = ln((1 + e + e^3) / 3) = ln 7.934605 = 2.071234.
TEST(Exploration, MellowmaxIsBoltzmannWithThatMean) {
  Exploration mellow = kind(Kind::mellowmax);
  mellow.omega = 1.0;
  const std::array<float, 4> q{0, 1, 3, no};
  Four share{};
  const FourRows<float> rows;
  const std::uint32_t visits[4] = {};
  mellow.probabilities(rows, q.data(), visits, 0, rows.view(q.data(), 0), 0, share.data());
  EXPECT_NEAR(share[0] + share[1] + share[2], 1.0, 1e-12);
  EXPECT_NEAR(share[1] + 3 * share[2], std::log((1 + std::exp(1) + std::exp(3)) / 3), 1e-8);
  EXPECT_NEAR(std::log(share[2] / share[0]), 3 * std::log(share[1] / share[0]), 1e-9);
}

TEST(Exploration, MellowmaxOfEqualAndOfFarValues) {
  Exploration mellow = kind(Kind::mellowmax);
  mellow.omega = 5.0;
  expect_shares(frequencies(mellow, {2, 2, 2, no}), {1.0 / 3, 1.0 / 3, 1.0 / 3, 0});
  expect_shares(frequencies(mellow, {7, no, no, no}), {1, 0, 0, 0});
  expect_shares(frequencies(mellow, {-1e30f, 1e30f, -1e30f, no}), {0, 1, 0, 0});
  mellow.omega = 1e-6;  // the plain mean: chance
  expect_shares(frequencies(mellow, {0, 1, 2, 3}), {0.25, 0.25, 0.25, 0.25});
}

// What probabilities() says is what choose() does: every kind, values that differ and that tie.
TEST(Exploration, ProbabilitiesAreTheFrequencies) {
  const FourRows<float> rows;
  for (std::size_t of = 0; of < std::size(exploration_names); ++of) {
    for (const bool first_tie : {false, true}) {
      Exploration one = kind(static_cast<Kind>(of));
      one.first_tie = first_tie;
      one.epsilon = {0.5, 0.25, 10};
      one.temperature = {4, 2, 10};
      one.omega = 0.5;
      const std::array<std::array<float, 4>, 3> tables = {
          {{1, 3, 3, 2}, {0, 0, 0, no}, {-1, 2, no, no}}};
      const std::array<std::array<std::uint32_t, 4>, 3> counts = {
          {{4, 4, 4, 9}, {3, 0, 0, 0}, {1, 50, 0, 0}}};
      for (std::size_t i = 0; i < tables.size(); ++i) {
        Four share{};
        one.probabilities(rows, tables[i].data(), counts[i].data(), 0,
                          rows.view(tables[i].data(), 0), 5, share.data());
        expect_shares(frequencies(one, tables[i], counts[i], 5), share);
        EXPECT_NEAR(share[0] + share[1] + share[2] + share[3], 1.0, 1e-12) << exploration_names[of];
      }
    }
  }
}

}  // namespace
}  // namespace quoll
