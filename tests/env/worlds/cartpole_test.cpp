#include "one_lane.hpp"

namespace quoll {
namespace {

using world_tests::expect_near;
using world_tests::OneLane;

// Upright and at rest, pushed right: the push is 10 / 1.1 = 100/11; the pole turns with
// -(100/11) / (0.5 (4/3 - 1/11)) = -600/41, the cart gains 100/11 + 0.05 * (600/41) / 1.1 = 400/41;
// after 0.02 s the rates are 8/41 and -12/41, and nothing has moved yet.
TEST(CartPole, APushFromRest) {
  OneLane lane("cartpole");
  ASSERT_TRUE(lane.set({0, 0, 0, 0}));
  const Feedback right = lane.step(1);
  EXPECT_EQ(right.reward, 1.0);
  EXPECT_FALSE(right.terminated || right.truncated);
  expect_near(lane.numbers(), {0, 8.0 / 41, 0, -12.0 / 41}, 1e-15);
  EXPECT_EQ(lane.next_seen[1], static_cast<float>(lane.numbers()[1]));
  ASSERT_TRUE(lane.set({0, 0, 0, 0}));
  lane.step(0);
  expect_near(lane.numbers(), {0, -8.0 / 41, 0, 12.0 / 41}, 1e-15);
}

// The position moves with the velocity before the step.
TEST(CartPole, MovesWithTheOldVelocities) {
  OneLane lane("cartpole");
  ASSERT_TRUE(lane.set({0.5, 1, 0, 0}));
  lane.step(1);
  expect_near(lane.numbers(), {0.52, 1 + 8.0 / 41, 0, -12.0 / 41}, 1e-15);
}

TEST(CartPole, EndsOutsideTheTrackOrBeyondTwelveDegrees) {
  constexpr double twelve_degrees = 0.20943951023931953;
  OneLane lane("CartPole-v1");
  ASSERT_TRUE(lane.set({2.4, 0, 0, 0}));  // on the edge is inside
  EXPECT_FALSE(lane.step(1).terminated);
  ASSERT_TRUE(lane.set({2.39, 1, 0, 0}));
  EXPECT_TRUE(lane.step(1).terminated);
  EXPECT_EQ(lane.numbers()[0], 2.39 + 0.02);
  ASSERT_TRUE(lane.set({0, 0, -twelve_degrees, 0}));
  EXPECT_FALSE(lane.step(0).terminated);
  ASSERT_TRUE(lane.set({0, 0, -0.2, -0.5}));
  const Feedback fall = lane.step(0);
  EXPECT_TRUE(fall.terminated);
  EXPECT_EQ(fall.reward, 1.0);
  const std::vector<double> fallen = lane.numbers();
  const Feedback after = lane.step(1);
  EXPECT_TRUE(after.terminated);
  EXPECT_EQ(after.reward, 0.0);
  EXPECT_EQ(lane.numbers(), fallen);
}

TEST(CartPole, RewardsOfSuttonAndBarto) {
  OneLane lane("cartpole", {{"sutton_barto_reward", "true"}});
  ASSERT_TRUE(lane.set({0, 0, 0, 0}));
  EXPECT_EQ(lane.step(1).reward, 0.0);
  ASSERT_TRUE(lane.set({0, 0, -0.2, -0.5}));
  EXPECT_EQ(lane.step(1).reward, -1.0);
  EXPECT_EQ(lane.step(1).reward, 0.0);
  EXPECT_EQ(lane.world->traits.reward_bounds, std::pair(-1.0, 0.0));
}

// Both flags hold when the pole falls in the last step allowed.
TEST(CartPole, IsCutOffAfterItsLimit) {
  OneLane lane("CartPole-v0");
  EXPECT_EQ(lane.world->episode_steps, 200u);
  EXPECT_EQ(OneLane("CartPole-v1").world->episode_steps, 500u);
  OneLane two("cartpole", {{"limit", "2"}});
  ASSERT_TRUE(two.set({0, 0, 0, 0}));
  EXPECT_FALSE(two.step(1).truncated);
  EXPECT_TRUE(two.step(0).truncated);
  ASSERT_TRUE(two.set({0, 0, -0.2, 0}));
  two.step(0);
  two.step(0);
  ASSERT_TRUE(two.set({0, 0, -0.209, -0.01}));
  EXPECT_FALSE(two.step(1).terminated);
  const Feedback last = two.step(1);
  EXPECT_TRUE(last.terminated && last.truncated);
}

TEST(CartPole, StartsNearTheMiddle) {
  OneLane lane("cartpole");
  std::vector<double> before;
  for (int episode = 0; episode < 1000; ++episode) {
    lane.restart();
    const std::vector<double> now = lane.numbers();
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_TRUE(now[i] >= -0.05 && now[i] < 0.05);
      EXPECT_EQ(lane.seen[i], static_cast<float>(now[i]));
    }
    EXPECT_NE(now, before);
    before = now;
  }
}

// env = gymnasium.make("CartPole-v1"); env.reset(seed=42), then the actions 0 0 0 1 1 1 0 0 0 ...:
// the pole falls in step 15; env.reset() then starts the second episode.
TEST(CartPole, FollowsGymnasiumsSeeds) {
  OneLane lane("CartPole-v1", {{"seeding", "gymnasium"}}, 42);
  EXPECT_TRUE(lane.world->traits.libm);
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{0x1.c0d97eba2bd40p-6, -0x1.9090f63c0b010p-8,
                                         0x1.25c36f3afc536p-5, 0x1.435e26c08cd04p-6}));
  for (int t = 0; t < 15; ++t) EXPECT_EQ(lane.step(t / 3 % 2).terminated, t == 14);
  const std::vector end{-0x1.dfe5faa78b553p-5, -0x1.399bd5a2af18fp-1, 0x1.b704a3cbe5884p-3,
                        0x1.63d4bdb8b0acap+0};
  expect_near(lane.numbers(), end, 1e-12);
#ifdef __GLIBC__
  EXPECT_EQ(lane.numbers(), end);
#endif
  lane.restart();
  EXPECT_EQ(lane.numbers(), (std::vector{-0x1.4c732dbc27c1ap-5, 0x1.85a13c91af4aap-5,
                                         0x1.abd9edfe4f0e8p-6, 0x1.d4b010e49783cp-6}));
}

// 3 x 2 x 4 x 2 bins; position cut at +-0.8, velocity at 0, angle at 0 and +-6 degrees, turning
// rate at 0: ((position * 2 + velocity) * 4 + angle) * 2 + turning.
TEST(CartPole, BinsNumberTheStates) {
  OneLane lane("cartpole", {{"bins", "3,2,4,2"}});
  EXPECT_EQ(lane.environment().spaces().states, 48u);
  EXPECT_EQ(lane.world->traits.states, 48u);
  EXPECT_FALSE(lane.world->traits.deterministic);
  EXPECT_TRUE(OneLane("cartpole").world->traits.deterministic);
  ASSERT_TRUE(lane.set({-0.9, -1, -0.2, -1}));
  EXPECT_EQ(lane.state, 0u);
  ASSERT_TRUE(lane.set({0.9, 1, 0.2, 1}));
  EXPECT_EQ(lane.state, 47u);
  ASSERT_TRUE(lane.set({0.1, -0.1, 0.01, 0.1}));
  EXPECT_EQ(lane.state, ((1u * 2 + 0) * 4 + 2) * 2 + 1);
  lane.step(1);
  EXPECT_EQ(lane.next, ((1u * 2 + 1) * 4 + 2) * 2 + 0);
  ASSERT_TRUE(lane.set({-99, 1e300, 99, -99}));  // outside falls into the outer bins
  EXPECT_EQ(lane.state, ((0u * 2 + 1) * 4 + 3) * 2 + 0);
}

TEST(CartPole, BinsMustFit) {
  for (const char* bins : {"6", "6,6,12", "6,6,12,0", "6,6,12,x", "6,6,12,12,2", "6,,12,12",
                           "-1,6,12,12", "99999,99999,2,2"}) {
    const Result<World> world = find_world("cartpole", {{"bins", bins}});
    ASSERT_FALSE(world) << bins;
    EXPECT_EQ(world.error().file, "--with bins");
    EXPECT_NE(world.error().expected.find("4 whole numbers"), std::string::npos);
  }
  EXPECT_TRUE(find_world("cartpole", {{"bins", " 6, 6,12,12"}}));
}

TEST(CartPole, CanBeLookedAt) {
  OneLane lane("cartpole");
  ASSERT_TRUE(lane.set({0, 0.25, 0.1, -0.5}));
  EXPECT_EQ(lane.text(),
            "                         /\n"
            "                         /\n"
            "                        /\n"
            "                      [___]\n"
            "|-----------------------+-----------------------|\n"
            "x 0.000 m, 0.250 m/s   angle 5.730 deg, -28.648 deg/s\n");
  EXPECT_GT(lane.drawing().width, 4.8);
  EXPECT_GT(lane.drawing().shapes.size(), 5u);
  EXPECT_EQ(lane.world->action_names, (std::vector<std::string>{"left", "right"}));
}

}  // namespace
}  // namespace quoll
