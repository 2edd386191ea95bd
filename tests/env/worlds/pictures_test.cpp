#include <gtest/gtest.h>

#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;

std::string text(const World& world, State at) {
  return world.make({1, 1, 0, nullptr})->inspector()->text(0, at);
}

TEST(Pictures, TheAgentStandsInItsCell) {
  const World chain = made("chain");
  EXPECT_EQ(text(chain, 0), "@...G\n");
  EXPECT_EQ(text(chain, 4), "....@\n");
  const Drawing drawing = chain.make({1, 1, 0, nullptr})->inspector()->drawing(0, 3);
  EXPECT_EQ(drawing.width, 5.0);
  EXPECT_EQ(drawing.height, 1.0);
  ASSERT_EQ(drawing.shapes.size(), 6u);
  EXPECT_EQ(drawing.shapes.back().points.front(), std::pair(3.5, 0.5));
}

TEST(Pictures, OfALargeGridThePartAroundTheAgent) {
  const World chain = made("chain", {{"states", "1000"}});
  EXPECT_EQ(text(chain, 500), std::string(80, '.') + '@' + std::string(79, '.') + '\n');
  EXPECT_EQ(text(chain, 3), "...@" + std::string(156, '.') + '\n');
  EXPECT_EQ(text(chain, 998), std::string(158, '.') + "@G\n");
  const Drawing drawing = chain.make({1, 1, 0, nullptr})->inspector()->drawing(0, 998);
  EXPECT_EQ(drawing.width, 160.0);
  EXPECT_EQ(drawing.shapes.size(), 161u);
  EXPECT_EQ(drawing.shapes.back().points.front(), std::pair(158.5, 0.5));
}

}  // namespace
}  // namespace quoll
