#include "quoll/report/grid_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "quoll/base/utf8.hpp"
#include "tests/report/worlds.hpp"

namespace quoll {
namespace {

using testing::Solved;

GridView view_of(const Solved& world) {
  GridView view;
  view.mdp = &world.mdp;
  view.value = world.value;
  view.policy = world.policy;
  view.optimal = world.optimal;
  return view;
}

// Distances to G by hand: the upper row 4 3 2 1, the lower row 5 4 # G(0).
Solved small() {
  return testing::solved(testing::grid_world({"S...", "..#G"}));
}

TEST(GridText, ShowsThePolicy) {
  const Solved world = small();
  EXPECT_EQ(*grid_policy_text(view_of(world), {.width = 80, .unicode = false}),
            "S > > v\n"
            "^ ^ # G\n"
            "# wall  S start (its move >)  G goal\n");
  EXPECT_EQ(*grid_policy_text(view_of(world), {.width = 80, .unicode = true}),
            "S → → ↓\n"
            "↑ ↑ █ G\n"
            "█ wall  S start (its move →)  G goal\n");
}

// Values -4 -3 -2 -1 / -5 -4: shares of -5 .. -1 are 0.25 0.5 0.75 1 / 0 0.25.
TEST(GridText, ShowsHeatAsDigits) {
  const Solved world = small();
  EXPECT_EQ(*grid_heat_text(view_of(world), {.width = 80, .unicode = false}),
            "S 557799\n"
            "0022##G\n"
            "-5 0123456789 -1  # wall\n");
}

TEST(GridText, ColoursOnlyWhenAsked) {
  const Solved world = small();
  const auto policy = *grid_policy_text(view_of(world), {.width = 80, .color = true});
  EXPECT_NE(policy.find("\x1b[38;5;"), std::string::npos);
  const auto heat = *grid_heat_text(view_of(world), {.width = 80, .color = false});
  EXPECT_EQ(heat.find('\x1b'), std::string::npos);
}

TEST(GridText, TellsPitsFromGoals) {
  const Solved world = testing::solved(testing::grid_world({"S.G", "..P"}));
  EXPECT_EQ(*grid_policy_text(view_of(world), {.unicode = false}),
            "S > G\n^ ^ P\n# wall  S start (its move >)  G goal  P pit\n");
}

TEST(GridText, CropsAroundTheStartAndSaysSo) {
  std::vector<std::string> rows(100, std::string(200, '.'));
  rows[50][190] = 'S';
  rows[0][0] = 'G';
  const Solved world = testing::solved(testing::grid_world(rows), 1);
  const std::string text = *grid_policy_text(view_of(world), {.width = 40, .unicode = false});
  EXPECT_NE(text.find("rows 20-79 and columns 160-199 of 100 x 200"), std::string::npos) << text;
  EXPECT_NE(text.find('S'), std::string::npos);
  std::istringstream lines(text.substr(0, text.find('#')));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), 40U);
}

TEST(GridText, SamplesHeatDownAndSaysSo) {
  const std::vector<std::string> rows(90, std::string(90, '.'));
  std::vector<std::string> open = rows;
  open[89][89] = 'G';
  const Solved world = testing::solved(testing::grid_world(open), 1);
  const std::string text = *grid_heat_text(view_of(world), {.width = 40, .unicode = false});
  EXPECT_NE(text.find("each letter is the mean of 3 x 3 cells of 90 x 90"), std::string::npos);
  EXPECT_EQ(text.find('\n'), 30U);
}

TEST(GridText, RefusesWorldsWithoutCells) {
  const Solved world = testing::solved(testing::adventure());
  const auto text = grid_policy_text(view_of(world), {});
  ASSERT_FALSE(text);
  EXPECT_NE(message(text.error()).find("show WORLD graph"), std::string::npos);
  EXPECT_FALSE(grid_heat_text(view_of(world), {}));
}

}  // namespace
}  // namespace quoll
