#include "quoll/report/progress.hpp"

#include <gtest/gtest.h>

#include "quoll/base/utf8.hpp"

namespace quoll {
namespace {

TEST(Progress, NamesDurations) {
  EXPECT_EQ(duration_text(0.32), "0.3 s");
  EXPECT_EQ(duration_text(9.96), "10 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(2 * 3600 + 5 * 60), "2 h 5 min");
  EXPECT_EQ(duration_text(4 * 86400 + 3 * 3600), "4 d 3 h");
  EXPECT_EQ(duration_text(1e12), "very long");
}

TEST(Progress, ScalesCounts) {
  EXPECT_EQ(scaled_text(950), "950");
  EXPECT_EQ(scaled_text(999.7), "1 k");
  EXPECT_EQ(scaled_text(12345), "12.3 k");
  EXPECT_EQ(scaled_text(4.56e6), "4.56 M");
  EXPECT_EQ(scaled_text(1.2e9), "1.2 G");
}

// 25,000 of 50,000 in 2 s: 12.5 k/s, the other half takes 2 s more.
TEST(Progress, IsAPlainLineForPipes) {
  EXPECT_EQ(progress_line({.done = 25000, .total = 50000, .seconds = 2, .extra = "return 0.9"}),
            "50 %  25 k/50 k steps  12.5 k steps/s  ETA 2.0 s  return 0.9\n");
  EXPECT_EQ(progress_line({.done = 300, .seconds = 3}), "300 steps  100 steps/s\n");
  EXPECT_EQ(progress_line({}), "0 steps\n");
}

// A resumed run: 5,000 of the 10,000 steps are its own, so 5,000 a second and 10 s left.
TEST(Progress, DoesNotCountResumedStepsAsSpeed) {
  EXPECT_EQ(progress_line({.done = 10000, .total = 60000, .seconds = 1, .resumed = 5000}),
            "16 %  10 k/60 k steps  5 k steps/s  ETA 10 s\n");
}

// The words take 8 + 35 columns and one stays free: 16 of 60 are left for the bar.
TEST(Progress, BarIsDrawnAndFilled) {
  const Progress half{.done = 50, .total = 100, .seconds = 1};
  EXPECT_EQ(progress_bar(half, 60, false).substr(0, 22), "\r########--------  50 ");
}

TEST(Progress, BarCoversTheLineAndNeverWraps) {
  for (std::uint32_t width = 1; width < 130; ++width) {
    for (const std::uint64_t done : {0, 1, 37, 99, 100, 150}) {
      for (const bool unicode : {false, true}) {
        const Progress p{.done = done, .total = 100, .seconds = 0.5, .extra = "return 0.93"};
        const std::string bar = progress_bar(p, width, unicode);
        ASSERT_EQ(bar[0], '\r');
        ASSERT_EQ(display_width(bar), width - 1) << bar;
      }
    }
  }
}

}  // namespace
}  // namespace quoll
