// What is remembered, against a list of everything that happened.

#include "quoll/learn/deep/replay.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/learn/deep/sum_tree.hpp"
#include "quoll/learn/deep/targets.hpp"

namespace quoll {
namespace {

// Lanes of made-up episodes: observation i of a lane's frame f is a number of (lane, f, i).
class Story {
 public:
  Story(std::uint32_t numbers, std::uint32_t lanes, bool flags)
      : flags_(flags),
        state_(lanes),
        next_(lanes),
        action_(lanes),
        feedback_(lanes),
        observation_(lanes * numbers),
        next_observation_(lanes * numbers) {
    for (std::size_t lane = 0; lane < lanes; ++lane) begin(lane);
  }

  struct Event {
    std::vector<float> before, after;
    State state, next;
    Action action;
    Feedback feedback;
  };

  void step(Replay& replay) {
    const std::size_t numbers = observation_.size() / state_.size();
    for (std::size_t lane = 0; lane < state_.size(); ++lane) {
      action_[lane] = rng_.below(3);
      feedback_[lane] = {rng_.uniform(), rng_.below(9) == 0, rng_.below(9) == 0,
                         rng_.below(2) == 0};
      next_[lane] = rng_.below(1000);
      for (std::size_t i = 0; i < numbers; ++i) next_observation_[lane * numbers + i] = number();
    }
    const Experience now{state_, action_, feedback_, next_, observation_, next_observation_};
    replay.push(now);
    for (std::size_t lane = 0; lane < state_.size(); ++lane) {
      const auto part = [&](const std::vector<float>& all) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(lane * numbers);
        return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(numbers));
      };
      events.push_back({part(observation_), part(next_observation_), state_[lane], next_[lane],
                        action_[lane], feedback_[lane]});
      state_[lane] = next_[lane];
      for (std::size_t i = 0; i < numbers; ++i) {
        observation_[lane * numbers + i] = next_observation_[lane * numbers + i];
      }
      if (feedback_[lane].over()) begin(lane);
    }
  }

  std::vector<Event> events;  // lane by lane of each step

 private:
  float number() { return flags_ ? static_cast<float>(rng_.below(2)) : float(rng_.uniform()); }
  void begin(std::size_t lane) {
    const std::size_t numbers = observation_.size() / state_.size();
    state_[lane] = rng_.below(1000);
    for (std::size_t i = 0; i < numbers; ++i) observation_[lane * numbers + i] = number();
  }

  Rng rng_ = stream(7, "story");
  bool flags_;
  std::vector<State> state_, next_;
  std::vector<Action> action_;
  std::vector<Feedback> feedback_;
  std::vector<float> observation_, next_observation_;
};

Spaces spaces_of(std::uint32_t numbers, bool flags) {
  Spaces spaces;
  spaces.actions = 3;
  spaces.states = numbers == 0 ? 1000 : 0;
  spaces.observation = numbers;
  spaces.whole = flags;
  return spaces;
}

void expect_remembered(const Replay& replay, const Story& story, std::size_t lanes) {
  const std::size_t kept = replay.size() / lanes, steps = story.events.size() / lanes;
  for (std::size_t index = 0; index < replay.size(); ++index) {
    const std::size_t lane = index / kept, step = steps - kept + index % kept;
    const Story::Event& event = story.events[step * lanes + lane];
    const std::uint64_t slot = replay.slot(index);
    std::vector<float> seen(event.before.size());
    EXPECT_EQ(replay.before(slot, seen), seen.empty() ? event.state : 0u);
    EXPECT_EQ(seen, event.before);
    EXPECT_EQ(replay.next(slot, seen), seen.empty() ? event.next : 0u);
    EXPECT_EQ(seen, event.after);
    EXPECT_EQ(replay.action(slot), event.action);
    EXPECT_EQ(replay.reward(slot), static_cast<float>(event.feedback.reward));
    EXPECT_EQ(replay.terminated(slot), event.feedback.terminated);
    EXPECT_EQ(replay.over(slot), event.feedback.over());
    EXPECT_EQ(replay.turn_passes(slot), event.feedback.turn_passes);
    const bool follows = !event.feedback.over() && step + 1 < steps;
    EXPECT_EQ(replay.after(slot), follows ? replay.slot(index + 1) : Replay::no_slot);
  }
}

TEST(Replay, RemembersTheLastSteps) {
  for (const std::uint32_t numbers : {0u, 3u, 130u}) {
    for (const bool flags : {false, true}) {
      for (const std::uint32_t lanes : {1u, 4u}) {
        Replay replay(spaces_of(numbers, flags), 40, lanes);
        Story story(numbers, lanes, flags);
        for (std::size_t step = 1; step <= 100; ++step) {
          story.step(replay);
          EXPECT_EQ(replay.size(), std::min<std::size_t>(step * lanes, 40));
          if (step % 7 == 0) expect_remembered(replay, story, lanes);
        }
      }
    }
  }
}

TEST(Replay, WholeNumbersThatAreNoFlagsAreKeptToo) {
  Replay replay(spaces_of(5, true), 40, 2);
  Story flags(5, 2, true), others(5, 2, false);
  for (int step = 0; step < 10; ++step) flags.step(replay);
  for (int step = 0; step < 30; ++step) others.step(replay);
  expect_remembered(replay, others, 2);
}

TEST(Replay, GoesOnWhereItWasSaved) {
  for (const std::uint32_t numbers : {0u, 3u}) {
    Replay replay(spaces_of(numbers, false), 20, 2), other(spaces_of(numbers, false), 20, 2);
    Story story(numbers, 2, false);
    for (int step = 0; step < 33; ++step) story.step(replay);
    Archive saving;
    replay.persist(saving);
    Archive loading{std::span<const std::byte>(saving.bytes())};
    other.persist(loading);
    ASSERT_TRUE(loading.good()) << loading.error().expected;
    expect_remembered(other, story, 2);
    for (int step = 0; step < 9; ++step) story.step(other);
    expect_remembered(other, story, 2);
    Replay smaller(spaces_of(numbers, false), 10, 2);
    Archive again{std::span<const std::byte>(saving.bytes())};
    smaller.persist(again);
    EXPECT_FALSE(again.good());
  }
}

TEST(Replay, RefusesStatesAndActionsThatThereAreNot) {
  Replay replay(spaces_of(0, false), 20, 2);
  Story story(0, 2, false);
  for (int step = 0; step < 33; ++step) story.step(replay);
  Archive saving;
  replay.persist(saving);
  Spaces fewer = spaces_of(0, false);
  fewer.states = 100;
  Spaces less = spaces_of(0, false);
  less.actions = 2;
  for (const Spaces& spaces : {fewer, less}) {
    Replay other(spaces, 20, 2);
    Archive loading{std::span<const std::byte>(saving.bytes())};
    other.persist(loading);
    EXPECT_FALSE(loading.good());
  }
}

// By hand, discount 1/2, rewards in tenths: 1, 2, 4 (end), 8, 16 (cut), 32.
TEST(Replay, StretchesEndWithTheirEpisode) {
  Replay replay(spaces_of(0, false), 10, 1);
  const auto push = [&](double reward, bool terminated, bool truncated, bool turn) {
    State state = 0, next = 1;
    Action action = 0;
    Feedback feedback{reward, terminated, truncated, turn};
    replay.push({{&state, 1}, {&action, 1}, {&feedback, 1}, {&next, 1}, {}, {}});
  };
  push(1, false, false, false);
  push(2, false, false, true);
  push(4, true, false, false);
  push(8, false, false, false);
  push(16, false, true, false);
  push(32, false, false, false);
  const auto expect = [&](std::uint64_t slot, std::uint64_t n, float reward, float carry,
                          std::uint64_t last) {
    const Stretch all = stretch(replay, slot, n, 0.5F, 1.0F);
    EXPECT_EQ(all.reward, reward) << slot << " " << n;
    EXPECT_EQ(all.carry, carry) << slot << " " << n;
    EXPECT_EQ(all.last, last) << slot << " " << n;
  };
  expect(0, 1, 1, 0.5F, 0);
  expect(0, 2, 2, -0.25F, 1);  // the turn passed at the second step
  expect(0, 3, 1, 0, 2);       // 1 + 2/2 - 4/4
  expect(0, 9, 1, 0, 2);
  expect(3, 9, 16, 0.25F, 4);  // a cut counts what follows
  expect(5, 9, 32, 0.5F, 5);   // the newest
  EXPECT_EQ(stretch(replay, 3, 1, 0.5F, 0.25F).reward, 2.0F);
}

TEST(SumTree, FindsByTheSumsOfPriorities) {
  SumTree tree(5);
  const std::vector<double> priorities = {2, 0, 1, 0, 4};
  for (std::size_t i = 0; i < priorities.size(); ++i) tree.set(i, priorities[i]);
  EXPECT_EQ(tree.total(), 7.0);
  const auto brute = [&](double mass) {
    std::size_t i = 0;
    while (mass >= priorities[i]) mass -= priorities[i++];
    return i;
  };
  for (double mass = 0.0; mass < 7.0; mass += 0.125) EXPECT_EQ(tree.find(mass), brute(mass));
  tree.set(0, 0);
  EXPECT_EQ(tree.find(0.0), 2u);
  EXPECT_EQ(tree.find(5.0), 4u);  // rounding may ask for the total itself
}

}  // namespace
}  // namespace quoll
