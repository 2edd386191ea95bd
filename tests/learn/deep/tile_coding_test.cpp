#include "quoll/learn/deep/tile_coding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace quoll {
namespace {

const std::vector<Measured> two{{"x", 0.0, 4.0}, {"y", -1.0, 1.0}};

std::vector<std::uint32_t> coded(const TileCoder& coder, std::vector<float> x) {
  std::vector<std::uint32_t> on(coder.tilings());
  coder.code(x, on);
  return on;
}

// 4 x 2 tiles make 5 x 3 cells a tiling. Tiling 1 of 2 is shifted by 1/2 tile along x and, as 3/2
// modulo 1, by 1/2 along y. (1.25, 0.25) lies at 1.25 and 1.25 tiles.
TEST(TileCoder, OneFeatureOfEachShiftedGridIsOn) {
  const auto coder = TileCoder::make(two, 2, "4,2");
  ASSERT_TRUE(coder);
  EXPECT_EQ(coder->features(), 30u);
  EXPECT_EQ(coded(*coder, {1.25f, 0.25f}), (std::vector<std::uint32_t>{1 * 3 + 1, 15 + 1 * 3 + 1}));
  EXPECT_EQ(coded(*coder, {1.75f, 0.75f}), (std::vector<std::uint32_t>{1 * 3 + 1, 15 + 2 * 3 + 2}));
}

TEST(TileCoder, WhatIsOutsideCountsAsTheEnd) {
  const auto coder = TileCoder::make(two, 4, "4");
  ASSERT_TRUE(coder);
  EXPECT_EQ(coded(*coder, {-7.0f, -9.0f}), coded(*coder, {0.0f, -1.0f}));
  EXPECT_EQ(coded(*coder, {1e30f, INFINITY}), coded(*coder, {4.0f, 1.0f}));
  EXPECT_EQ(coded(*coder, {NAN, 0.0f}), coded(*coder, {0.0f, 0.0f}));
}

// With shifts of (1, 3, 5) / 8 tiles no two tilings cut at the same places.
TEST(TileCoder, TilingsCutAtDifferentPlaces) {
  const std::vector<Measured> line{{"x", 0.0, 1.0}};
  const auto coder = TileCoder::make(line, 8, "1");
  ASSERT_TRUE(coder);
  std::set<std::vector<std::uint32_t>> seen;
  for (int i = 0; i < 8; ++i) seen.insert(coded(*coder, {(static_cast<float>(i) + 0.5f) / 8}));
  EXPECT_EQ(seen.size(), 8u);
}

TEST(TileCoder, EveryFeatureIsBelowTheirNumber) {
  const auto coder = TileCoder::make(two, 7, "3,5");
  ASSERT_TRUE(coder);
  for (float x = -1; x <= 5; x += 0.37f) {
    for (float y = -2; y <= 2; y += 0.21f) {
      const std::vector<std::uint32_t> on = coded(*coder, {x, y});
      for (std::uint32_t t = 0; t < 7; ++t) {
        EXPECT_EQ(on[t] / (coder->features() / 7), t);
      }
    }
  }
}

TEST(TileCoder, RefusesCountsThatDoNotFit) {
  const auto refusal = [](std::string_view tiles, std::uint64_t tilings) {
    const auto coder = TileCoder::make(two, tilings, tiles);
    return coder ? std::string("none") : message(coder.error());
  };
  EXPECT_EQ(
      refusal("4,4,4", 8),
      "--tiles: a whole number from 1 up expected, or one for each of the 2 observed numbers, "
      "not '4,4,4'");
  EXPECT_EQ(
      refusal("0", 8),
      "--tiles: a whole number from 1 up expected, or one for each of the 2 observed numbers, "
      "not '0'");
  EXPECT_EQ(refusal("9999", 8),
            "--tiles: so many tiles for 2 numbers are more than 67108864 features; give fewer");
}

}  // namespace
}  // namespace quoll
