#include "quoll/experiment/learning_curve.hpp"

#include <gtest/gtest.h>

namespace quoll {
namespace {

// One episode of return 1 every 16 steps, told to the curve in chunks of `chunk` steps.
LearningCurve told(std::uint64_t steps, std::uint64_t chunk) {
  LearningCurve curve;
  std::uint64_t step = 0;
  while (step < steps) {
    step = std::min({step + chunk, curve.boundary(), steps});
    curve.advance(step, step / 16, static_cast<double>(step / 16));
  }
  return curve;
}

// 64 steps hold 4 episodes.
TEST(LearningCurve, ABinHoldsTheEpisodesThatEndedInIt) {
  LearningCurve curve;
  EXPECT_EQ(curve.boundary(), 64u);
  EXPECT_FALSE(curve.advance(40, 2, 10.0));
  EXPECT_EQ(curve.open().episodes, 2u);
  EXPECT_TRUE(curve.advance(64, 4, 16.0));
  ASSERT_EQ(curve.bins().size(), 1u);
  EXPECT_EQ(curve.bins()[0].episodes, 4u);
  EXPECT_EQ(curve.bins()[0].mean(), 4.0);
  EXPECT_EQ(curve.open().episodes, 0u);
  EXPECT_EQ(curve.boundary(), 128u);
  EXPECT_TRUE(curve.advance(128, 4, 16.0));
  EXPECT_EQ(curve.bins()[1].episodes, 0u);
}

// 100 lanes walk 100 steps a round: the end of a bin is met a little later, and of bins that a
// round jumps over the last has its episodes.
TEST(LearningCurve, RoundsOfLanesMayRunOverAnEnd) {
  LearningCurve curve;
  EXPECT_TRUE(curve.advance(100, 3, 6.0));
  EXPECT_EQ(curve.boundary(), 128u);
  EXPECT_TRUE(curve.advance(200, 5, 10.0));
  ASSERT_EQ(curve.bins().size(), 3u);
  EXPECT_EQ(curve.bins()[0].episodes, 3u);
  EXPECT_EQ(curve.bins()[1].episodes, 0u);
  EXPECT_EQ(curve.bins()[2].episodes, 2u);
  EXPECT_EQ(curve.boundary(), 256u);
}

// 512 bins of 64 steps are full at 32,768 steps: 256 of 128 remain; they are full at 65,536.
TEST(LearningCurve, NeighboursAreJoinedWhenAllBinsAreFull) {
  const LearningCurve before = told(32'767, 1000);
  EXPECT_EQ(before.bins().size(), 511u);
  EXPECT_EQ(before.width(), 64u);
  const LearningCurve joined = told(32'768, 1000);
  EXPECT_EQ(joined.bins().size(), 256u);
  EXPECT_EQ(joined.width(), 128u);
  EXPECT_EQ(joined.boundary(), 32'896u);
  for (const LearningCurve::Bin& bin : joined.bins()) EXPECT_EQ(bin.episodes, 8u);
  const LearningCurve later = told(100'000, 1000);
  EXPECT_EQ(later.width(), 256u);
  std::uint64_t sum = later.open().episodes;
  for (const LearningCurve::Bin& bin : later.bins()) sum += bin.episodes;
  EXPECT_EQ(sum, 6250u);
}

TEST(LearningCurve, DependsOnTheStepsAlone) {
  Archive whole, parts;
  LearningCurve a = told(70'000, 100'000), b = told(70'000, 7);
  a.persist(whole);
  b.persist(parts);
  EXPECT_EQ(whole.bytes(), parts.bytes());
  LearningCurve loaded;
  Archive in{std::span<const std::byte>(whole.bytes())};
  loaded.persist(in);
  ASSERT_TRUE(in.good() && in.at_end());
  EXPECT_EQ(loaded.boundary(), a.boundary());
  EXPECT_EQ(loaded.open().episodes, a.open().episodes);
}

TEST(LearningCurve, ASavedCurveThatCannotBeIsRefused) {
  LearningCurve curve;
  Archive out;
  std::uint64_t zero = 0;
  std::vector<LearningCurve::Bin> bins;
  double sum = 0.0;
  out("width", zero);
  out("bins", bins);
  out("episodes", zero);
  out("closed_episodes", zero);
  out("return_sum", sum);
  out("closed_return_sum", sum);
  Archive in{std::span<const std::byte>(out.bytes())};
  curve.persist(in);
  EXPECT_FALSE(in.good());
  EXPECT_EQ(curve.boundary(), 64u);
}

}  // namespace
}  // namespace quoll
