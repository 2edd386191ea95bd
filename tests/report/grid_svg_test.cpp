#include "quoll/report/grid_svg.hpp"

#include "tests/report/picture.hpp"
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

std::size_t count(const Picture& picture, const std::string& text) {
  std::size_t found = 0;
  for (const SvgLabel& label : picture.labels) found += label.text == text;
  return found;
}

TEST(GridSvg, PrintsValuesInRoomyCells) {
  const Solved world =
      testing::solved(testing::grid_world({"S.......", "..##....", "...#..P.", ".#.#.##.",
                                           ".#....#.", ".####.#.", "......#.", ".P.#...G"}));
  const Result<Picture> picture = grid_svg(view_of(world));
  ASSERT_TRUE(picture);
  testing::expect_sound(*picture);
  EXPECT_EQ(count(*picture, "-14"), 1U);  // 7 moves down and 7 right from S
  EXPECT_EQ(count(*picture, "P"), 2U);
  EXPECT_EQ(count(*picture, "G"), 1U);
  EXPECT_EQ(count(*picture, "S"), 1U);
  EXPECT_EQ(count(*picture, "optimal moves"), 1U);
}

TEST(GridSvg, DrawsAMazeWithoutValues) {
  const Solved world = testing::solved(testing::grid_world(testing::maze_rows(51)), 400);
  const Result<Picture> picture = grid_svg(view_of(world));
  ASSERT_TRUE(picture);
  testing::expect_sound(*picture);
  EXPECT_LT(picture->labels.size(), 10U);
  EXPECT_LT(picture->svg.size(), 300'000U);
}

TEST(GridSvg, HandlesOddShapes) {
  for (const auto& rows : {std::vector<std::string>{"SG"}, std::vector<std::string>{"S", ".", "G"},
                           std::vector<std::string>{"SGGPPG"}}) {
    const Solved world = testing::solved(testing::grid_world(rows));
    const Result<Picture> picture = grid_svg(view_of(world));
    ASSERT_TRUE(picture);
    testing::expect_sound(*picture);
  }
}

TEST(GridSvg, WorksWithoutValuesAndPolicy) {
  const Mdp mdp = testing::grid_world({"S..", ".#G"});
  GridView view;
  view.mdp = &mdp;
  view.title = "a title that is longer than this small grid is wide, and is still shown whole";
  const Result<Picture> picture = grid_svg(view);
  ASSERT_TRUE(picture);
  testing::expect_sound(*picture);
}

TEST(GridSvg, SamplesLargeGridsDown) {
  std::vector<std::string> rows(300, std::string(250, '.'));
  rows[299][249] = 'G';
  const Solved world = testing::solved(testing::grid_world(rows), 1);
  const Result<Picture> picture = grid_svg(view_of(world));
  ASSERT_TRUE(picture);
  testing::expect_sound(*picture);
  EXPECT_EQ(count(*picture, "each square: mean of 3 x 3 cells"), 1U);
  EXPECT_LT(picture->width, 900);
}

TEST(GridSvg, RefusesWorldsWithoutCells) {
  const Solved world = testing::solved(testing::adventure());
  const Result<Picture> picture = grid_svg(view_of(world));
  ASSERT_FALSE(picture);
  EXPECT_NE(message(picture.error()).find("show WORLD graph"), std::string::npos);
}

}  // namespace
}  // namespace quoll
