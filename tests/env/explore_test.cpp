#include "quoll/env/explore.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "quoll/env/dynamics.hpp"

namespace quoll {
namespace {

// Four cells in a row; right at the last one ends with 1, any other step costs 1/2. A step goes the
// other way with probability 1/4; a wall holds.
struct Corridor {
  using Position = int;
  double slip = 0.25;
  Spaces spaces() const { return {.actions = 2, .states = 4}; }
  Position start(auto&) const { return 1; }
  Feedback step(Position& at, Action action, auto& dice) const {
    const bool right = (action == 1) != chance(dice, slip);
    if (right && at == 3) return {1.0, true, false};
    at = right ? at + 1 : at > 0 ? at - 1 : 0;
    return {-0.5, false, false};
  }
  State number(const Position& at) const { return static_cast<State>(at); }
  std::vector<std::string> action_names() const { return {"left", "right"}; }
};

std::string outcomes(const Mdp& mdp, const std::string& state, Action action) {
  const std::optional<State> s = mdp.find_state(state);
  if (!s) return "no state " + state;
  const std::uint64_t c = mdp.choice_begin(*s) + action;
  std::string text = mdp.action_name(c) + ":";
  for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
    text += " " + mdp.state_name(mdp.next(o)) + " " +
            std::to_string(mdp.probability(o)).substr(0, 5) + " " +
            std::to_string(mdp.reward(c, o)).substr(0, 4);
  }
  return text;
}

std::string names(const Mdp& mdp) {
  std::string text;
  for (State s = 0; s < mdp.states(); ++s) text += (s > 0 ? ", " : "") + mdp.state_name(s);
  return text;
}

template <class D>
Result<Mdp> explored_as(D dynamics, std::uint64_t max_states = 1000) {
  return explore(to_world("tried", std::move(dynamics), 0.9), {max_states, {}});
}

TEST(Explore, ACorridorBreadthFirst) {
  const Result<Mdp> mdp = explored_as(Corridor{0.0});
  ASSERT_TRUE(mdp);
  // From 1: 0 and 2; from 2: 3; from 3: the end, in which the walker still stands at 3.
  EXPECT_EQ(names(*mdp), "1, 0, 2, 3, 3 (end)");
  EXPECT_TRUE(mdp->deterministic());
  EXPECT_EQ(mdp->discount(), 0.9);
  EXPECT_EQ(outcomes(*mdp, "0", 0), "left: 0 1.000 -0.5");
  EXPECT_EQ(outcomes(*mdp, "3", 1), "right: 3 (end) 1.000 1.00");
  EXPECT_TRUE(mdp->terminal(4));
  ASSERT_EQ(mdp->start().size(), 1u);
  EXPECT_EQ(mdp->start()[0], 0u);
}

TEST(Explore, ASlipperyCorridor) {
  const Result<Mdp> mdp = explored_as(Corridor{});
  ASSERT_TRUE(mdp);
  EXPECT_EQ(names(*mdp), "1, 2, 0, 3, 3 (end)");
  EXPECT_EQ(outcomes(*mdp, "1", 1), "right: 2 0.750 -0.5 0 0.250 -0.5");
  EXPECT_EQ(outcomes(*mdp, "3", 0), "left: 2 0.750 -0.5 3 (end) 0.250 1.00");
  EXPECT_EQ(outcomes(*mdp, "0", 0), "left: 1 0.250 -0.5 0 0.750 -0.5");
}

// Two dice in one step and one at the start; who meets the sum of both wins it.
struct TwoDice {
  struct Position {
    std::uint8_t goal = 0;
    std::uint32_t sum = 0;  // after three bytes that say nothing
    void persist(auto& archive) {
      archive("goal", goal);
      archive("sum", sum);
    }
  };
  Spaces spaces() const { return {.actions = 1, .states = 0, .observation = 1}; }
  Position start(auto& dice) const { return {static_cast<std::uint8_t>(2 + dice.below(2)), 0}; }
  Feedback step(Position& at, Action, auto& dice) const {
    const std::uint32_t first = 1 + dice.below(2), second = 1 + dice.below(2);
    at.sum = first + second;
    return {at.sum == at.goal ? 1.0 : 0.0, true, false};
  }
  void observe(const Position&, std::span<float>) const {}
};

// Sums of two two-sided dice: 2 with 1/4, 3 with 1/2, 4 with 1/4.
TEST(Explore, TwoDrawsInAStepAreOneOutcomePerResult) {
  const Result<Mdp> mdp = explored_as(TwoDice{});
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_EQ(mdp->states(), 8u);
  EXPECT_EQ(outcomes(*mdp, "goal=3 sum=0", 0),
            "0: goal=3 sum=2 0.250 0.00 goal=3 sum=3 0.500 1.00 goal=3 sum=4 0.250 0.00");
  ASSERT_EQ(mdp->start().size(), 2u);
  EXPECT_EQ(mdp->start_probability(1), 0.5);
}

// Numbers that lead back to a position say all of it: the coin that start() draws is no state.
struct Settled {
  struct Position {
    State place = 0;
    std::uint32_t coin = 0;
  };
  Spaces spaces() const { return {.actions = 2, .states = 3}; }
  Position start(auto& dice) const { return {0, 1 + dice.below(2)}; }
  Position position(State s) const { return {s, 0}; }
  State number(const Position& at) const { return at.place; }
  Action actions(State s) const { return s == 0 ? 2 : s == 1 ? 1 : 0; }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (at.coin == 0) at.coin = 1 + dice.below(2);
    at.place = action == 0 ? 1 : at.coin;
    return {0.0, false, false};
  }
};

TEST(Explore, NumberedStatesAreWhatTheirNumbersStandFor) {
  const Result<Mdp> mdp = explored_as(Settled{});
  ASSERT_TRUE(mdp);
  EXPECT_EQ(names(*mdp), "0, 1, 2");
  EXPECT_EQ(outcomes(*mdp, "0", 1), "1: 1 0.500 0.00 2 0.500 0.00");
  EXPECT_EQ(mdp->actions(1), 1u);
  EXPECT_TRUE(mdp->terminal(2));  // it has no actions
}

struct Counter {
  using Position = std::int64_t;
  Spaces spaces() const { return {.actions = 1, .states = 0, .observation = 1}; }
  Position start(auto&) const { return 0; }
  Feedback step(Position& at, Action, auto&) const { return {0.0, ++at == 12, false}; }
  void observe(const Position&, std::span<float>) const {}
};

TEST(Explore, TheLimitIsTheNumberOfStates) {
  EXPECT_TRUE(explored_as(Counter{}, 13));
  const Result<Mdp> refused = explored_as(Counter{}, 12);
  ASSERT_FALSE(refused);
  EXPECT_EQ(message(refused.error()),
            "--max-states: tried has more than 12 states: 2 of those found are not yet gone "
            "through; give a larger number, or use 'quoll learn', which needs no list of them");
}

// Two who take turns; with `again` a 1 lets the same one move again.
struct Turns {
  using Position = int;
  bool again = false;
  Spaces spaces() const { return {.actions = 2, .states = 0, .observation = 1}; }
  Position start(auto&) const { return 0; }
  Feedback step(Position& at, Action action, auto&) const {
    at += 1 + static_cast<int>(action);
    if (at >= 3) return {1.0, true, false, false};
    return {0.0, false, false, !again || action == 0};
  }
  void observe(const Position&, std::span<float>) const {}
};

TEST(Explore, ATurnThatAlwaysPassesMakesAGame) {
  const Result<Mdp> game = explored_as(Turns{});
  ASSERT_TRUE(game);
  EXPECT_TRUE(game->alternating());
  const Result<Mdp> refused = explored_as(Turns{true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(message(refused.error()),
            "the states of tried cannot be listed: the turn passes in some steps only");
}

struct Drift : Counter {
  Feedback step(Position&, Action, auto& dice) const {
    return {between(dice, 0.0, 1.0), true, false};
  }
};
struct Many : Counter {
  Feedback step(Position&, Action, auto& dice) const {
    return {1.0 * dice.below(1u << 21), true, false};
  }
};

TEST(Explore, SaysWhatCannotBeListed) {
  EXPECT_EQ(message(explored_as(Drift{}).error()),
            "the states of tried cannot be listed: its action 0 draws a real number, of which "
            "there are too many to list");
  EXPECT_EQ(message(explored_as(Many{}).error()),
            "the states of tried cannot be listed: its action 0 has more than 1,048,576 outcomes");
}

// Of more than 100 letters.
struct Long : Counter {
  using Position = std::array<std::int64_t, 6>;
  Position start(auto&) const { return {}; }
  Feedback step(Position& at, Action, auto&) const {
    at.fill(at[0] - 1'000'000'000'000'000'000);
    return {0.0, at[0] < -8'000'000'000'000'000'000, false};
  }
  void observe(const Position&, std::span<float>) const {}
};

TEST(Explore, LongNamesAreNumbers) {
  const Result<Mdp> mdp = explored_as(Long{});
  ASSERT_TRUE(mdp);
  EXPECT_EQ(names(*mdp), "0, 1, 2, 3, 4, 5, 6, 7, 8, 9");
}

TEST(Explore, AWorldWithAModelStaysAsItIs) {
  const Result<World> known = find_world("adventure");
  ASSERT_TRUE(known);
  const Result<World> same = explored(*known);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->mdp, known->mdp);
  EXPECT_FALSE(explore(*known));
}

}  // namespace
}  // namespace quoll
