#include "quoll/env/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "quoll/env/mdp_environment.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

Mdp fork(double left, double middle, double right) {
  MdpBuilder builder(0.9);
  builder.move("A", "go", "L", 1, left).move("A", "go", "M", 2, middle);
  builder.move("A", "go", "R", 3, right).move("L", "back", "A").move("M", "back", "A");
  return *builder.build();
}

TEST(Table, ADeterministicMoveIsItsSuccessorEndAndReward) {
  MdpBuilder builder(0.9);
  builder.move("A", "stay", "A", -1).move("A", "go", "END", 2.5);
  const Mdp mdp = *builder.build();
  for (const PairLayout layout : {PairLayout{0, mdp.choices()}, PairLayout{4, mdp.states() * 4}}) {
    const auto table = deterministic_table<float>(mdp, layout);
    const auto stay = table.view().step(layout.pair(mdp, 0, 0), 0);
    EXPECT_EQ(stay.next, 0u);
    EXPECT_EQ(stay.reward, -1.0f);
    EXPECT_FALSE(stay.terminated);
    const auto go = table.view().step(layout.pair(mdp, 0, 1), 0);
    EXPECT_EQ(go.next, 1u);
    EXPECT_EQ(go.reward, 2.5f);
    EXPECT_TRUE(go.terminated);
  }
}

// Halves are exact: draws up to 2^63 - 1 go left, the others right.
TEST(Table, ThresholdsAreInclusiveAndExact) {
  MdpBuilder builder(0.9);
  builder.move("A", "go", "L", 1, 0.5).move("A", "go", "R", 2, 0.5);
  const Mdp mdp = *builder.build();
  const auto table = stochastic_table<double>(mdp, {0, mdp.choices()});
  constexpr std::uint64_t half = std::uint64_t{1} << 63;
  EXPECT_EQ(table.view().step(0, 0).reward, 1.0);
  EXPECT_EQ(table.view().step(0, half - 1).reward, 1.0);
  EXPECT_EQ(table.view().step(0, half).reward, 2.0);
  EXPECT_EQ(table.view().step(0, ~std::uint64_t{0}).reward, 2.0);
}

// 200,000 draws; each share within 5 standard deviations (false alarm below one in 1.7 million).
TEST(Table, SteppedFrequenciesAreTheProbabilities) {
  const Mdp mdp = fork(0.125, 0.375, 0.5);
  const PairLayout layout{4, mdp.states() * 4};
  const auto table = stochastic_table<float>(mdp, layout);
  Rng rng = stream(1, "world");
  std::map<float, double> share;
  constexpr int draws = 200'000;
  for (int i = 0; i < draws; ++i) share[table.view().step(0, rng.next()).reward] += 1.0 / draws;
  const std::map<float, double> expected{{1.0f, 0.125}, {2.0f, 0.375}, {3.0f, 0.5}};
  ASSERT_EQ(share.size(), 3u);
  for (const auto& [reward, p] : expected) {
    EXPECT_NEAR(share[reward], p, 5 * std::sqrt(p * (1 - p) / draws));
  }
}

TEST(Table, ARowThatSumsToALittleLessThanOneNeverFallsOff) {
  const Mdp mdp = fork(0.3, 0.3, 0.3999999999);
  const auto table = stochastic_table<float>(mdp, {0, mdp.choices()});
  const std::uint64_t last = ~std::uint64_t{0};
  for (std::uint64_t below = 0; below < 1000; ++below) {
    EXPECT_EQ(table.view().step(0, last - below).reward, 3.0f);
  }
}

TEST(Table, ARowThatSumsToALittleMoreThanOneKeepsItsOutcomes) {
  const Mdp mdp = fork(0.5, 0.5000000001, 0.0);
  const auto table = stochastic_table<float>(mdp, {0, mdp.choices()});
  EXPECT_EQ(table.view().step(0, 0).reward, 1.0f);
  EXPECT_EQ(table.view().step(0, ~std::uint64_t{0}).reward, 2.0f);
}

// 100 outcomes of 1/100: outcome i takes the draws of [i/100, (i+1)/100). The middle of each is
// tried.
TEST(Table, LongRowsAreSearchedByHalves) {
  MdpBuilder builder(0.9);
  for (int i = 0; i < 100; ++i) builder.move("A", "go", "s" + std::to_string(i), i, 0.01);
  const Mdp mdp = *builder.build();
  const auto table = stochastic_table<double>(mdp, {0, mdp.choices()});
  for (int i = 0; i < 100; ++i) {
    const auto draw = static_cast<std::uint64_t>((i + 0.5) / 100 * 0x1p64);
    EXPECT_EQ(table.view().step(0, draw).reward, i);
  }
}

TEST(Table, RowsArePaddedOnlyWhereThatIsCheap) {
  EXPECT_EQ(pair_layout(fork(0.2, 0.3, 0.5)).width, 4u);
  MdpBuilder five(0.9);
  for (int a = 0; a < 5; ++a) five.move("A", "a" + std::to_string(a), "END");
  EXPECT_EQ(pair_layout(*five.build()).width, 0u);
  MdpBuilder corridor(
      0.9);  // one action in each of 100 states: padding would take four times as much
  for (int i = 0; i < 100; ++i) {
    corridor.move("s" + std::to_string(i), "on", "s" + std::to_string(i + 1));
  }
  EXPECT_EQ(pair_layout(*corridor.build()).width, 0u);
}

struct Lane {
  State state = 0, next = 0;
  Action action = 0;
  Feedback feedback;
  Experience columns() { return {{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, {}, {}}; }
};

TEST(MdpEnvironment, DrawsLikeTheTable) {
  const auto mdp = std::make_shared<const Mdp>(fork(0.2, 0.3, 0.5));
  const auto table = stochastic_table<double>(*mdp, {0, mdp->choices()});
  const auto environment = mdp_environments(mdp)({1, 9, 0, nullptr});
  Rng rng = stream(9, "world");
  Lane lane;
  for (int i = 0; i < 1000; ++i) {
    lane.state = 0;
    Experience now = lane.columns();
    environment->step(now);
    const auto landing = table.view().step(0, rng.next());
    ASSERT_EQ(lane.next, landing.next);
    ASSERT_EQ(lane.feedback.reward, landing.reward);
    ASSERT_EQ(lane.feedback.terminated, landing.terminated);
  }
}

TEST(MdpEnvironment, SaysHowManyActionsAStateHas) {
  const auto mdp = std::make_shared<const Mdp>(fork(0.2, 0.3, 0.5));
  const auto environment = mdp_environments(mdp)({});
  EXPECT_EQ(environment->actions(*mdp->find_state("L")), 1u);
  EXPECT_EQ(environment->actions(*mdp->find_state("R")), 0u);
}

TEST(MdpEnvironment, InAnEndNothingHappensButTheDraw) {
  const auto mdp = std::make_shared<const Mdp>(fork(0.2, 0.3, 0.5));
  const auto left = mdp_environments(mdp)({}), right = mdp_environments(mdp)({});
  Lane a, b;
  a.state = *mdp->find_state("R");
  Experience now = a.columns();
  left->step(now);
  EXPECT_EQ(a.next, a.state);
  EXPECT_TRUE(a.feedback.terminated);
  EXPECT_EQ(a.feedback.reward, 0.0);
  now = b.columns();
  right->step(now);
  for (int i = 0; i < 20; ++i) {
    a.state = b.state = 0;
    now = a.columns();
    left->step(now);
    Experience other = b.columns();
    right->step(other);
    EXPECT_EQ(a.next, b.next);
  }
}

TEST(MdpEnvironment, EnvironmentsOfOneMakerShareTheModelAndNothingElse) {
  const auto mdp = std::make_shared<const Mdp>(fork(0.2, 0.3, 0.5));
  const auto make = mdp_environments(mdp, {}, 3);
  const auto one = make({1, 9, 0, nullptr}), other = make({1, 9, 0, nullptr});
  const auto alone = mdp_environments(mdp)({1, 9, 3, nullptr});
  Lane a, b, c;
  for (int i = 0; i < 100; ++i) {
    a.state = b.state = c.state = 0;
    Experience now = a.columns();
    one->step(now);
    now = b.columns();
    alone->step(now);
    ASSERT_EQ(a.next, b.next);
    ASSERT_EQ(a.feedback.truncated, i == 2);  // the limit of the maker
    ASSERT_EQ(b.feedback.truncated, i == 2);
    if (i % 2 == 1) continue;
    now = c.columns();
    other->step(now);  // takes draws of its own
  }
}

}  // namespace
}  // namespace quoll
