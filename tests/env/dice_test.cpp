#include "quoll/env/dice.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace quoll {
namespace {

GuestDice tape(std::vector<double> numbers) {
  return GuestDice(std::make_shared<const std::vector<double>>(std::move(numbers)));
}

TEST(GuestDice, IsOneGeneratorForRealAndWholeNumbers) {
  GuestDice dice(42);
  NumpyRandom numpy(42);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(dice.uniform(), numpy.random());
    EXPECT_EQ(dice.below(13), numpy.integers(13));
  }
  EXPECT_TRUE(dice.good());
}

TEST(GuestDice, GivesOutATapeInOrder) {
  GuestDice dice = tape({0.25, 7, 0, 0.5, 0.0});
  EXPECT_EQ(dice.uniform(), 0.25);
  EXPECT_EQ(dice.below(8), 7u);
  EXPECT_EQ(dice.below(1), 0u);
  EXPECT_EQ(between(dice, -2.0, 4.0), 1.0);
  EXPECT_TRUE(chance(dice, 0.1));
  EXPECT_TRUE(dice.good());
}

TEST(GuestDice, SaysWhenATapeIsUsedUp) {
  GuestDice dice = tape({0.25});
  EXPECT_EQ(dice.uniform(), 0.25);
  EXPECT_TRUE(dice.good());
  EXPECT_EQ(dice.uniform(), 0.0);
  EXPECT_FALSE(dice.good());
}

TEST(GuestDice, SaysWhenANumberDoesNotFit) {
  GuestDice real = tape({1.0, 0.5});
  EXPECT_EQ(real.uniform(), 0.0);
  EXPECT_FALSE(real.good());
  GuestDice whole = tape({3});
  EXPECT_EQ(whole.below(3), 0u);
  EXPECT_FALSE(whole.good());
  GuestDice negative = tape({-1});
  EXPECT_EQ(negative.below(3), 0u);
  EXPECT_FALSE(negative.good());
}

TEST(GuestDice, GoesOnWhereItWasSaved) {
  GuestDice dice = tape({0.1, 0.2, 0.3}), again = tape({0.1, 0.2, 0.3});
  dice.uniform();
  Archive out;
  out("dice", dice);
  Archive in{std::span<const std::byte>(out.bytes())};
  in("dice", again);
  ASSERT_TRUE(in.good() && in.at_end());
  EXPECT_EQ(again.uniform(), 0.2);
}

// The first running sum above the draw; the last one takes the rest.
TEST(Dice, PickByRunningSums) {
  const double sums[] = {0.25, 0.25, 0.75, 1.0 - 1e-16};
  GuestDice dice = tape({0.0, 0.25, 0.5, 0.75, 1.0 - 0x1p-53});
  EXPECT_EQ(pick(dice, sums), 0u);
  EXPECT_EQ(pick(dice, sums), 2u);
  EXPECT_EQ(pick(dice, sums), 2u);
  EXPECT_EQ(pick(dice, sums), 3u);
  EXPECT_EQ(pick(dice, sums), 3u);
}

}  // namespace
}  // namespace quoll
