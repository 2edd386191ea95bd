// Prioritised replay: how often each transition is drawn, and what it weighs then.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "quoll/learn/deep/priorities.hpp"

namespace quoll {
namespace {

// Errors of 4 and 1/4 with alpha 1/2: priorities of 2 and 1/2.
Priorities two() {
  Priorities all(6, 0.5);
  all.add(3);
  all.add(5);
  all.set(3, 4.0);
  all.set(5, 0.25);
  return all;
}

TEST(Priorities, WhatWasNeverDrawnCountsAsMuchAsAnyDid) {
  Priorities all(6, 0.5);
  all.add(0);
  EXPECT_EQ(all[0], 1.0);
  all.set(0, 0.25);
  all.add(1);
  EXPECT_EQ(all[1], 1.0);
  all.set(1, 4.0);
  EXPECT_NEAR(all[0], 0.5, 1e-5);
  EXPECT_NEAR(all[1], 2.0, 1e-5);
  all.set(1, 0.0);
  EXPECT_NEAR(all[1], 1e-3, 1e-9);  // never 0: it may be drawn again
  all.add(2);
  EXPECT_NEAR(all[2], 2.0, 1e-5);
  all.forget(2);
  EXPECT_EQ(all[2], 0.0);
  EXPECT_NEAR(all.total(), 0.501, 1e-5);
}

// Four parts of the sum lie in the first, one in the second.
TEST(Priorities, EachPartOfTheSumIsDrawnOnce) {
  const Priorities all = two();
  Rng rng = stream(1, "test");
  std::array<std::uint64_t, 5> slots{};
  std::array<float, 5> weights{};
  for (int time = 0; time < 100; ++time) {
    all.draw(rng, 2, 1.0, slots, weights);
    EXPECT_EQ(slots, (std::array<std::uint64_t, 5>{3, 3, 3, 3, 5}));
  }
}

TEST(Priorities, OneAloneIsDrawnAsOftenAsItsShare) {
  const Priorities all = two();
  Rng rng = stream(1, "test");
  std::array<std::uint64_t, 1> slot{};
  std::array<float, 1> weight{};
  int first = 0;
  for (int time = 0; time < 10'000; ++time) {
    all.draw(rng, 2, 1.0, slot, weight);
    first += slot[0] == 3 ? 1 : 0;
    EXPECT_EQ(weight[0], 1.0F);
  }
  EXPECT_NEAR(first, 8000, 160);  // four deviations
}

TEST(Priorities, WhatIsDrawnMoreOftenWeighsLess) {
  const Priorities all = two();
  Rng rng = stream(1, "test");
  std::array<std::uint64_t, 5> slots{};
  std::array<float, 5> weights{};
  for (const double beta : {0.0, 0.5, 1.0}) {
    all.draw(rng, 2, beta, slots, weights);
    EXPECT_NEAR(weights[0], std::pow(0.25, beta), 1e-5);
    EXPECT_EQ(weights[4], 1.0F);  // the largest
  }
}

}  // namespace
}  // namespace quoll
