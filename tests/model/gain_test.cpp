#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/builder.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {
namespace {

Mdp built(const MdpBuilder& builder) {
  auto mdp = builder.build();
  EXPECT_TRUE(mdp) << message(mdp.error());
  return *std::move(mdp);
}

// A earns 2 and goes to B half the time, B pays to come back: A two thirds of the time, so the gain
// is (2 * 2 - cost) / 3 per move. C belongs to the component but not to what gains.
Mdp coin_and_cost(double cost) {
  MdpBuilder builder(1.0);
  builder.move("A", "coin", "A", 2.0, 0.5).move("A", "coin", "B", 2.0, 0.5);
  builder.move("A", "out", "END", 0.0).move("A", "aside", "C", -1.0).move("C", "on", "A", -1.0);
  builder.move("B", "back", "A", -cost);
  return built(builder);
}

TEST(Undiscounted, MixedSignsThatGain) {
  const Mdp mdp = coin_and_cost(1.0);
  const UndiscountedFault fault = undiscounted_fault(mdp);
  EXPECT_EQ(fault.kind, UndiscountedFault::Kind::gaining_cycle);
  EXPECT_EQ(fault.states, (std::vector<State>{*mdp.find_state("A"), *mdp.find_state("B")}));
  EXPECT_EQ(undiscounted_fault(coin_and_cost(3.99)).kind, UndiscountedFault::Kind::gaining_cycle);
}

TEST(Undiscounted, MixedSignsWithoutGain) {
  EXPECT_EQ(undiscounted_fault(coin_and_cost(4.0)).kind, UndiscountedFault::Kind::none);
  EXPECT_EQ(undiscounted_fault(coin_and_cost(4.01)).kind, UndiscountedFault::Kind::none);
}

// With p and q the chances to change over, A holds q / (p + q) of the time: the gain of a policy is
// (q r + p s) / (p + q). Rewards in quarters and chances in eighths: no gain lies near 0 but 0.
TEST(Undiscounted, GainsAgreeWithAllPoliciesOfTwoStates) {
  Rng rng = stream(4, "graph");
  int certain = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    MdpBuilder builder(1.0);
    std::vector<std::pair<double, double>> options[2];  // chance, reward
    for (int s = 0; s < 2; ++s) {
      const std::string from = s == 0 ? "A" : "B";
      const std::string to = s == 0 ? "B" : "A";
      for (std::uint64_t a = 0, count = 1 + rng.below(3); a < count; ++a) {
        const double chance = (1.0 + static_cast<double>(rng.below(8))) / 8.0;
        const double reward = 0.25 * (static_cast<double>(rng.below(9)) - 5.0);
        options[s].push_back({chance, reward});
        const std::string action = std::to_string(a);
        builder.move(from, action, to, reward, chance);
        if (chance < 1.0) builder.move(from, action, from, reward, 1.0 - chance);
      }
    }
    builder.move("A", "out", "END");
    builder.move("A", "maybe", "END", -1.0, 0.5).move("A", "maybe", "A", -1.0, 0.5);
    double best = -10.0;
    for (const auto& [p, r] : options[0]) {
      for (const auto& [q, s] : options[1]) best = std::max(best, (q * r + p * s) / (p + q));
    }
    const Mdp mdp = built(builder);
    const EndComponents parts = maximal_end_components(mdp);
    ASSERT_EQ(parts.count, 1u);
    const bool gains = best > 1e-9;
    ASSERT_EQ(component_gains(mdp, parts)[0] == Gain::certain, gains) << trial << " " << best;
    ASSERT_EQ(undiscounted_fault(mdp).kind == UndiscountedFault::Kind::gaining_cycle, gains);
    certain += gains;
  }
  EXPECT_GT(certain, 100);
  EXPECT_LT(certain, 900);
}

// To and fro over A earns 5 every other move and pays 1 for each: slipping does not stop that.
TEST(Undiscounted, ASlipperyGridWithARewardToReturnTo) {
  Grid grid;
  grid.rows = {"S..#", ".#.P", "..AG"};
  grid.slip = 0.2;
  grid.reward['A'] = 5.0;
  const auto mdp = to_mdp(grid);
  ASSERT_TRUE(mdp) << message(mdp.error());
  ASSERT_EQ(mdp->discount(), 1.0);
  EXPECT_EQ(undiscounted_fault(*mdp).kind, UndiscountedFault::Kind::gaining_cycle);
  grid.reward['A'] = 0.0;
  EXPECT_EQ(undiscounted_fault(*to_mdp(grid)).kind, UndiscountedFault::Kind::none);
}

TEST(Undiscounted, MarksWhatComesToAGainNobodyReaches) {
  // U gains by its coin or by its move to itself; V leads there; W does not, nor do S and the end.
  for (const bool coin : {false, true}) {
    MdpBuilder builder(1.0);
    for (const char* name : {"S", "U", "V", "W"}) builder.state(name);
    builder.move("S", "go", "END", 1.0).move("U", "out", "S").move("W", "go", "S", 3.0);
    builder.move("U", "stay", "U", 2.0, coin ? 0.5 : 1.0);
    if (coin) builder.move("U", "stay", "V", 2.0, 0.5);
    builder.move("V", "go", "U", -1.0).start("S");
    const Mdp mdp = built(builder);
    EXPECT_EQ(undiscounted_fault(mdp).kind, UndiscountedFault::Kind::none);
    EXPECT_EQ(may_gain_for_ever(mdp), (std::vector<bool>{false, true, true, false, false}));
  }
}

}  // namespace
}  // namespace quoll
