#include "quoll/report/bounds_report.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

TEST(BoundsReport, NamesWhatIsAssumedOrSaysNothing) {
  BoundsReport report;
  EXPECT_EQ(assumed_text(report), "");
  report.assumptions = {"the world is deterministic"};
  EXPECT_EQ(assumed_text(report), "Assumed: the world is deterministic.\n");
  report.assumptions.push_back("rewards lie in [0, 1]");
  EXPECT_EQ(assumed_text(report), "Assumed: the world is deterministic; rewards lie in [0, 1].\n");
}

TEST(BoundsReport, NamesAtMostFivePairsThatBlock) {
  BoundsReport report;
  EXPECT_EQ(blocking_text(report), "");
  for (const char* state : {"A", "B", "C", "D", "E", "F"}) {
    report.blocking.push_back({state, "go", 1, 2});
  }
  report.needed = 1234;
  EXPECT_EQ(blocking_text(report),
            "Blocked by (A, go) tried 1 time, (B, go) tried 1 time, (C, go) tried 1 time, "
            "(D, go) tried 1 time, (E, go) tried 1 time; about 1,234 more samples are needed.\n");
}

}  // namespace
}  // namespace quoll
