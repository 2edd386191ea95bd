// Two players who move in turn: the same table is learned from the packed table and from an
// environment that says whose turn comes, and it holds the exact values.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/experiment/evaluation.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/model/builder.hpp"
#include "quoll/model/digest.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

// Nim with one heap: take 1 to 3, whoever takes the last wins 1. V(n) = -1 if 4 divides n, else 1.
World nim(int heap, bool alternating = true) {
  MdpBuilder builder(0.5);
  builder.alternating(alternating);
  for (int n = heap; n > 0; --n) {
    for (int take = 1; take <= 3 && take <= n; ++take) {
      const std::string to = n == take ? "empty" : std::to_string(n - take);
      builder.move(std::to_string(n), "take-" + std::to_string(take), to, n == take ? 1.0 : 0.0);
    }
  }
  builder.start(std::to_string(heap));
  return to_world("nim", *builder.build());
}

Estimates learned(const World& world) {
  LearnSettings settings;
  settings.explore = "uniform";
  const Result<std::unique_ptr<Learner>> learner = make_learner(settings, world);
  EXPECT_TRUE(learner) << message(learner.error());
  if (!learner) return {};
  (*learner)->advance(5'000, {});
  return (*learner)->estimates();
}

TEST(Alternating, NimIsLearnedFromTableAndEnvironment) {
  World world = nim(8);
  EXPECT_EQ(world.traits.players, 2u);
  const Mdp& mdp = *world.mdp;
  const Estimates table = learned(world);
  const std::shared_ptr<const Mdp> kept = world.mdp;
  world.mdp = nullptr;
  const Estimates environment = learned(world);
  // Discount 1/2 per move: 1, 2, 3 stones are worth 1; 4 is -1/2; 5, 6, 7 are 1/4; 8 is -1/8.
  const std::pair<const char*, double> expected[] = {{"1", 1},    {"3", 1},    {"4", -0.5},
                                                     {"5", 0.25}, {"7", 0.25}, {"8", -0.125}};
  for (const auto& [name, value] : expected) {
    const State s = *mdp.find_state(name);
    for (const Estimates* const estimates : {&table, &environment}) {
      double best = -9.0;
      for (std::uint64_t c = estimates->row_begin[s]; c < estimates->row_begin[s + 1]; ++c) {
        best = std::max(best, estimates->q[c]);
      }
      EXPECT_EQ(best, value) << name;
    }
  }
}

TEST(Alternating, StepsSayThatTheTurnPasses) {
  const World world = nim(4);
  const auto environment = world.make({1, 1, 0, nullptr});
  State state = *world.mdp->find_state("4"), next = 0;
  Action action = 0;
  Feedback feedback;
  Experience now{{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, {}, {}};
  environment->step(now);
  EXPECT_TRUE(feedback.turn_passes);
  state = *world.mdp->find_state("1");
  environment->step(now);
  EXPECT_TRUE(feedback.terminated);
  EXPECT_FALSE(feedback.turn_passes);
  EXPECT_EQ(nim(4, false).traits.players, 1u);
}

TEST(Alternating, PlayedReturnsAreTheFirstPlayers) {
  // From 8 by ones: the second player takes the last stone. From 5: the first.
  for (const auto& [heap, mean, discounted] :
       {std::tuple{8, -1.0, -1.0 / 128}, {5, 1.0, 1.0 / 16}}) {
    const World world = nim(heap);
    const std::vector<Action> policy(world.mdp->states(), 0);
    const Played played = play(world, TablePolicy(policy), 3, 1, 0.5, 100);
    EXPECT_EQ(played.mean, mean);
    EXPECT_EQ(played.mean_discounted, discounted);
  }
}

TEST(Alternating, FilesKeepTheFlag) {
  const World world = nim(5);
  for (const Format& format : formats()) {
    if (format.write == nullptr) continue;
    const auto text = format.write(*world.mdp);
    const bool ours = format.name == "toml" || format.name == "csv" || format.name == "umb" ||
                      format.name == "gymnasium";
    EXPECT_EQ(static_cast<bool>(text), ours) << format.name;
    if (!text) continue;  // others know one player only, and say so
    const auto again = parse_model(*text, "nim" + std::string(format.extension));
    ASSERT_TRUE(again) << message(again.error());
    EXPECT_TRUE(again->alternating());
    EXPECT_EQ(digest(*again), digest(*world.mdp)) << format.name;
  }
  EXPECT_NE(digest(*world.mdp), digest(*nim(5, false).mdp));
  EXPECT_FALSE(parse_model("alternating = 1\n", "x.toml"));
  EXPECT_FALSE(parse_model("# alternating = yes\nstate,action,next_state\nA,go,B\n", "x.csv"));
}

}  // namespace
}  // namespace quoll
