#include "quoll/learn/tabular/stability.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

Stability watching(std::uint32_t visits, double tolerance, std::uint64_t pairs) {
  return Stability({true, visits, tolerance, pairs}, 4);
}

TEST(Stability, OneVisitOfEachPairWithoutMovement) {
  Stability stability = watching(1, 0.0, 3);
  EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));
  EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));  // the same pair counts once
  EXPECT_FALSE(stability.visited(1, 0.0, 1.0, false));
  EXPECT_TRUE(stability.visited(2, 0.0, 1.0, false));
}

TEST(Stability, AMovementOrANewGreedySetBeginsAgain) {
  for (const bool by_value : {true, false}) {
    Stability stability = watching(1, 0.0, 2);
    EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));
    EXPECT_FALSE(stability.visited(1, by_value ? 1e-30 : 0.0, 1.0, !by_value));
    EXPECT_FALSE(stability.visited(1, 0.0, 1.0, false));
    EXPECT_TRUE(stability.visited(0, 0.0, 1.0, false));
  }
}

TEST(Stability, NoNumberIsAMovement) {
  Stability stability = watching(1, 1.0, 1);
  EXPECT_FALSE(stability.visited(0, std::nan(""), 1.0, false));
}

// K = 4, tolerance 0.5: errors 1, -1, 1, 1 have the mean 0.5: within. Errors 1, 1, 1, 0 have 0.75.
TEST(Stability, TheMeanErrorOfKVisitsCounts) {
  Stability stability = watching(4, 0.5, 1);
  for (const double error : {1.0, -1.0, 1.0}) {
    EXPECT_FALSE(stability.visited(0, error, 1.0, false));
  }
  EXPECT_TRUE(stability.visited(0, 1.0, 1.0, false));
  Stability moving = watching(4, 0.5, 1);
  for (const double error : {1.0, 1.0, 1.0, 0.0}) {
    EXPECT_FALSE(moving.visited(0, error, 1.0, false));
  }
  // The tolerance is relative to the value: 0.75 <= 0.5 * 2.
  Stability large = watching(4, 0.5, 1);
  for (const double error : {1.0, 1.0, 1.0}) large.visited(0, error, 2.0, false);
  EXPECT_TRUE(large.visited(0, 0.0, 2.0, false));
}

// After it has settled, every K further visits are tested too, and settle nothing twice.
TEST(Stability, ASettledPairIsTestedAgain) {
  Stability stability = watching(2, 0.5, 2);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));
  stability.visited(0, 4.0, 1.0, false);
  EXPECT_FALSE(stability.visited(0, 4.0, 1.0, false));  // begins again
  EXPECT_FALSE(stability.visited(1, 0.0, 1.0, false));
  EXPECT_FALSE(stability.visited(1, 0.0, 1.0, false));
  EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));
  EXPECT_TRUE(stability.visited(0, 0.0, 1.0, false));
}

// 2^20 visits stand for the 2^32 that would overflow a plain count: the same test again and again.
TEST(Stability, AnyNumberOfVisitsOfOnePairSettlesOne) {
  Stability stability = watching(1, 0.0, 2);
  for (int i = 0; i < 1 << 20; ++i) ASSERT_FALSE(stability.visited(0, 0.0, 1.0, false));
}

TEST(Stability, WithoutAModelThePairsMetCount) {
  Stability stability = watching(1, 0.0, 0);
  EXPECT_TRUE(stability.counts_met());
  stability.met(2);
  EXPECT_FALSE(stability.visited(0, 0.0, 1.0, false));
  stability.met(1);
  EXPECT_FALSE(stability.visited(1, 0.0, 1.0, false));
  EXPECT_TRUE(stability.visited(2, 0.0, 1.0, false));
}

TEST(Stability, GoesOnWhereItWasSaved) {
  Stability stability = watching(2, 0.5, 2);
  stability.visited(0, 0.25, 1.0, false);
  stability.visited(0, 0.25, 1.0, false);
  stability.visited(1, 1.0, 1.0, false);
  Archive out;
  stability.persist(out);
  Stability loaded = watching(2, 0.5, 2);
  Archive in{std::span<const std::byte>(out.bytes())};
  loaded.persist(in);
  ASSERT_TRUE(in.good() && in.at_end());
  EXPECT_TRUE(loaded.visited(1, -1.0, 1.0, false));

  Stability other({true, 2, 0.5, 2}, 5);
  Archive again{std::span<const std::byte>(out.bytes())};
  other.persist(again);
  EXPECT_FALSE(again.good());
}

}  // namespace
}  // namespace quoll
