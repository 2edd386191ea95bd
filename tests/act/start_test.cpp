#include "quoll/act/start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "quoll/base/archive.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

const auto nobody = [](State) { return std::uint64_t{0}; };

// A, B, C in a row to END; the world begins in A 1/8, C 5/8, END 2/8.
Mdp row() {
  MdpBuilder builder(0.9);
  builder.move("A", "on", "B").move("B", "on", "C").move("C", "on", "END", 1.0);
  builder.start("A", 1).start("C", 5).start("END", 2);
  return *builder.build();
}

std::map<State, int> frequencies(StartStates starts, int draws) {
  std::map<State, int> seen;
  Rng rng = stream(3, "start");
  for (int i = 0; i < draws; ++i) ++seen[starts.draw(rng, nobody)];
  return seen;
}

// Without the end: A 1/6, C 5/6. 5 standard deviations of 60,000 draws: 5 sqrt(60000 * 5/36) = 457;
// false alarm for a fresh seed: one in 1.7 million.
TEST(Start, TheWorldsDistributionWithoutItsEnds) {
  const Mdp mdp = row();
  const auto seen = frequencies(StartStates::world(mdp), 60'000);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_NEAR(seen.at(*mdp.find_state("A")), 10'000, 457);
  EXPECT_NEAR(seen.at(*mdp.find_state("C")), 50'000, 457);
}

// 5 sqrt(60000 * 2/9) = 577.
TEST(Start, UniformOverTheStatesWithActions) {
  const Mdp mdp = row();
  const auto seen = frequencies(StartStates::uniform(mdp), 60'000);
  ASSERT_EQ(seen.size(), 3u);
  for (const auto& [state, count] : seen) EXPECT_NEAR(count, 20'000, 577);
}

TEST(Start, FixedIsFixed) {
  const auto seen = frequencies(StartStates::fixed(2), 100);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen.begin()->first, 2u);
}

TEST(Start, EveryKindTakesOneDraw) {
  const Mdp mdp = row();
  for (StartStates starts : {StartStates::world(mdp), StartStates::uniform(mdp),
                             StartStates::fixed(0), StartStates::least_visited(mdp)}) {
    Rng rng = stream(1, "start"), expected = rng;
    expected.skip(1);
    starts.draw(rng, nobody);
    EXPECT_EQ(rng.state, expected.state);
  }
}

TEST(Start, AWorldOfEndsHasNoStart) {
  MdpBuilder builder(0.9);
  builder.move("A", "on", "END").terminal("A").start("A").start("END");
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp);
  EXPECT_TRUE(StartStates::world(*mdp).states().empty());
  EXPECT_TRUE(StartStates::uniform(*mdp).states().empty());
}

// Every draw is followed by one visit there: after 10 rounds each state has 10.
TEST(Start, LeastVisitedGoesRoundEvenly) {
  MdpBuilder builder(0.9);
  for (int i = 0; i < 7; ++i) builder.move("s" + std::to_string(i), "end", "END");
  const auto mdp = builder.build();
  ASSERT_TRUE(mdp);
  StartStates starts = StartStates::least_visited(*mdp);
  std::map<State, std::uint64_t> visits;
  Rng rng = stream(1, "start");
  for (int i = 0; i < 70; ++i) {
    ++visits[starts.draw(rng, [&](State s) { return visits[s]; })];
    std::uint64_t least = ~std::uint64_t{0}, most = 0;
    for (State s = 0; s < mdp->states(); ++s) {
      if (mdp->terminal(s)) continue;
      least = std::min(least, visits[s]);
      most = std::max(most, visits[s]);
    }
    EXPECT_LE(most - least, 1u);
  }
}

// States 0 and 2 were met 100 times on the way; the starts go where nobody was.
TEST(Start, LeastVisitedPrefersTheForgotten) {
  MdpBuilder builder(0.9);
  for (int i = 0; i < 4; ++i) builder.move("s" + std::to_string(i), "end", "END");
  const Mdp mdp = *builder.build();
  std::map<State, std::uint64_t> visits;
  const State often[] = {*mdp.find_state("s0"), *mdp.find_state("s2")};
  for (const State s : often) visits[s] = 100;
  StartStates starts = StartStates::least_visited(mdp);
  Rng rng = stream(1, "start");
  for (int i = 0; i < 200; ++i) ++visits[starts.draw(rng, [&](State s) { return visits[s]; })];
  for (const State s : often) EXPECT_EQ(visits[s], 100u);
  EXPECT_EQ(visits[*mdp.find_state("s1")], 100u);
  EXPECT_EQ(visits[*mdp.find_state("s3")], 100u);
}

TEST(Start, LeastVisitedGoesOnWhereItWasSaved) {
  const Mdp mdp = row();
  StartStates whole = StartStates::least_visited(mdp);
  std::map<State, std::uint64_t> visits;
  const auto count = [&](State s) { return visits[s]; };
  Rng rng = stream(1, "start");
  for (int i = 0; i < 5; ++i) ++visits[whole.draw(rng, count)];
  Archive out;
  whole.persist(out);
  StartStates loaded = StartStates::least_visited(mdp);
  Archive in{std::span<const std::byte>(out.bytes())};
  loaded.persist(in);
  ASSERT_TRUE(in.good());
  for (int i = 0; i < 20; ++i) {
    Rng same = rng;
    const State expected = whole.draw(rng, count);
    EXPECT_EQ(loaded.draw(same, count), expected);
    ++visits[expected];
  }
}

TEST(Start, ASavedCursorBeyondTheStatesIsRefused) {
  Archive out;
  std::uint64_t cursor = 99, level = 0, next = 0;
  out("cursor", cursor);
  out("level", level);
  out("next_level", next);
  StartStates starts = StartStates::least_visited(row());
  Archive in{std::span<const std::byte>(out.bytes())};
  starts.persist(in);
  EXPECT_FALSE(in.good());
}

}  // namespace
}  // namespace quoll
