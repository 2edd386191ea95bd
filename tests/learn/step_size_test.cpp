#include "quoll/learn/step_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quoll {
namespace {

StepSize parsed(std::string_view text, bool deterministic = false, double discount = 0.9) {
  const auto step = parse_step_size(text, deterministic, discount);
  EXPECT_TRUE(step) << text;
  return step ? *step : StepSize();
}

TEST(StepSize, AutoIsOneWithoutNoiseAndRescaledLinearUnderIt) {
  EXPECT_TRUE(parsed("auto", true).one());
  EXPECT_EQ(parsed("auto", false).kind, StepSize::Kind::rescaled_linear);
}

// H = 1 / (1 - 0.75) = 4: (4 + 1) / (4 + N).
TEST(StepSize, RescaledLinear) {
  const StepSize step = parsed("rescaled-linear", false, 0.75);
  EXPECT_EQ(step.at(1), 1.0);
  EXPECT_EQ(step.at(6), 0.5);
  EXPECT_EQ(step.at(96), 0.05);
  EXPECT_EQ(parsed("rescaled-linear", false, 1.0).value, 1000.0);
  EXPECT_GT(step.at(std::numeric_limits<std::uint32_t>::max()), 0.0);
}

TEST(StepSize, OneOverN) {
  const StepSize step = parsed("1/N");
  for (const std::uint32_t n : {1u, 2u, 3u, 10u, 4095u, 4096u, 1'000'000'007u, 4294967295u}) {
    EXPECT_EQ(step.at(n), 1.0 / n) << n;
  }
}

TEST(StepSize, PowersOfN) {
  const StepSize step = parsed("1/N^0.75");
  EXPECT_EQ(step.at(1), 1.0);
  EXPECT_NEAR(step.at(16), 0.125, 1e-15);
  EXPECT_NEAR(step.at(65536), 0x1p-12, 1e-15);
  // The table of small N and the formula beyond it join.
  EXPECT_NEAR(step.at(4095) / step.at(4096), std::pow(4096.0 / 4095.0, 0.75), 1e-12);
}

TEST(StepSize, Constant) {
  const StepSize step = parsed("0.25");
  EXPECT_EQ(step.at(1), 0.25);
  EXPECT_EQ(step.at(4294967295u), 0.25);
  EXPECT_FALSE(step.one());
  EXPECT_FALSE(step.small());
  EXPECT_TRUE(parsed("1e-6").small());
  EXPECT_TRUE(parsed("1/N").small());
}

TEST(StepSize, TextIsTakenBack) {
  for (const char* text : {"1", "0.25", "1e-06", "1/N^0.8", "1/N^1", "rescaled-linear"}) {
    const StepSize step = parsed(text), again = parsed(step.text());
    EXPECT_EQ(again.kind, step.kind);
    EXPECT_EQ(again.value, step.value);
  }
}

TEST(StepSize, RefusesTheRest) {
  for (const char* text :
       {"", "0", "-1", "1.5", "nan", "inf", "1/N^0.5", "1/N^1.1", "1/N^", "1/M", "often"}) {
    EXPECT_FALSE(parse_step_size(text, false, 0.9)) << text;
  }
}

}  // namespace
}  // namespace quoll
