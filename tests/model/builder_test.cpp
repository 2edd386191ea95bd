#include "quoll/model/builder.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

TEST(MdpBuilder, OrdersByFirstMention) {
  MdpBuilder builder(0.9);
  builder.move("B", "right", "C", 1.0);
  builder.move("A", "left", "B");
  builder.move("B", "left", "A", 2.0);
  builder.move("A", "right", "C", 3.0);
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp) << message(mdp.error());
  ASSERT_EQ(mdp->states(), 3u);
  EXPECT_EQ(mdp->state_name(0), "B");
  EXPECT_EQ(mdp->state_name(1), "C");
  EXPECT_EQ(mdp->state_name(2), "A");
  EXPECT_TRUE(mdp->deterministic());
  EXPECT_EQ(mdp->discount(), 0.9);
  // B: right, left; A: left, right.
  EXPECT_EQ(mdp->action_name(0), "right");
  EXPECT_EQ(mdp->action_name(1), "left");
  EXPECT_EQ(mdp->action_name(2), "left");
  EXPECT_EQ(mdp->action_name(3), "right");
  EXPECT_EQ(mdp->reward(0), 1.0);
  EXPECT_EQ(mdp->reward(1), 2.0);
  EXPECT_EQ(mdp->next(2), 0u);
  EXPECT_EQ(mdp->next(3), 1u);
  // Uniform over A and B.
  ASSERT_EQ(mdp->start().size(), 2u);
  EXPECT_EQ(mdp->start()[1], 2u);
  EXPECT_EQ(mdp->start_probability(0), 0.5);
}

TEST(MdpBuilder, GathersAndJoinsOutcomesInAnyOrder) {
  MdpBuilder builder(1.0);
  builder.move("A", "go", "A", 0.0, 0.25);
  builder.move("A", "stay", "A");
  builder.move("A", "go", "B", 8.0, 0.25);
  builder.move("A", "go", "A", 0.0, 0.125);
  builder.move("A", "go", "B", 4.0, 0.25);  // another reward: another outcome
  builder.move("A", "go", "B", 8.0, 0.125);
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp) << message(mdp.error());
  ASSERT_EQ(mdp->choices(), 2u);
  ASSERT_EQ(mdp->outcome_end(0), 3u);
  EXPECT_EQ(mdp->probability(0), 0.375);
  EXPECT_EQ(mdp->probability(1), 0.375);
  EXPECT_EQ(mdp->probability(2), 0.25);
  EXPECT_EQ(mdp->reward(0, 1), 8.0);
  EXPECT_EQ(mdp->reward(0, 2), 4.0);
  EXPECT_EQ(mdp->reward(0), 4.0);  // 0.375 * 8 + 0.25 * 4
}

TEST(MdpBuilder, ReportsARowThatDoesNotSumToOne) {
  MdpBuilder builder(0.9);
  builder.move("HALL", "To-CAVE", "CAVE", 0.0, 0.9);
  const auto mdp = builder.build();
  ASSERT_FALSE(mdp);
  EXPECT_EQ(message(mdp.error()),
            "state HALL, action To-CAVE: probabilities sum to 0.9, expected 1");
}

TEST(MdpBuilder, NormalisesStartWeights) {
  MdpBuilder builder(0.9);
  builder.move("A", "go", "B").move("B", "go", "C").start("B", 3.0).start("A").start("B", 4.0);
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp);
  ASSERT_EQ(mdp->start().size(), 2u);
  EXPECT_EQ(mdp->start_probability(0), 0.125);
  EXPECT_EQ(mdp->start_probability(1), 0.875);
  builder.start("A", -100.0);
  EXPECT_FALSE(builder.build());
}

TEST(MdpBuilder, DeclaresEndsOnceOrTwice) {
  MdpBuilder builder(0.9);
  builder.move("A", "go", "B").move("B", "back", "A").terminal("B").terminal("B");
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp);
  EXPECT_TRUE(mdp->terminal(1));
  EXPECT_EQ(mdp->arrays().terminal, std::vector<State>{1});
}

TEST(MdpBuilder, MovesByNumber) {
  MdpBuilder builder(0.9);
  const State a = builder.state("A");
  const State b = builder.state("B");
  const std::uint32_t go = builder.action("go");
  builder.move(a, go, b, 2.0, 1.0);
  EXPECT_EQ(builder.states(), 2u);
  EXPECT_EQ(builder.state("A"), a);
  EXPECT_TRUE(builder.build());
  builder.move(a, go, 7, 0.0, 1.0);
  EXPECT_FALSE(builder.build());
}

}  // namespace
}  // namespace quoll
