#include "quoll/env/dynamics.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quoll {
namespace {

// Ten cells in a row; right at the last one ends with 1. A step slips with probability 1/4.
struct Corridor {
  using Position = int;
  Spaces spaces() const { return {.actions = 2, .states = 10}; }
  Position start(auto& dice) const { return static_cast<int>(dice.below(5)); }
  Feedback step(Position& at, Action action, auto& dice) const {
    const bool slips = dice.uniform() < 0.25;
    const bool right = (action == 1) != slips;
    if (right && at == 9) return {1.0, true, false};
    at = right ? at + 1 : at > 0 ? at - 1 : 0;
    return {-0.5, false, false};
  }
  State number(const Position& at) const { return static_cast<State>(at); }
  Position position(State s) const { return static_cast<int>(s); }
  Action actions(State s) const { return s == 0 ? 1 : 2; }
};

// Only observations, a struct as position.
struct Drift {
  struct Position {
    float x = 0, v = 0;
  };
  Spaces spaces() const { return {.actions = 2, .states = 0, .observation = 2}; }
  Position start(auto& dice) const { return {static_cast<float>(dice.uniform()), 0}; }
  Feedback step(Position& at, Action action, auto& dice) const {
    at.v += action == 0 ? -0.5f : 0.5f;
    at.x += at.v + static_cast<float>(dice.uniform());
    return {double{at.x}, at.x > 100, false};
  }
  void observe(const Position& at, std::span<float> x) const {
    x[0] = at.x;
    x[1] = at.v;
  }
};

struct NoStart {
  using Position = int;
  Spaces spaces() const { return {}; }
  Feedback step(Position&, Action, auto&) const { return {}; }
  State number(const Position&) const { return 0; }
};

static_assert(Dynamics<Corridor> && Settable<Corridor> && HasActions<Corridor>);
static_assert(Dynamics<Drift> && !Settable<Drift> && !HasNumber<Drift>);
static_assert(!Dynamics<NoStart> && !Dynamics<int>);

// Columns of n lanes of a world.
struct Lanes {
  std::vector<State> state, next;
  std::vector<Action> action;
  std::vector<Feedback> feedback;
  std::vector<float> x, y;
  explicit Lanes(std::size_t n, std::size_t floats = 0)
      : state(n), next(n), action(n), feedback(n), x(n * floats), y(n * floats) {}
  Experience columns() { return {state, action, feedback, next, x, y}; }
};

// One lane's whole history: everything shown to the caller, `episodes` restarts included.
std::vector<double> history(Environment& environment, std::size_t lanes, std::size_t lane,
                            std::size_t floats, int steps, bool fresh = true) {
  Lanes all(lanes, floats);
  std::vector<std::uint8_t> restart(lanes, fresh);
  std::vector<Rng> coins;
  for (std::size_t i = 0; i < lanes; ++i) coins.push_back(stream(4, "actions", i));
  std::vector<double> seen;
  for (int t = 0; t < steps; ++t) {
    Experience now = all.columns();
    environment.restart(restart, now);
    if (restart[lane]) seen.push_back(all.state[lane]);
    for (std::size_t i = 0; i < lanes; ++i) all.action[i] = coins[i].below(2);
    environment.step(now);
    seen.push_back(all.next[lane]);
    seen.push_back(all.feedback[lane].reward);
    for (std::size_t f = 0; f < floats; ++f) seen.push_back(all.y[lane * floats + f]);
    for (std::size_t i = 0; i < lanes; ++i) restart[i] = all.feedback[i].terminated;
    all.state = all.next;
  }
  return seen;
}

template <class Struct>
void batch_is_its_lanes(std::size_t floats) {
  const auto five = batch(Struct{}, {5, 11, 0, nullptr});
  const auto eight = batch(Struct{}, {8, 11, 0, nullptr});
  const auto again = batch(Struct{}, {8, 11, 0, nullptr});
  EXPECT_EQ(history(*five, 5, 4, floats, 500), history(*eight, 8, 4, floats, 500));
  EXPECT_NE(history(*again, 8, 4, floats, 500),
            history(*batch(Struct{}, {8, 12, 0, nullptr}), 8, 4, floats, 500));
}

TEST(Batch, ALaneDoesNotDependOnHowManyThereAre) {
  batch_is_its_lanes<Corridor>(0);
  batch_is_its_lanes<Drift>(2);
}

// Lane 0 of any batch is the struct itself with the streams ("world", 0) and ("start", 0).
TEST(Batch, IsTheStructSteppedByHand) {
  const auto environment = batch(Corridor{}, {1, 21, 0, nullptr});
  Lanes lane(1);
  const std::uint8_t restart = 1;
  Rng dice = stream(21, "world"), start = stream(21, "start");
  const Corridor corridor;
  for (int episode = 0; episode < 20; ++episode) {
    Experience now = lane.columns();
    environment->restart({&restart, 1}, now);
    int at = corridor.start(start);
    ASSERT_EQ(lane.state[0], static_cast<State>(at));
    for (int t = 0; t < 50; ++t) {
      lane.action[0] = t % 3 != 0;
      environment->step(now);
      const Feedback expected = corridor.step(at, t % 3 != 0, dice);
      ASSERT_EQ(lane.feedback[0].reward, expected.reward);
      ASSERT_EQ(lane.feedback[0].terminated, expected.terminated);
      ASSERT_EQ(lane.next[0], static_cast<State>(at));
      lane.state = lane.next;
    }
  }
}

TEST(Batch, GoesOnWhereItWasSaved) {
  for (int cut = 1; cut < 40; cut += 3) {
    const auto whole = batch(Drift{}, {3, 5, 0, nullptr}),
               loaded = batch(Drift{}, {3, 6, 0, nullptr});
    history(*whole, 3, 1, 2, cut);
    Archive out;
    whole->persist(out);
    Archive in{std::span<const std::byte>(out.bytes())};
    loaded->persist(in);
    ASSERT_TRUE(in.good() && in.at_end());
    EXPECT_EQ(history(*whole, 3, 2, 2, 50, false), history(*loaded, 3, 2, 2, 50, false));
  }
}

TEST(Batch, APositionOfAnotherWorldIsRefused) {
  Archive out;
  Rng rng;
  std::string bytes = "abc";
  out("dice", rng);
  out("start_dice", rng);
  out("position", bytes);
  Archive in{std::span<const std::byte>(out.bytes())};
  batch(Drift{}, {1, 1, 0, nullptr})->persist(in);
  EXPECT_FALSE(in.good());
}

TEST(Batch, CanBeSetWhereTheStructCan) {
  const auto corridor = batch(Corridor{}, {2, 1, 0, nullptr});
  EXPECT_TRUE(corridor->set(1, 9));
  Lanes lanes(2);
  lanes.state[1] = 9;
  lanes.action = {1, 1};
  Experience now = lanes.columns();
  corridor->step(now);
  EXPECT_TRUE(lanes.feedback[1].terminated || lanes.next[1] == 8);
  EXPECT_FALSE(batch(Drift{}, {1, 1, 0, nullptr})->set(0, 0));
}

TEST(ToWorld, TakesWhatTheStructSays) {
  const World world = to_world("corridor", Corridor{}, 0.9);
  EXPECT_EQ(world.name, "corridor");
  EXPECT_EQ(world.traits.states, 10u);
  EXPECT_TRUE(world.traits.settable);
  EXPECT_EQ(world.discount, 0.9);
  EXPECT_EQ(world.mdp, nullptr);
  EXPECT_EQ(world.make({})->actions(0), 1u);
  EXPECT_EQ(world.make({})->actions(5), 2u);
  EXPECT_FALSE(to_world("drift", Drift{}, 0.9).traits.settable);
}

}  // namespace
}  // namespace quoll
