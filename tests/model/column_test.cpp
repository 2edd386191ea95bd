#include "quoll/model/column.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "quoll/base/random.hpp"

namespace quoll {
namespace {

TEST(Column, KeepsEveryNumberBeforeAndAfterThe257thDifferentOne) {
  Column column;
  std::vector<double> expected;
  Rng dice = stream(1, "column");
  for (int i = 0; i < 2000; ++i) {
    // The first thousand numbers are among 256, then come others.
    const double value = i < 1000 ? 1.0 / (1 + dice.below(256)) : dice.uniform();
    column.push_back(value);
    expected.push_back(value);
    if (i == 999) {
      EXPECT_TRUE(column.coded());
      EXPECT_LE(column.different(), 256u);
    }
  }
  EXPECT_FALSE(column.coded());
  ASSERT_EQ(column.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(column[i], expected[i]) << i;
  EXPECT_TRUE(column == Column(expected));
}

TEST(Column, SetsAndTruncatesInBothForms) {
  for (const std::size_t different : {3u, 1000u}) {
    Column column;
    for (std::size_t i = 0; i < 1000; ++i) {
      column.push_back(static_cast<double>(i % different));
    }
    EXPECT_EQ(column.coded(), different == 3);
    column.set(5, 0.125);
    column.truncate(10);
    column.trim();
    column.set(6, -7.5);  // after trim() too
    ASSERT_EQ(column.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) {
      const double expected = i == 5 ? 0.125 : i == 6 ? -7.5 : static_cast<double>(i % different);
      EXPECT_EQ(column[i], expected);
    }
  }
}

TEST(Column, TellsZeroFromMinusZeroAndKeepsNaN) {
  const Column column{0.0, -0.0, std::nan(""), 0.0};
  EXPECT_FALSE(std::signbit(column[0]));
  EXPECT_TRUE(std::signbit(column[1]));
  EXPECT_TRUE(std::isnan(column[2]));
  EXPECT_FALSE(std::signbit(column[3]));
}

TEST(Column, FewNumbersTakeAByteEach) {
  Column column;
  column.assign(1'000'000, 0.5);
  column.set(3, 0.25);
  EXPECT_LE(column.bytes(), 1'010'000u);
  EXPECT_EQ(column[3], 0.25);
  EXPECT_EQ(column.back(), 0.5);
}

}  // namespace
}  // namespace quoll
