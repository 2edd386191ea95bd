#include "quoll/model/check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

std::vector<Finding> findings_of(const MdpBuilder& builder) {
  const auto mdp = builder.build();
  EXPECT_TRUE(mdp) << message(mdp.error());
  return check(*mdp);
}

TEST(Check, FindsNothingInASoundModel) {
  MdpBuilder builder(0.8);
  builder.move("A", "on", "B").move("B", "on", "END", 100.0).move("B", "back", "A");
  EXPECT_TRUE(findings_of(builder).empty());
  MdpBuilder endless(0.8);  // a world meant to go on for ever
  endless.move("A", "on", "B", 1.0).move("B", "on", "A");
  EXPECT_TRUE(findings_of(endless).empty());
}

TEST(Check, UnreachableStatesAndDeadEnds) {
  MdpBuilder builder(0.8);
  builder.move("A", "on", "END").move("A", "trap", "PIT").move("PIT", "stay", "PIT");
  builder.move("ISLE", "on", "END").start("A");
  const auto findings = findings_of(builder);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].kind, "unreachable");
  EXPECT_EQ(findings[0].severity, Finding::Severity::warning);
  EXPECT_EQ(findings[0].sentence, "state ISLE cannot be reached from the start");
  EXPECT_EQ(findings[1].kind, "dead-end");
  EXPECT_EQ(findings[1].sentence, "state PIT is a dead end: no end can be reached from it");
}

TEST(Check, NamesAtMostTen) {
  MdpBuilder builder(0.8);
  builder.move("A", "on", "END").start("A");
  for (int i = 0; i < 12; ++i) builder.move("x" + std::to_string(i), "on", "END");
  const auto findings = findings_of(builder);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].count, 12u);
  EXPECT_EQ(findings[0].names.size(), 10u);
  EXPECT_EQ(findings[0].sentence,
            "12 states cannot be reached from the start: x0, x1, x2, x3, x4, x5, x6, x7, x8, x9 "
            "and 2 more");
}

TEST(Check, UndiscountedValuesThatAreNotDefined) {
  MdpBuilder trap(1.0);
  trap.move("A", "on", "END").move("A", "trap", "PIT").move("PIT", "stay", "PIT", -1.0);
  auto findings = findings_of(trap);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "no-end");
  EXPECT_EQ(findings[0].severity, Finding::Severity::error);
  EXPECT_EQ(findings[0].sentence,
            "state PIT cannot reach an end, so with discount 1 its value is not defined");

  MdpBuilder mint(1.0);
  mint.move("A", "on", "B", 2.0).move("B", "on", "A", -1.0).move("A", "out", "END");
  findings = findings_of(mint);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "gaining-cycle");
  EXPECT_EQ(findings[0].sentence,
            "2 states form a cycle that earns for ever, so with discount 1 values are not defined: "
            "A, B");
}

TEST(Check, DiscountThatUnderflows) {
  // From s0 the reward of 10 comes with move 40: 0.1^39 * 10 = 1e-38, below 2^-126 = 1.175e-38.
  for (const int length : {39, 40}) {
    MdpBuilder builder(0.1);
    for (int i = 0; i < length; ++i) {
      builder.move("s" + std::to_string(i), "on", "s" + std::to_string(i + 1),
                   i + 1 == length ? 10.0 : 0.0);
    }
    const auto findings = findings_of(builder);
    if (length == 39) {
      EXPECT_TRUE(findings.empty());
      continue;
    }
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].kind, "underflow");
    EXPECT_EQ(findings[0].sentence,
              "discount 0.1 underflows: over the longest of the shortest paths, 40 moves, a reward "
              "of 10 counts 1e-38, below 1.18e-38, the smallest normal float of a learned table");
  }
}

TEST(Check, RemarksOfTheReader) {
  MdpBuilder builder(0.5);
  builder.move("A", "on", "END");
  auto arrays = builder.arrays();
  ASSERT_TRUE(arrays);
  arrays->remarks = {"state A, action on: successor END stands twice"};
  const auto mdp = Mdp::make(*std::move(arrays));
  ASSERT_TRUE(mdp);
  const auto findings = check(*mdp);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "duplicate");
  EXPECT_EQ(findings[0].sentence, "state A, action on: successor END stands twice");
}

TEST(CheckArrays, ReportsEveryFaultOfAFile) {
  MdpBuilder builder(1.5);
  builder.move("A", "on", "END", std::nan(""));
  builder.move("B", "on", "END", 0.0, 0.5);
  builder.move("C", "on", "END", 0.0, 0.25);
  builder.move("D", "on", "END", 0.0, -1.0);
  auto arrays = builder.arrays();
  ASSERT_TRUE(arrays);
  arrays->choice_line = {4, 5, 6, 7};
  const auto findings = check_arrays(*arrays);
  ASSERT_EQ(findings.size(), 4u);
  EXPECT_EQ(findings[0].kind, "discount");
  EXPECT_EQ(findings[0].sentence, "discount 1.5 is outside (0, 1]");
  EXPECT_EQ(findings[1].kind, "reward");
  EXPECT_EQ(findings[1].sentence, "state A, action on: reward nan, expected a finite number");
  EXPECT_EQ(findings[1].line, 4u);
  EXPECT_EQ(findings[2].kind, "row-sum");
  EXPECT_EQ(findings[2].sentence,
            "state B, action on: probabilities sum to 0.5, expected 1; also at state C, action on");
  EXPECT_EQ(findings[2].count, 2u);
  EXPECT_EQ(findings[2].line, 5u);
  EXPECT_EQ(findings[3].kind, "probability");
  for (const Finding& finding : findings) EXPECT_EQ(finding.severity, Finding::Severity::error);
}

TEST(CheckArrays, CountsWhatItDoesNotName) {
  MdpBuilder builder(1.0);
  for (int i = 0; i < 13; ++i) builder.move("s" + std::to_string(i), "on", "END", 0.0, 0.5);
  const auto findings = check_arrays(*builder.arrays());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].count, 13u);
  EXPECT_EQ(findings[0].names.size(), 10u);
  EXPECT_TRUE(findings[0].sentence.ends_with("state s9, action on and 3 more"));
}

TEST(CheckArrays, ShapeIsTheOnlyFindingIfTheArraysDoNotFit) {
  MdpArrays arrays;
  arrays.choice_begin = {0, 1};
  arrays.discount = 7.0;
  const auto findings = check_arrays(arrays);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "shape");
}

}  // namespace
}  // namespace quoll
