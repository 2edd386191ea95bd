#include "quoll/env/world.hpp"

#include <gtest/gtest.h>

#include "../refusal.hpp"
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

TEST(World, KnowsTheParametersOfItsAliasEachOnce) {
  const auto old = find_world("CartPole-v0", {{"bins", "2,2,2,2"}});
  ASSERT_TRUE(old);
  EXPECT_EQ(old->parameters, (Parameters{{"limit", "200"}, {"bins", "2,2,2,2"}}));
  const auto own = find_world("CartPole-v0", {{"limit", "7"}});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->parameters, (Parameters{{"limit", "7"}}));
  EXPECT_EQ(own->episode_steps, 7u);
}

TEST(World, OffersWhatItSaysItOffers) {
  for (const WorldEntry* const entry : worlds()) {
    if (!entry->offer) continue;
    WorldEntry unsaid = *entry;
    unsaid.offer = nullptr;
    const Offer said = offer_of(*entry), made = offer_of(unsaid);
    EXPECT_EQ(said.spaces.states, made.spaces.states) << entry->name;
    EXPECT_EQ(said.spaces.actions, made.spaces.actions) << entry->name;
    EXPECT_EQ(said.spaces.observation, made.spaces.observation) << entry->name;
    EXPECT_EQ(said.episode_steps, made.episode_steps) << entry->name;
    EXPECT_EQ(said.discount, made.discount) << entry->name;
    EXPECT_EQ(said.libm, made.libm) << entry->name;
  }
}

TEST(World, RefusesParametersWithoutEffect) {
  const auto refused = [](const std::string& name, const Parameters& parameters) {
    return tests::refusal_of(find_world(name, parameters));
  };
  EXPECT_EQ(refused("taxi", {{"rainy_probability", "0.5"}}),
            "--with rainy_probability: has an effect only with rainy=true");
  EXPECT_EQ(refused("taxi", {{"rainy-probability", "0.5"}, {"rainy", "true"}}), "");
  EXPECT_EQ(refused("taxi", {{"rainy-probability", "0.5"}}),
            "--with rainy_probability: has an effect only with rainy=true");
  EXPECT_EQ(refused("taxi", {{"fickle_probability", "0.5"}}),
            "--with fickle_probability: has an effect only with fickle=true");
  EXPECT_EQ(refused("inventory", {{"mean", "3"}}), "");
  EXPECT_EQ(refused("inventory", {{"mean", "3"}, {"demand", "book"}}),
            "--with mean: has an effect only with demand=poisson");
  EXPECT_EQ(refused("bicycle", {{"heading", "10"}}),
            "--with heading: has an effect only with task=goal");
  EXPECT_EQ(refused("bicycle", {{"shaping", "standard"}}),
            "--with shaping: has an effect only with task=goal");
  EXPECT_EQ(refused("bicycle", {{"shaping", "potential"}, {"shaping_weight", "1"}}), "");
  EXPECT_EQ(refused("bicycle", {{"shaping_weight", "1"}}),
            "--with shaping_weight: has an effect only with shaping=potential");
  EXPECT_EQ(refused("bicycle", {{"task", "goal"}, {"any_heading", "true"}, {"heading", "10"}}),
            "--with heading: has an effect only with any_heading=false");
  EXPECT_EQ(refused("tic-tac-toe", {{"mark", "o"}}),
            "--with mark: has an effect only with an opponent");
  EXPECT_EQ(refused("minatar-breakout", {{"ramping", "false"}}),
            "--with: the world minatar-breakout takes sticky, minimal, not 'ramping'");
  EXPECT_EQ(refused("minatar-asterix", {{"ramping", "false"}}), "");
}

}  // namespace
}  // namespace quoll
