#include <cmath>

#include "one_lane.hpp"

namespace quoll {
namespace {

using world_tests::expect_near;
using world_tests::OneLane;

constexpr double pi = 3.141592653589793;

// Hanging at rest without torque is the equilibrium.
TEST(Acrobot, HangsStill) {
  OneLane lane("acrobot");
  ASSERT_TRUE(lane.set({0, 0, 0, 0}));
  for (int t = 0; t < 5; ++t) EXPECT_EQ(lane.step(1).reward, -1.0);
  expect_near(lane.numbers(), {0, 0, 0, 0}, 1e-14);
}

// A torque of 1 from rest: d1 = 9/2, d2 = 7/4, so the second link turns with
// 1 / (5/4 - (49/16) / (9/2)) = 72/41 and the first with -(7/4) (72/41) / (9/2) = -28/41. Gravity
// answers linearly with the angles: its part of the third order, 1/6 t^3, is
//   M^-1 G (-28/41, 72/41), G = 4.9 ((4, 1), (1, 1)), M = ((9/2, 7/4), (7/4, 5/4)),
// = 4.9 / 41 * M^-1 (-40, 44) and det M = 41/16: 4.9 * 16 / 41^2 * (-50 - 77, 70 + 198).
TEST(Acrobot, ATorqueFromRest) {
  OneLane lane("acrobot");
  ASSERT_TRUE(lane.set({0, 0, 0, 0}));
  lane.step(2);
  const double t = 0.2, third = 4.9 * 16 / (41.0 * 41.0);
  const std::vector<double> rates{-28.0 / 41 * t + third * 127 * t * t * t / 6,
                                  72.0 / 41 * t - third * 268 * t * t * t / 6};
  EXPECT_NEAR(lane.numbers()[2], rates[0], 2e-3);
  EXPECT_NEAR(lane.numbers()[3], rates[1], 2e-3);
  EXPECT_NEAR(lane.numbers()[0], -14.0 / 41 * t * t, 2e-3);
}

// The mirror image of a state, pushed the other way, moves as the mirror image.
TEST(Acrobot, IsSymmetric) {
  for (const char* equations : {"book", "nips"}) {
    OneLane one("acrobot", {{"equations", equations}}),
        other("acrobot", {{"equations", equations}});
    ASSERT_TRUE(one.set({0.3, -0.7, 1.1, 2.0}));
    ASSERT_TRUE(other.set({-0.3, 0.7, -1.1, -2.0}));
    one.step(2);
    other.step(0);
    std::vector<double> mirrored = other.numbers();
    for (double& number : mirrored) number = -number;
    expect_near(one.numbers(), mirrored, 1e-13);
  }
}

TEST(Acrobot, BookAndPaperDiffer) {
  OneLane book("acrobot"), paper("acrobot", {{"equations", "nips"}});
  for (OneLane* const lane : {&book, &paper}) {
    ASSERT_TRUE(lane->set({0.3, -0.7, 1.1, 2.0}));
    lane->step(1);
  }
  EXPECT_GT(std::fabs(book.numbers()[3] - paper.numbers()[3]), 1e-3);
}

TEST(Acrobot, EndsAboveTheBar) {
  OneLane lane("Acrobot-v1");
  ASSERT_TRUE(lane.set({pi - 0.1, 0, 0, 0}));  // both links up: already there
  EXPECT_EQ(lane.step(0).reward, 0.0);
  EXPECT_EQ(lane.numbers()[0], pi - 0.1);
  ASSERT_TRUE(lane.set({2.0, 0, 1, 0}));  // height -2 cos 2 = 0.83, and rising
  const Feedback feedback = lane.step(1);
  EXPECT_TRUE(feedback.terminated);
  EXPECT_EQ(feedback.reward, 0.0);
  EXPECT_GT(-2 * std::cos(lane.numbers()[0]), 0.9);
}

TEST(Acrobot, AnglesAreWrappedAndRatesBounded) {
  OneLane lane("acrobot");
  ASSERT_TRUE(lane.set({1.0, 3.0, 0, 20}));
  lane.step(2);
  EXPECT_LE(lane.numbers()[1], pi);
  EXPECT_GE(lane.numbers()[1], -pi);
  ASSERT_TRUE(lane.set({0.5, 1, 4 * pi, 9 * pi}));
  lane.step(2);
  EXPECT_LE(std::fabs(lane.numbers()[2]), 4 * pi);
  EXPECT_LE(std::fabs(lane.numbers()[3]), 9 * pi);
  ASSERT_TRUE(lane.set({1e300, 1e300, 1e200, 1e200}));  // nonsense ends, it does not hang
  lane.step(0);
  SUCCEED();
}

TEST(Acrobot, StartsRoundedToFloat) {
  OneLane lane("acrobot");
  for (int episode = 0; episode < 100; ++episode) {
    lane.restart();
    for (const double number : lane.numbers()) {
      EXPECT_LE(std::fabs(number), 0.1f);
      EXPECT_EQ(number, double{static_cast<float>(number)});
    }
  }
  EXPECT_EQ(lane.world->episode_steps, 500u);
}

// gymnasium.make("Acrobot-v1"), reset(seed=42), then the actions 0 0 0 2 2 2 0 0 0 ... 20 times.
TEST(Acrobot, FollowsGymnasiumsSeeds) {
  OneLane lane("acrobot", {{"seeding", "gymnasium"}}, 42);
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{0x1.c0d97e0000000p-5, -0x1.9090f60000000p-7,
                                         0x1.25c3700000000p-4, 0x1.435e260000000p-5}));
  const std::vector first{0.99849933f,   0.054763798f, 0.99992526f,
                          -0.012224007f, 0.07171959f,  0.039473604f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(lane.seen[i], first[i]);
  for (int t = 0; t < 20; ++t) lane.step(t / 3 % 2 * 2);
  const std::vector end{-0x1.34d3e934d2a93p-3, 0x1.41ee9003ddbafp-2, 0x1.e0a265aae6eaap-3,
                        -0x1.44d4e17c92a82p-1};
  expect_near(lane.numbers(), end, 1e-12);
#ifdef __GLIBC__
  EXPECT_EQ(lane.numbers(), end);
  EXPECT_EQ(lane.seen, first);
#endif
  lane.restart();
  EXPECT_EQ(lane.numbers()[0], -0x1.4c732e0000000p-4);
}

TEST(Acrobot, BinsNumberTheStates) {
  OneLane lane("acrobot", {{"bins", "2,2,2,2,3,3"}});
  EXPECT_EQ(lane.world->traits.states, 144u);
  ASSERT_TRUE(lane.set({0.5, -0.5, 0, 20}));  // cos, sin > 0; cos > 0, sin < 0; middle; last
  EXPECT_EQ(lane.state, ((((1u * 2 + 1) * 2 + 1) * 2 + 0) * 3 + 1) * 3 + 2);
}

TEST(Acrobot, CanBeLookedAt) {
  OneLane lane("acrobot");
  ASSERT_TRUE(lane.set({0, pi / 2, 0, 0}));
  const std::string text = lane.text();
  EXPECT_NE(text.find("                    o........."), std::string::npos) << text;
  EXPECT_NE(text.find("- - - -"), std::string::npos);
  EXPECT_DOUBLE_EQ(lane.drawing().height, 4.4);
}

}  // namespace
}  // namespace quoll
