#include "quoll/env/worlds/bicycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "quoll/env/world.hpp"

namespace quoll {
namespace {

enum Deed : Action { still = 4, lean_left = 5, steer_left = 7 };

Bicycle bicycle(Integration integration, BicycleTask task = BicycleTask::balance,
                Shaping shaping = Shaping::none) {
  BicycleSettings settings;
  settings.integration = integration;
  settings.task = task;
  settings.shaping = shaping;
  return {settings};
}

constexpr Integration both[] = {Integration::original, Integration::euler};

std::array<double, 10> numbers(const Bicycle::Position& at) {
  return {at.omega,   at.omega_rate, at.omega_acceleration,
          at.theta,   at.theta_rate, at.x_front,
          at.y_front, at.x_back,     at.y_back,
          at.psi};
}

TEST(Bicycle, RidesStraightWhenNothingHappens) {
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration);
    Bicycle::Position at = world.start_at(90);  // the goal in the east, the ride to the north
    for (int t = 0; t < 100; ++t) EXPECT_FALSE(world.ride(at, still, 0).terminated);
    EXPECT_EQ(at.omega, 0);
    EXPECT_EQ(at.x_front, 0);
    EXPECT_NEAR(at.y_back, 10 / 3.6, 1e-12);  // a second at 10 km/h
    EXPECT_NEAR(at.y_front, 10 / 3.6 + 1.11, 1e-12);
  }
}

// From rest, theta'' = T / I_dl = 2 / (0.5 1.7 0.34^2) = 20.3541624...
TEST(Bicycle, TheHandlebarsTurn) {
  const double acceleration = 2 / (0.5 * 1.7 * 0.34 * 0.34);
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration);
    Bicycle::Position at = world.start_at(90);
    world.ride(at, steer_left, 0);
    EXPECT_NEAR(at.theta_rate, 0.01 * acceleration, 1e-15);
    EXPECT_NEAR(at.theta, integration == Integration::original ? 1e-4 * acceleration : 0.0, 1e-17);
  }
}

// From rest, omega'' = M h g sin(atan(0.02 / 0.94)) / I_bike = 75 0.94 9.82 0.0212718 / 149.69.
TEST(Bicycle, LeaningTilts) {
  Bicycle::Position at = bicycle(Integration::euler).start_at(90);
  bicycle(Integration::euler).ride(at, lean_left, 0);
  const double sine = 0.02 / std::sqrt(0.02 * 0.02 + 0.94 * 0.94);
  EXPECT_NEAR(at.omega_acceleration, 75 * 0.94 * 9.82 * sine / 149.69, 1e-6);
  EXPECT_NEAR(at.omega_rate, 0.01 * at.omega_acceleration, 1e-17);
}

// One step of each variant as a program written separately from the published equations gives it.
TEST(Bicycle, OneStepOfEachVariant) {
  constexpr double expected[2][11] = {
      {0.048156551636679444, -0.18434483633205567, 1.5655163667944327, -0.38247438767894704,
       1.7525612321052988, 9.674395792333783, 21.08809538278478, 9.991650833398078,
       20.026493326618695, 0.2903973217660127, 1.8250079188880337e-05},
      {0.048, -0.18434483633205567, 1.5655163667944327, -0.385, 1.7525612321052988,
       9.675001543372154, 21.09037187380556, 9.991791105370519, 20.026537124697935,
       0.2894195891206666, 1.839693846779957e-05}};
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration, BicycleTask::goal, Shaping::standard);
    Bicycle::Position at;
    at.omega = 0.05, at.omega_rate = -0.2, at.theta = -0.4, at.theta_rate = 1.5, at.psi = 0.3;
    at.x_back = 10, at.y_back = 20;
    at.x_front = 10 - 1.11 * std::sin(0.3), at.y_front = 20 + 1.11 * std::cos(0.3);
    ASSERT_EQ(at.impossible(), nullptr);
    const Feedback feedback = world.ride(at, 6, 0.013);
    const auto& known = expected[static_cast<int>(integration)];
    const auto found = numbers(at);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found[i], known[i], 1e-13) << i;
    EXPECT_NEAR(feedback.reward, known[10], 1e-15);
    EXPECT_FALSE(feedback.terminated);
  }
}

TEST(Bicycle, HandlebarsStopAtEightyDegrees) {
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration);
    Bicycle::Position at = world.start_at(90);
    at.theta = Bicycle::stop - 1e-4;
    at.theta_rate = 1.0;
    world.ride(at, steer_left, 0);
    EXPECT_EQ(at.theta, Bicycle::stop);
    EXPECT_NEAR(Bicycle::stop, 80 * std::acos(-1.0) / 180, 1e-15);
    if (integration == Integration::original) {
      EXPECT_GT(at.theta_rate, 1.0);
    } else {
      EXPECT_EQ(at.theta_rate, 0.0);
    }
  }
}

TEST(Bicycle, TheWheelbaseStaysWithinACentimetre) {
  const Bicycle world = bicycle(Integration::original);
  Bicycle::Position at = world.start_at(90);
  double longest = 0;
  int corrections = 0;
  for (int t = 0; t < 2000; ++t) {
    at.theta = 0.5;  // a circle of a radius of 2.3 m, held up by force
    at.omega = at.theta_rate = at.omega_rate = 0;
    const double before = std::hypot(at.x_front - at.x_back, at.y_front - at.y_back);
    world.ride(at, still, 0);
    const double off = std::fabs(std::hypot(at.x_front - at.x_back, at.y_front - at.y_back) - 1.11);
    longest = std::max(longest, off);
    corrections += std::fabs(before - 1.11) > 1e-3 && off < 1e-12;
  }
  EXPECT_LE(longest, 0.01 + 1e-12);
  EXPECT_GT(corrections, 10);
}

// A rider without skill falls after 60 to 145 steps: of 400 such rides, at least nine in ten.
TEST(Bicycle, ARandomRiderFallsSoon) {
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration);
    Rng rng = stream(1, "random rider");
    int in_range = 0;
    for (int episode = 0; episode < 400; ++episode) {
      Bicycle::Position at = world.start(rng);
      int steps = 0;
      for (bool fallen = false; !fallen; ++steps) {
        const Feedback feedback = world.step(at, rng.below(9), rng);
        fallen = feedback.terminated;
        EXPECT_EQ(feedback.reward, fallen ? -1.0 : 0.0);
      }
      in_range += steps >= 60 && steps <= 145;
    }
    EXPECT_GE(in_range, 360);
  }
}

TEST(Bicycle, AfterAFallNothingHappens) {
  const Bicycle world = bicycle(Integration::original);
  Bicycle::Position at = world.start_at(90);
  at.omega = 0.21;  // 12.03 degrees
  const auto before = numbers(at);
  const Feedback feedback = world.ride(at, still, 0);
  EXPECT_TRUE(feedback.terminated);
  EXPECT_EQ(feedback.reward, 0.0);
  EXPECT_EQ(numbers(at), before);
}

TEST(Bicycle, RidesIntoTheGoal) {
  for (const Integration integration : both) {
    const Bicycle world = bicycle(integration, BicycleTask::goal, Shaping::standard);
    Bicycle::Position at = world.start_at(0);  // straight to the east
    EXPECT_NEAR(Bicycle::angle_to_goal(at), 0.0, 1e-12);
    Feedback feedback;
    int steps = 0;
    while (!feedback.terminated && steps < 100'000) {
      feedback = world.ride(at, still, 0);
      ++steps;
      EXPECT_NEAR(feedback.reward, feedback.terminated ? 0.01 : 4 * 0.00004, 1e-12);
    }
    // The front tyre starts 1.11 m ahead and has to come within 10 m of x = 1000.
    EXPECT_EQ(steps, static_cast<int>(std::ceil((990 - 1.11) / (0.01 * 10 / 3.6))));
    EXPECT_TRUE(world.ride(at, still, 0).terminated);
  }
}

TEST(Bicycle, LeftOfTheGoalIsPositive) {
  for (const double heading : {-150.0, -90.0, -1.0, 30.0, 90.0, 179.0}) {
    const auto at = bicycle(Integration::original, BicycleTask::goal).start_at(heading);
    // With the tyre at the front, 1.11 m from the origin, the angle is a little larger.
    EXPECT_NEAR(Bicycle::angle_to_goal(at), -heading * std::acos(-1.0) / 180, 2e-3) << heading;
    EXPECT_EQ(at.impossible(), nullptr);
  }
}

// The discounted rewards of a shaped ride are those of the plain one minus the first potential.
TEST(Bicycle, PotentialsCancel) {
  for (const BicycleTask task : {BicycleTask::balance, BicycleTask::goal}) {
    const Bicycle plain = bicycle(Integration::original, task);
    const Bicycle shaped = bicycle(Integration::original, task, Shaping::potential);
    Rng rng = stream(2, "shaping");
    Bicycle::Position at = plain.start_at(60);
    at.omega = 0.1;
    const double angle = Bicycle::angle_to_goal(at), tilt = at.omega / Bicycle::fall;
    const double potential = -0.1 * (task == BicycleTask::goal ? std::fabs(angle) : tilt * tilt);
    double difference = 0, factor = 1;
    for (bool ended = false; !ended; factor *= 0.99) {
      Bicycle::Position same = at;
      const Action action = rng.below(9);
      const double sway = between(rng, -0.02, 0.02);
      const Feedback one = plain.ride(same, action, sway), other = shaped.ride(at, action, sway);
      difference += factor * (other.reward - one.reward);
      ended = other.terminated;
    }
    EXPECT_NEAR(difference, -potential, 1e-12);
    EXPECT_LT(potential, -0.02);
  }
}

TEST(Bicycle, TheTrackKeepsTheWholeRide) {
  Track track;
  for (int t = 0; t < 1'000'000; ++t) track.add(t, -t);
  EXPECT_LE(track.x.size(), 512u);
  EXPECT_GT(track.x.size(), 250u);
  for (std::size_t i = 0; i < track.x.size(); ++i) {
    EXPECT_EQ(track.x[i], double(i) * track.stride);
    EXPECT_EQ(track.y[i], -track.x[i]);
  }
}

World world_with(const Parameters& parameters) {
  Result<World> world = find_world("bicycle", parameters);
  EXPECT_TRUE(world);
  return std::move(*world);
}

TEST(Bicycle, ShowsAndTakesItsState) {
  const World world = world_with({{"task", "goal"}, {"noise", "0"}});
  const auto environment = world.make({1, 1, 0, nullptr});
  Inspector* const look = environment->inspector();
  Tree state = look->state(0, 0);
  auto& fields = std::get<Tree::Object>(state.value);
  ASSERT_EQ(fields.size(), 10u);  // the track is no part of it
  const auto set = [&](std::string_view name, double value) {
    for (auto& [key, field] : fields) {
      if (key == name) field = Tree(value);
    }
  };
  State at = 0;
  set("omega", 0.1);
  EXPECT_TRUE(look->set(0, state, at));
  EXPECT_EQ(look->state(0, 0), state);
  EXPECT_EQ(look->text(0, 0),
            "tilt        [-----*----|----------] 5.7 degrees left\n"
            "handlebars  [----------*----------] 0 degrees\n"
            "goal        [----------|----*-----] 90.1 degrees right, 1000 m\n");
  EXPECT_EQ(look->drawing(0, 0).width, 100.0);
  set("theta", 1.5);
  EXPECT_FALSE(look->set(0, state, at));
  set("theta", 0.0);
  set("x_back", 1.0);
  EXPECT_FALSE(look->set(0, state, at));
  set("x_back", 0.0);
  set("psi", 0.1);
  EXPECT_FALSE(look->set(0, state, at));
}

TEST(Bicycle, Declares) {
  EXPECT_FALSE(world_with({}).traits.deterministic);
  EXPECT_TRUE(world_with({{"noise", "0"}}).traits.deterministic);
  EXPECT_EQ(world_with({}).make({2, 1, 0, nullptr})->spaces().observation, 5u);
  EXPECT_EQ(world_with({{"task", "goal"}}).make({2, 1, 0, nullptr})->spaces().observation, 6u);
  EXPECT_EQ(world_with({}).action_names.size(), 9u);
  EXPECT_FALSE(find_world("bicycle", {{"integration", "exact"}}));
  EXPECT_FALSE(find_world("bicycle", {{"shaping_weight", "-1"}}));
}

}  // namespace
}  // namespace quoll
