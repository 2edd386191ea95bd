#include "quoll/env/world.hpp"

#include <gtest/gtest.h>

#include "quoll/env/worlds/adventure.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

TEST(World, FollowsFromItsModel) {
  MdpBuilder builder(0.5);
  builder.move("A", "go", "B", -2, 0.5).move("A", "go", "END", 3, 0.5).move("B", "go", "A", 1);
  const World world = to_world("small", *builder.build());
  EXPECT_EQ(world.name, "small");
  EXPECT_EQ(world.discount, 0.5);
  EXPECT_FALSE(world.traits.deterministic);
  EXPECT_TRUE(world.traits.settable);
  EXPECT_EQ(world.traits.states, 3u);
  EXPECT_EQ(world.traits.reward_bounds->first, -2.0);
  EXPECT_EQ(world.traits.reward_bounds->second, 3.0);
  EXPECT_EQ(world.make({2, 1, 0, nullptr})->spaces().actions, 1u);
}

TEST(World, TheAdventureIsBuiltIn) {
  const auto world = find_world("adventure");
  ASSERT_TRUE(world);
  EXPECT_EQ(world->mdp->states(), 6u);
  EXPECT_EQ(world->discount, 0.8);
  EXPECT_TRUE(world->traits.deterministic);
  EXPECT_FALSE(adventure_toml().empty());
}

TEST(World, AWorldFromAFileIsCalledLikeTheFile) {
  const auto world = find_world(QUOLL_SOURCE "/worlds/adventure.toml");
  ASSERT_TRUE(world);
  EXPECT_EQ(world->name, "adventure");
}

TEST(World, SaysWhatItDoesNotFind) {
  const auto misspelt = find_world("adventrue");
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(misspelt.error().nearest, "adventure");
  EXPECT_FALSE(find_world("no/such/file.toml"));
  const auto parameters = find_world("adventure", {{"size", "3"}});
  ASSERT_FALSE(parameters);
  EXPECT_EQ(parameters.error().file, "--with");
  EXPECT_FALSE(find_world(QUOLL_SOURCE "/worlds/adventure.toml", {{"size", "3"}}));
}

}  // namespace
}  // namespace quoll
