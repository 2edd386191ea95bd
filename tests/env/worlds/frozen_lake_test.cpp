#include "quoll/env/world.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "played.hpp"
#include "quoll/env/worlds/lake_map.hpp"

namespace quoll::world_tests {
namespace {

const Parameters dry{{"slippery", "false"}}, big{{"map", "8x8"}},
    big_dry{{"map", "8x8"}, {"slippery", "false"}};

// Value iteration over the tables of Gymnasium's program (FrozenLake-v1, version 1.4 in
// preparation) gives these digits.
TEST(FrozenLake, HasTheKnownOptima) {
  EXPECT_NEAR(optimum(made("frozen-lake"), 0.99), 0.542025932000, 6e-13);
  EXPECT_NEAR(optimum(made("frozen-lake"), 0.9), 0.068890904889, 6e-13);
  EXPECT_NEAR(optimum(made("frozen-lake", big), 0.99), 0.414640361800, 6e-13);
  EXPECT_NEAR(optimum(made("frozen-lake", big), 0.9), 0.006411114262, 6e-13);
  EXPECT_NEAR(optimum(made("frozen-lake", dry), 0.99), 0.950990, 6e-7);
  EXPECT_NEAR(optimum(made("frozen-lake", dry), 0.9), 0.590490, 6e-7);
  EXPECT_NEAR(optimum(made("frozen-lake", big_dry), 0.99), 0.877521, 6e-7);
  EXPECT_NEAR(optimum(made("frozen-lake", big_dry), 0.9), 0.254187, 6e-7);
  EXPECT_NEAR(optimum_in(made("frozen-lake"), 100), 0.744190, 6e-7);
  EXPECT_NEAR(optimum_in(made("frozen-lake", big), 200), 0.913220, 6e-7);
}

// Six moves to the goal, the reward with the last one: 0.99^5.
TEST(FrozenLake, IsAWalkOfSixMovesWithoutSlipping) {
  EXPECT_EQ(optimum(made("frozen-lake", dry), 1.0), 1.0);
  EXPECT_NEAR(optimum(made("frozen-lake", dry), 0.99), 0.99 * 0.99 * 0.99 * 0.99 * 0.99, 1e-15);
  EXPECT_TRUE(made("frozen-lake", dry).traits.deterministic);
}

TEST(FrozenLake, SlipsToBothSidesInGymnasiumsOrder) {
  const World world = made("frozen-lake", {{"success_rate", "0.5"}});
  const Mdp& mdp = *world.mdp;
  const std::uint64_t right = mdp.choice_begin(10) + 2;  // r2c2; below it ice, right of it a hole
  ASSERT_EQ(mdp.outcome_end(right) - mdp.outcome_begin(right), 3u);
  const State next[] = {14, 11, 6};
  const double probability[] = {0.25, 0.5, 0.25};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(mdp.next(mdp.outcome_begin(right) + i), next[i]);
    EXPECT_EQ(mdp.probability(mdp.outcome_begin(right) + i), probability[i]);
  }
  EXPECT_EQ(mdp.state_name(10), "r2c2");
  EXPECT_EQ(mdp.action_name(right), "right");
  EXPECT_TRUE(mdp.terminal(11));
  EXPECT_EQ(mdp.start().size(), 1u);
}

TEST(FrozenLake, TakesOtherRewards) {
  const World world = made("frozen-lake", {{"slippery", "false"},
                                           {"goal_reward", "10"},
                                           {"hole_reward", "-5"},
                                           {"frozen_reward", "-0.5"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.reward(mdp.choice_begin(14) + 2), 10.0);
  EXPECT_EQ(mdp.reward(mdp.choice_begin(10) + 2), -5.0);
  EXPECT_EQ(mdp.reward(mdp.choice_begin(0) + 0), -0.5);
  EXPECT_EQ(optimum(world, 1.0), 10 - 5 * 0.5);
}

// Gymnasium 1.4 in preparation, env.reset(seed=42) and seed=7, actions 1, 2, 1, 2, ...
TEST(FrozenLake, FollowsGymnasiumForTheSameSeed) {
  const auto down_right = [](int t) { return Action(1 + t % 2); };
  const Parameters guest{{"seeding", "gymnasium"}};
  const Played small = play(made("FrozenLake-v1", guest), 42, 24, down_right);
  EXPECT_EQ(small.observed,
            numbers({4, 0, 1, 5, 1, 1, 0, 1, 5, 1, 2, 3, 2, 3, 2, 2, 6, 2, 6, 2, 3, 3, 2, 3}));
  EXPECT_EQ(small.starts, numbers({0, 0, 0}));
  const Played large = play(made("FrozenLake8x8-v1", guest), 7, 24, down_right);
  EXPECT_EQ(large.observed, numbers({1,  1, 0, 8, 9,  17, 18, 10, 18, 26, 25, 33,
                                     41, 1, 2, 2, 10, 2,  1,  9,  17, 25, 24, 25}));
}

// generate_random_map(5, 0.6, 9) and (8, 0.8, 1) of the same version.
TEST(FrozenLake, GeneratesGymnasiumsMaps) {
  EXPECT_EQ(*generated_lake(5, 0.6, 9), (LakeMap{"SFHFH", "FFFHF", "FFFFF", "FHFFF", "HFFFG"}));
  EXPECT_EQ(*generated_lake(8, 0.8, 1), (LakeMap{"SHFHFFHF", "FFFFFFFF", "FFFFFFFH", "HFFFFHFF",
                                                 "FFFHFFFF", "FHFFHFFF", "FHFFFHFF", "HHHFFFFG"}));
  const World world = made("frozen-lake", {{"map", "generated"}, {"size", "5"}});
  EXPECT_EQ(world.mdp->states(), 25u);
  EXPECT_EQ(generated_lake(2, 0.0, 1).error().file, "--with p");
}

TEST(FrozenLake, ReadsAMapFromAFile) {
  const std::string path = testing::TempDir() + "lake-" + std::to_string(getpid()) + ".txt";
  std::ofstream(path) << "SFS\r\nFHG\r\n\n";
  const World world = made("frozen-lake", {{"map", path}});
  EXPECT_EQ(world.mdp->states(), 6u);
  EXPECT_EQ(world.mdp->start().size(), 2u);
  EXPECT_EQ(world.mdp->start_probability(0), 0.5);
  std::ofstream(path) << "SFS\nFXG\n";
  const Error letter = refused("frozen-lake", {{"map", path}});
  EXPECT_EQ(letter.line, 2u);
  EXPECT_EQ(letter.column, 2u);
  std::ofstream(path) << "SFS\nFG\n";
  EXPECT_EQ(refused("frozen-lake", {{"map", path}}).line, 2u);
  std::ofstream(path) << "FFG\n";
  EXPECT_EQ(refused("frozen-lake", {{"map", path}}).expected, "a start S expected");
  refused("frozen-lake", {{"map", path + ".no"}});
}

TEST(FrozenLake, RefusesWhatHasNoEffect) {
  EXPECT_EQ(refused("frozen-lake", {{"map", "generate"}}).nearest, "generated");
  EXPECT_EQ(refused("frozen-lake", {{"size", "5"}}).file, "--with size");
  EXPECT_EQ(refused("frozen-lake", {{"slippery", "false"}, {"success_rate", "0.5"}}).file,
            "--with success_rate");
  refused("frozen-lake", {{"success_rate", "1.5"}});
}

TEST(FrozenLake, CountsStepsAndShowsItself) {
  EXPECT_EQ(made("FrozenLake-v1").episode_steps, 100u);
  EXPECT_EQ(made("FrozenLake8x8-v1").episode_steps, 200u);
  const Played idle = play(made("frozen-lake", dry), 1, 100, [](int) { return Action{0}; });
  EXPECT_TRUE(idle.truncated[99]);
  EXPECT_FALSE(idle.terminated[99] || idle.truncated[98]);
  EXPECT_EQ(idle.text, "@...\n.H.H\n...H\nH..G\n");
  const auto environment = made("frozen-lake").make({1, 1, 0, nullptr});
  const Drawing drawing = environment->inspector()->drawing(0, 7);
  EXPECT_EQ(drawing.width, 4.0);
  EXPECT_EQ(drawing.shapes.back().ink, Ink::agent);
  EXPECT_EQ(drawing.shapes.back().points[0], std::make_pair(3.5, 1.5));
}

}  // namespace
}  // namespace quoll::world_tests
