#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "quoll/env/worlds/cartpole.hpp"

// Lanes stepped as columns against the plain struct, lane by lane and bit for bit, in every width
// of vector that this processor has.

namespace quoll {
namespace {

/// Lanes of an environment, driven by coins of each lane; restarted where an episode is over, and
/// now and then where it is not. Unless `listed`, restart() is left to find those that are over.
struct Drive {
  std::unique_ptr<Environment> environment;
  std::vector<Action> action;
  std::vector<Feedback> feedback;
  std::vector<float> seen, next_seen;
  std::vector<std::uint8_t> restart;
  std::vector<Rng> coins;
  std::uint32_t time = 0;
  bool listed = true;

  explicit Drive(std::unique_ptr<Environment> lanes, std::uint32_t count)
      : environment(std::move(lanes)),
        action(count),
        feedback(count),
        seen(4 * count),
        next_seen(4 * count),
        restart(count, 1) {
    for (std::uint32_t lane = 0; lane < count; ++lane) coins.push_back(stream(9, "coin", lane));
  }
  void step() {
    Experience now{{}, action, feedback, {}, seen, next_seen};
    environment->restart(listed || time == 0 ? restart : std::span<const std::uint8_t>(), now);
    for (std::size_t lane = 0; lane < action.size(); ++lane) {
      // Half of the lanes balance, so that limits are met; some go on after the end.
      const float* const x = &seen[4 * lane];
      const bool balance = x[2] + 0.5f * x[3] + 0.05f * x[0] + 0.1f * x[1] > 0;
      action[lane] = lane % 2 == 0 ? balance : coins[lane].below(2);
    }
    environment->step(now);
    ++time;
    for (std::size_t lane = 0; lane < action.size(); ++lane) {
      restart[lane] = feedback[lane].over() && (!listed || lane % 5 != 0 || (time + lane) % 7 == 0);
    }
    std::swap(seen, next_seen);
    for (std::size_t lane = 0; lane < action.size(); ++lane) {
      if (!restart[lane]) continue;
      for (std::size_t i = 4 * lane; i < 4 * lane + 4; ++i) next_seen[i] = seen[i];
    }
  }
};

template <class Real>
void expect_the_same(std::uint32_t count, int most_bytes, bool sutton_barto, bool listed = true) {
  const CartPole<Real> dynamics{sutton_barto};
  const Lanes lanes{count, 17, 60, nullptr};
  Drive plain(batch(dynamics, lanes), count);
  Drive fast(cartpole_lanes(dynamics, lanes, most_bytes), count);
  plain.listed = fast.listed = listed;
  int terminated = 0, truncated = 0, both = 0;
  for (int t = 0; t < 1500; ++t) {
    plain.step();
    fast.step();
    ASSERT_EQ(plain.seen, fast.seen) << t;
    ASSERT_EQ(plain.restart, fast.restart);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const Feedback &one = plain.feedback[lane], &other = fast.feedback[lane];
      ASSERT_EQ(one.reward, other.reward) << t << " " << lane;
      ASSERT_EQ(one.terminated, other.terminated) << t << " " << lane;
      ASSERT_EQ(one.truncated, other.truncated) << t << " " << lane;
      terminated += one.terminated;
      truncated += one.truncated;
      both += one.terminated && one.truncated;
    }
    const Tree state = plain.environment->inspector()->state(count - 1, 0);
    ASSERT_EQ(state, fast.environment->inspector()->state(count - 1, 0));
  }
  EXPECT_GT(terminated, 50);
  EXPECT_GT(truncated, 10);
  EXPECT_TRUE(both > 0 || count < 30);
}

TEST(CartPoleLanes, AreThePlainStructInEveryWidth) {
  for (const int bytes : {16, 32, 64}) {
    expect_the_same<double>(37, bytes, false);
    expect_the_same<float>(37, bytes, true);
    expect_the_same<double>(16, bytes, true);
    expect_the_same<float>(8, bytes, false);
    expect_the_same<double>(70, bytes, true, false);
    expect_the_same<float>(70, bytes, false, false);
    expect_the_same<float>(600, bytes, false);  // more than 32 of the widest vectors
  }
}

template <class Real>
void expect_to_go_on() {
  const CartPole<Real> dynamics{false};
  for (int cut = 0; cut < 100; cut += 9) {
    Drive whole(cartpole_lanes(dynamics, {19, 4, 30, nullptr}), 19);
    Drive rest(cartpole_lanes(dynamics, {19, 5, 30, nullptr}), 19);
    for (int t = 0; t < cut; ++t) whole.step();
    Archive out;
    whole.environment->persist(out);
    Archive in{std::span<const std::byte>(out.bytes())};
    rest.environment->persist(in);
    ASSERT_TRUE(in.good() && in.at_end());
    rest.seen = whole.seen;
    rest.next_seen = whole.next_seen;
    rest.restart = whole.restart;
    rest.coins = whole.coins;
    rest.time = whole.time;
    for (int t = 0; t < 80; ++t) {
      whole.step();
      rest.step();
      ASSERT_EQ(whole.seen, rest.seen) << cut;
    }
  }
}

TEST(CartPoleLanes, GoOnWhereTheyWereSaved) {
  expect_to_go_on<double>();
  expect_to_go_on<float>();
}

// Both arithmetics of the struct, Gymnasium's order with the C library's functions and this
// program's own, differ by rounding only.
TEST(CartPoleLanes, OwnArithmeticIsGymnasiumsButForRounding) {
  const CartPole<double> twofold{false};
  const CartPole<float> single{false};
  Rng own = stream(1, "own");
  GuestDice guest(1);
  for (int i = 0; i < 20'000; ++i) {
    std::array<double, 4> one;
    for (double& number : one) number = between(own, -0.2, 0.2) * (i % 7 + 1);
    if (CartPole<double>::fallen(one)) continue;
    std::array<double, 4> other = one;
    std::array<float, 4> small;
    for (std::size_t n = 0; n < 4; ++n) small[n] = static_cast<float>(one[n]);
    const auto action = static_cast<Action>(i % 2);
    twofold.step(one, action, own);
    twofold.step(other, action, guest);
    single.step(small, action, own);
    for (std::size_t n = 0; n < 4; ++n) {
      EXPECT_NEAR(one[n], other[n], 1e-15);
      EXPECT_NEAR(one[n], double{small[n]}, 4e-7);
    }
  }
}

TEST(CartPoleLanes, AreUsedFromEightLanesOn) {
  const Result<World> world = find_world("cartpole", {{"precision", "float"}});
  ASSERT_TRUE(world);
  Drive eight(world->make({8, 3, 0, nullptr}), 8), seven(world->make({7, 3, 0, nullptr}), 7);
  for (int t = 0; t < 600; ++t) {
    eight.step();
    seven.step();
    for (std::size_t i = 0; i < 28; ++i) ASSERT_EQ(eight.seen[i], seven.seen[i]) << t;
  }
  const Result<World> wrong =
      find_world("cartpole", {{"precision", "float"}, {"seeding", "gymnasium"}});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().file, "--with precision");
}

TEST(CartPoleLanes, CanBeSetAndLookedAt) {
  const auto lanes = cartpole_lanes(CartPole<double>{false}, {9, 1, 0, nullptr});
  State at = 0;
  Tree::List list;
  for (const double number : {0.5, 1.0, 0.0, 0.0}) list.emplace_back(number);
  ASSERT_TRUE(lanes->inspector()->set(8, Tree(list), at));
  EXPECT_EQ(lanes->inspector()->state(8, 0), Tree(list));
  EXPECT_NE(lanes->inspector()->text(8, 0).find("x 0.500 m"), std::string::npos);
  EXPECT_FALSE(lanes->inspector()->set(8, Tree(0.5), at));
  EXPECT_FALSE(lanes->set(0, 0));
}

// A lane beside the track is at an end, also where its speed would carry it back.
TEST(CartPoleLanes, RestWherePutIntoAnEnd) {
  for (const int bytes : {16, 32, 64}) {
    Drive drive(cartpole_lanes(CartPole<double>{false}, {40, 1, 9, nullptr}, bytes), 40);
    drive.listed = false;
    drive.step();
    State at = 0;
    Tree::List list;
    for (const double number : {2.41, -5.0, 0.0, 0.0}) list.emplace_back(number);
    for (const std::uint32_t lane : {3u, 35u}) {
      ASSERT_TRUE(drive.environment->inspector()->set(lane, Tree(list), at));
    }
    Experience now{{}, drive.action, drive.feedback, {}, drive.seen, drive.next_seen};
    for (int t = 1; t < 11; ++t) {
      drive.environment->step(now);
      for (const std::uint32_t lane : {3u, 35u}) {
        EXPECT_EQ(drive.environment->inspector()->state(lane, 0), Tree(list));
        EXPECT_EQ(drive.next_seen[4 * lane], 2.41f);
        EXPECT_EQ(drive.feedback[lane].reward, 0.0);
        EXPECT_TRUE(drive.feedback[lane].terminated);
        EXPECT_EQ(drive.feedback[lane].truncated, t == 9);
      }
    }
    drive.environment->restart({}, now);
    for (const std::uint32_t lane : {3u, 35u}) EXPECT_LE(std::fabs(drive.seen[4 * lane]), 0.05f);
  }
}

}  // namespace
}  // namespace quoll
