#include "quoll/env/binned.hpp"

#include <gtest/gtest.h>

#include <string>

#include "quoll/env/listed.hpp"

namespace quoll {
namespace {

TEST(Binned, StatesAreNamedByTheirIntervals) {
  const Result<Bins> bins = Bins::parse("4,1,2", {{"x", -1.0, 1.0}, {"y", 0, 1}, {"z", 0, 0.3}});
  ASSERT_TRUE(bins);
  EXPECT_EQ(bins->states(), 8u);
  EXPECT_EQ(bins->name(0), "..-0.5 .. ..0.15");
  EXPECT_EQ(bins->name(3), "-0.5..0 .. 0.15..");
  EXPECT_EQ(bins->name(4), "0..0.5 .. ..0.15");
  EXPECT_EQ(bins->name(7), "0.5.. .. 0.15..");
  const float inside[] = {-0.25f, 0.5f, 0.2f};
  EXPECT_EQ(bins->name(bins->number(inside)), "-0.5..0 .. 0.15..");
}

TEST(Listed, AWorldWithoutAModelHasItsStatesAndActionsByName) {
  const Result<World> car = find_world("mountain-car", {{"bins", "2,3"}});
  ASSERT_TRUE(car);
  EXPECT_FALSE(car->mdp);
  const auto states = listed(*car);
  ASSERT_TRUE(states) << message(states.error());
  const Mdp& mdp = **states;
  EXPECT_EQ(mdp.states(), 6u);
  EXPECT_EQ(mdp.choices(), 18u);
  EXPECT_EQ(mdp.state_name(5), "-0.3.. 0.02333..");
  EXPECT_EQ(mdp.action_name(mdp.choice_begin(5) + 1), car->action_names[1]);
  EXPECT_EQ(mdp.next(4), 1u);
  EXPECT_FALSE(mdp.terminal(0));
  const Result<World> known = find_world("frozen-lake");
  EXPECT_EQ(*listed(*known), known->mdp);
  EXPECT_EQ(listed(*find_world("cartpole")).error().expected,
            "the states of cartpole cannot be listed");
}

}  // namespace
}  // namespace quoll
