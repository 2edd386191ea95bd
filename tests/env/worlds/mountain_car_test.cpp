#include "one_lane.hpp"

namespace quoll {
namespace {

using world_tests::expect_near;
using world_tests::OneLane;

// At position 0 the slope pulls with cos 0 = 1: -0.0025; the motor adds 0.001.
TEST(MountainCar, OneStep) {
  OneLane lane("mountain-car");
  ASSERT_TRUE(lane.set({0, 0}));
  const Feedback feedback = lane.step(1);
  EXPECT_EQ(feedback.reward, -1.0);
  EXPECT_FALSE(feedback.terminated);
  EXPECT_EQ(lane.numbers(), (std::vector{-0.0025, -0.0025}));
  ASSERT_TRUE(lane.set({0, 0}));
  lane.step(2);
  expect_near(lane.numbers(), {-0.0015, -0.0015}, 1e-18);
  ASSERT_TRUE(lane.set({0, 0}));
  lane.step(0);
  expect_near(lane.numbers(), {-0.0035, -0.0035}, 1e-18);
}

TEST(MountainCar, IsNeverFasterThanItsBound) {
  OneLane lane("mountain-car");
  ASSERT_TRUE(lane.set({0, -0.07}));
  lane.step(0);
  EXPECT_EQ(lane.numbers(), (std::vector{-0.07, -0.07}));
}

TEST(MountainCar, TheLeftWallStops) {
  OneLane lane("mountain-car");
  ASSERT_TRUE(lane.set({-1.19, -0.05}));
  EXPECT_FALSE(lane.step(0).terminated);
  EXPECT_EQ(lane.numbers(), (std::vector{-1.2, 0.0}));
}

TEST(MountainCar, TheGoalEndsTheEpisode) {
  OneLane lane("MountainCar-v0");
  ASSERT_TRUE(lane.set({0.49, 0.02}));
  const Feedback feedback = lane.step(2);
  EXPECT_TRUE(feedback.terminated);
  EXPECT_EQ(feedback.reward, -1.0);
  const std::vector<double> there = lane.numbers();
  EXPECT_EQ(lane.step(0).reward, 0.0);
  EXPECT_EQ(lane.numbers(), there);
  OneLane fast("mountain-car", {{"goal_velocity", "0.05"}});
  ASSERT_TRUE(fast.set({0.49, 0.02}));
  EXPECT_FALSE(fast.step(2).terminated);
}

TEST(MountainCar, IsCutOffAfterTwoHundredSteps) {
  OneLane lane("mountain-car");
  lane.restart();
  for (int t = 1; t <= 200; ++t) {
    const Feedback feedback = lane.step(1);
    EXPECT_EQ(feedback.truncated, t == 200);
    EXPECT_FALSE(feedback.terminated);
  }
}

// Pushing along with the velocity always brings the car up, in 80 to 200 steps (Moore 1990: it
// cannot be done without swinging back first).
TEST(MountainCar, SwingingUpReachesTheGoal) {
  OneLane lane("mountain-car");
  for (int episode = 0; episode < 50; ++episode) {
    lane.restart();
    EXPECT_TRUE(lane.numbers()[0] >= -0.6 && lane.numbers()[0] < -0.4);
    EXPECT_EQ(lane.numbers()[1], 0.0);
    int steps = 0;
    for (bool ended = false; !ended && steps < 200; ++steps) {
      ended = lane.step(lane.numbers()[1] >= 0 ? 2 : 0).terminated;
    }
    EXPECT_TRUE(steps > 80 && steps < 200) << steps;
  }
}

// gymnasium.make("MountainCar-v0"), reset(seed=42), then 0 0 0 2 2 2 0 0 0 ... 20 times, reset().
TEST(MountainCar, FollowsGymnasiumsSeeds) {
  OneLane lane("mountain-car", {{"seeding", "gymnasium"}}, 42);
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{-0x1.c7e4d028ba858p-2, 0.0}));
  for (int t = 0; t < 20; ++t) lane.step(t / 3 % 2 * 2);
  const std::vector end{-0x1.1c71cda7b7909p-1, -0x1.c858e349d2df7p-8};
  expect_near(lane.numbers(), end, 1e-14);
#ifdef __GLIBC__
  EXPECT_EQ(lane.numbers(), end);
#endif
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{-0x1.064243d8f02c0p-1, 0.0}));
}

TEST(MountainCar, BinsNumberTheStates) {
  OneLane lane("mountain-car", {{"bins", "18,14"}});  // of width 0.1 and 0.01
  EXPECT_EQ(lane.world->traits.states, 252u);
  ASSERT_TRUE(lane.set({-0.55, 0.015}));
  EXPECT_EQ(lane.state, 6u * 14 + 8);
}

TEST(MountainCar, CanBeLookedAt) {
  OneLane lane("mountain-car");
  ASSERT_TRUE(lane.set({-0.5, 0.01}));
  EXPECT_EQ(lane.text(),
            "                                           F\n"
            "                                       .......\n"
            "                                   ....\n"
            "...                             ...\n"
            "   ...                       ...\n"
            "      ...                 ...\n"
            "         ....         ....\n"
            "             .....o...\n"
            "position -0.500, velocity 10.000 thousandths a step\n");
  EXPECT_DOUBLE_EQ(lane.drawing().width, 1.8);
}

}  // namespace
}  // namespace quoll
