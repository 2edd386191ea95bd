#include "quoll/env/branches.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "quoll/env/dice.hpp"

namespace quoll {
namespace {

// What `draw` gives on all paths, with the probability of each.
template <class Draw>
std::map<std::string, double> all(const Draw& draw, std::string* fault = nullptr) {
  std::map<std::string, double> found;
  Branches dice;
  dice.begin();
  do {
    const std::string what = draw(dice);
    found[what] += dice.probability();
  } while (dice.next());
  if (fault) *fault = dice.fault();
  return found;
}

using Found = std::map<std::string, double>;

TEST(Branches, WholeNumbersAreEquallyLikely) {
  const Found found = all([](Branches& dice) { return std::to_string(dice.below(4)); });
  EXPECT_EQ(found, (Found{{"0", 0.25}, {"1", 0.25}, {"2", 0.25}, {"3", 0.25}}));
}

TEST(Branches, OneValueIsCertain) {
  int calls = 0;
  const Found found = all([&](Branches& dice) {
    ++calls;
    return std::to_string(dice.below(1)) + (chance(dice, 1.0) ? "y" : "n") +
           (chance(dice, 0.0) ? "y" : "n") + std::to_string(between(dice, 2.0, 2.0));
  });
  EXPECT_EQ(found, (Found{{"0yn2.000000", 1.0}}));
  EXPECT_EQ(calls, 1);
}

// 1/4 heads, and only then one of two: 1/8, 1/8, 3/4.
TEST(Branches, WhatIsDrawnDependsOnWhatWasDrawn) {
  const Found found = all([](Branches& dice) {
    return chance(dice, 0.25) ? "heads" + std::to_string(dice.below(2)) : std::string("tails");
  });
  EXPECT_EQ(found, (Found{{"heads0", 0.125}, {"heads1", 0.125}, {"tails", 0.75}}));
}

TEST(Branches, PickTakesDifferencesOfRunningSums) {
  const std::array<double, 4> sums{0.25, 0.25, 0.75, 1.0};
  const Found found = all([&](Branches& dice) { return std::to_string(pick(dice, sums)); });
  EXPECT_EQ(found, (Found{{"0", 0.25}, {"2", 0.5}, {"3", 0.25}}));
}

// One number compared twice: below 1/2 it is also below 3/4.
TEST(Branches, ComparisonsOfOneNumberAgree) {
  const Found found = all([](Branches& dice) {
    const auto draw = dice.uniform();
    std::string text = draw < 0.5 ? "low" : "high";
    text += 0.75f > draw ? "-below" : "-above";
    text += draw <= 0 ? "?" : draw >= 1 ? "!" : "";
    return text;
  });
  EXPECT_EQ(found, (Found{{"low-below", 0.5}, {"high-below", 0.25}, {"high-above", 0.25}}));
}

TEST(Branches, ARealNumberForItselfIsAFault) {
  std::string fault;
  all([](Branches& dice) { return std::to_string(between(dice, 0.0, 1.0)); }, &fault);
  EXPECT_EQ(fault, "draws a real number, of which there are too many to list");
}

TEST(Branches, DrawingUntilSomethingFitsIsAFaultAndEnds) {
  std::string fault;
  all(
      [](Branches& dice) {
        std::uint32_t drawn = dice.below(3);
        while (drawn == 0) drawn = dice.below(3);
        return std::to_string(drawn);
      },
      &fault);
  EXPECT_EQ(fault, "draws more than 1,000 numbers");
}

TEST(Branches, AStepWithAMemoryIsAFault) {
  std::string fault;
  std::uint32_t calls = 0;
  all([&](Branches& dice) { return std::to_string(dice.below(2 + calls++)); }, &fault);
  EXPECT_EQ(fault, "does not draw the same numbers when it is repeated");
  calls = 0;
  all([&](Branches& dice) { return std::to_string(calls++ > 0 ? 0 : dice.below(2)); }, &fault);
  EXPECT_EQ(fault, "does not draw the same numbers when it is repeated");
}

}  // namespace
}  // namespace quoll
