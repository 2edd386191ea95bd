#include <cmath>

#include "one_lane.hpp"

namespace quoll {
namespace {

using world_tests::expect_near;
using world_tests::OneLane;

constexpr double pi = 3.141592653589793;

// Upright at rest, torque 2: rate 3 * 2 * 0.05 = 0.3, angle 0.3 * 0.05; cost 0.001 * 4.
TEST(Pendulum, ATorqueAtTheTop) {
  OneLane lane("pendulum");
  ASSERT_TRUE(lane.set({0, 0}));
  const Feedback feedback = lane.step(4);
  EXPECT_DOUBLE_EQ(feedback.reward, -0.004);
  EXPECT_FALSE(feedback.terminated);
  expect_near(lane.numbers(), {0.015, 0.3}, 1e-16);
}

// Horizontal: gravity turns with 15 sin(pi/2) * 0.05 = 0.75; cost (pi/2)^2 + 0.1 * 4.
TEST(Pendulum, GravityTurns) {
  OneLane lane("pendulum");
  ASSERT_TRUE(lane.set({pi / 2, -2}));
  EXPECT_DOUBLE_EQ(lane.step(2).reward, -(pi * pi / 4 + 0.4));
  expect_near(lane.numbers(), {pi / 2 - 1.25 * 0.05, -1.25}, 1e-15);
  OneLane moon("pendulum", {{"gravity", "1.6"}});
  ASSERT_TRUE(moon.set({pi / 2, 0}));
  moon.step(2);
  EXPECT_NEAR(moon.numbers()[1], 1.6 * 1.5 * 0.05, 1e-16);
}

// The angle counts modulo a turn, the state keeps it; the rate is bounded by 8.
TEST(Pendulum, TurnsCountOnce) {
  OneLane lane("pendulum");
  ASSERT_TRUE(lane.set({4 * pi + 0.5, 0}));
  EXPECT_NEAR(lane.step(2).reward, -0.25, 1e-13);
  EXPECT_GT(lane.numbers()[0], 12.0);
  ASSERT_TRUE(lane.set({-4 * pi - 0.5, 0}));
  EXPECT_NEAR(lane.step(2).reward, -0.25, 1e-13);
  ASSERT_TRUE(lane.set({pi / 2, 7.9}));
  lane.step(4);
  EXPECT_EQ(lane.numbers()[1], 8.0);
}

TEST(Pendulum, TorquesAreEvenlySpaced) {
  EXPECT_EQ(
      find_world("pendulum")->action_names,
      (std::vector<std::string>{"torque -2", "torque -1", "torque 0", "torque 1", "torque 2"}));
  EXPECT_EQ(find_world("pendulum", {{"torques", "3"}})->action_names[1], "torque 0");
  EXPECT_FALSE(find_world("pendulum", {{"torques", "1"}}));
}

TEST(Pendulum, NeverEndsButIsCutOff) {
  OneLane lane("Pendulum-v1");
  lane.restart();
  for (int t = 1; t <= 200; ++t) {
    const Feedback feedback = lane.step(static_cast<Action>(t % 5));
    EXPECT_FALSE(feedback.terminated);
    EXPECT_EQ(feedback.truncated, t == 200);
    EXPECT_GE(feedback.reward, lane.world->traits.reward_bounds->first);
  }
}

// gymnasium.make("Pendulum-v1"), reset(seed=42), then the torques -2 -2 -2 -1 -1 -1 ... 20 times;
// the reward's last bits are those of NumPy 1.
TEST(Pendulum, FollowsGymnasiumsSeeds) {
  OneLane lane("pendulum", {{"seeding", "gymnasium"}}, 42);
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{0x1.b8a834b9184f0p+0, -0x1.f4b533cb0dc10p-4}));
  double sum = 0;
  for (int t = 0; t < 20; ++t) sum += lane.step(static_cast<Action>(t / 3 % 5)).reward;
  const std::vector end{0x1.2d0ed02f5dd79p+2, -0x1.101956c1df354p-3};
  expect_near(lane.numbers(), end, 1e-12);
  EXPECT_NEAR(sum, -0x1.e54c7a854dc09p+6, 1e-9);
#ifdef __GLIBC__
  EXPECT_EQ(lane.numbers(), end);
  EXPECT_EQ(sum, -0x1.e54c7a854dc09p+6);
#endif
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{0x1.2066cc9620a0ap+1, 0x1.9435b070b0044p-2}));
}

TEST(Pendulum, BinsNumberTheStates) {
  OneLane lane("pendulum", {{"bins", "2,2,4"}});
  EXPECT_EQ(lane.world->traits.states, 16u);
  ASSERT_TRUE(lane.set({2.0, -3}));  // cos < 0, sin > 0, rate in [-4, 0)
  EXPECT_EQ(lane.state, (0u * 2 + 1) * 4 + 1);
}

TEST(Pendulum, CanBeLookedAt) {
  OneLane lane("pendulum");
  ASSERT_TRUE(lane.set({-pi / 2, 0}));
  EXPECT_NE(lane.text().find("            O***********\n"), std::string::npos) << lane.text();
  EXPECT_NE(lane.text().find("angle -1.571 rad, 0.000 rad/s\n"), std::string::npos);
  EXPECT_DOUBLE_EQ(lane.drawing().width, 2.4);
}

}  // namespace
}  // namespace quoll
