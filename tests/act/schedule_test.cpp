#include "quoll/act/schedule.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

TEST(Schedule, ConstantStaysWhereItIs) {
  const auto schedule = parse_schedule("0.1", 0.0, 1.0, "--epsilon");
  ASSERT_TRUE(schedule);
  EXPECT_TRUE(schedule->constant());
  EXPECT_EQ(schedule->at(0), 0.1);
  EXPECT_EQ(schedule->at(~std::uint64_t{0}), 0.1);
}

// 1 + (0.5 - 1) * 3/8 = 0.8125, exact in binary.
TEST(Schedule, IsLinearInAbsoluteStepsAndThenConstant) {
  const auto schedule = parse_schedule("1:0.5:8", 0.0, 1.0, "--epsilon");
  ASSERT_TRUE(schedule);
  EXPECT_EQ(schedule->at(0), 1.0);
  EXPECT_EQ(schedule->at(3), 0.8125);
  EXPECT_EQ(schedule->at(8), 0.5);
  EXPECT_EQ(schedule->at(9), 0.5);
  EXPECT_EQ(schedule->at(~std::uint64_t{0}), 0.5);
}

TEST(Schedule, RefusesWhatIsNoSchedule) {
  for (const char* text : {"", "x", "1.5", "-0.1", "nan", "1:0", "1:0:0", "1:0:-3", "1:2:10",
                           "2:1:10", "1:0.5:8:9", "1:0.5:1.5"}) {
    const auto schedule = parse_schedule(text, 0.0, 1.0, "--epsilon");
    ASSERT_FALSE(schedule) << text;
    EXPECT_EQ(schedule.error().file, "--epsilon");
    EXPECT_NE(message(schedule.error()).find("[0, 1]"), std::string::npos);
  }
}

// 5 % of a span of 40 is 2.
TEST(Schedule, TakesSharesOfAWholeWhereThereIsOne) {
  const auto schedule = parse_schedule("5%:0.5%:8", 1e-9, 1e300, "--temperature", 40.0);
  ASSERT_TRUE(schedule);
  EXPECT_DOUBLE_EQ(schedule->from, 2.0);
  EXPECT_DOUBLE_EQ(schedule->to, 0.2);
  EXPECT_EQ(parse_schedule("3", 1e-9, 1e300, "--temperature", 40.0)->from, 3.0);
  for (const char* text : {"%", "0%", "x%", "5%%", "1:2:3%"}) {
    EXPECT_FALSE(parse_schedule(text, 1e-9, 1e300, "--temperature", 40.0)) << text;
  }
  EXPECT_FALSE(parse_schedule("5%", 0.0, 1.0, "--epsilon"));
}

}  // namespace
}  // namespace quoll
