#include "quoll/model/maze.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace quoll {
namespace {

struct Shape {
  std::uint64_t open = 0;       // cells
  std::uint64_t passages = 0;   // pairs of open neighbours
  std::uint64_t reached = 0;    // cells reached from the start
  std::uint64_t dead_ends = 0;  // open cells with one open neighbour
};

Shape shape_of(const Grid& grid) {
  const std::size_t size = grid.rows.size();
  const auto open = [&](std::size_t r, std::size_t c) {
    return r < size && c < size && grid.rows[r][c] != '#';
  };
  Shape shape;
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t c = 0; c < size; ++c) {
      if (!open(r, c)) continue;
      ++shape.open;
      shape.passages += open(r, c + 1) + open(r + 1, c);
      shape.dead_ends += open(r, c + 1) + open(r + 1, c) + open(r - 1, c) + open(r, c - 1) == 1;
    }
  }
  std::vector<bool> seen(size * size);
  std::vector<std::size_t> queue = {0};
  seen[0] = true;
  while (!queue.empty()) {
    const std::size_t r = queue.back() / size;
    const std::size_t c = queue.back() % size;
    queue.pop_back();
    ++shape.reached;
    const std::array<std::pair<std::size_t, std::size_t>, 4> around = {
        {{r - 1, c}, {r + 1, c}, {r, c - 1}, {r, c + 1}}};
    for (const auto& [to_r, to_c] : around) {
      if (!open(to_r, to_c) || seen[to_r * size + to_c]) continue;
      seen[to_r * size + to_c] = true;
      queue.push_back(to_r * size + to_c);
    }
  }
  return shape;
}

TEST(Maze, WithoutBraidIsATree) {
  for (const std::uint64_t size : {3, 4, 5, 6, 7, 50, 51, 100}) {
    const Grid grid = make_maze({.size = size, .seed = size, .braid = 0});
    ASSERT_EQ(grid.rows.size(), size);
    for (const auto& row : grid.rows) ASSERT_EQ(row.size(), size);
    const Shape shape = shape_of(grid);
    EXPECT_EQ(shape.reached, shape.open) << size;
    EXPECT_EQ(shape.passages, shape.open - 1) << size;
    EXPECT_EQ(grid.rows.front().front(), 'S');
    EXPECT_EQ(grid.rows.back().back(), 'G');
  }
}

TEST(Maze, OddSizesHaveAllRoomsAndOneDoorLess) {
  // Size 51: 26 x 26 rooms and 26 * 26 - 1 cells between them.
  EXPECT_EQ(shape_of(make_maze({.size = 51, .seed = 9, .braid = 0})).open, 2u * 26 * 26 - 1);
}

TEST(Maze, FullyBraidedHasNoDeadEnd) {
  for (const std::uint64_t size : {3, 4, 5, 50, 51, 101}) {
    const Shape shape = shape_of(make_maze({.size = size, .seed = 4, .braid = 1}));
    EXPECT_EQ(shape.dead_ends, 0u) << size;
    EXPECT_EQ(shape.reached, shape.open) << size;
  }
}

TEST(Maze, BraidOpensItsShareOfDeadEnds) {
  const auto perfect = shape_of(make_maze({.size = 201, .seed = 5, .braid = 0}));
  const auto half = shape_of(make_maze({.size = 201, .seed = 5, .braid = 0.5}));
  const auto chosen = static_cast<std::uint64_t>(std::llround(0.5 * perfect.dead_ends));
  // Each new door is one more open cell, and joins two cells of the tree anew; one door may serve
  // two of the chosen dead ends, but not more.
  const std::uint64_t doors = half.open - perfect.open;
  EXPECT_LE(doors, chosen);
  EXPECT_GE(2 * doors, chosen);
  EXPECT_EQ(half.passages, half.open - 1 + doors);
  EXPECT_LE(half.dead_ends, perfect.dead_ends - chosen);
}

TEST(Maze, TheSettingsDecideEveryLetter) {
  EXPECT_EQ(make_maze({.size = 31, .seed = 7, .braid = 0.3}).rows,
            make_maze({.size = 31, .seed = 7, .braid = 0.3}).rows);
  std::set<std::vector<std::string>> mazes;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    mazes.insert(make_maze({.size = 31, .seed = seed, .braid = 0.3}).rows);
  }
  EXPECT_EQ(mazes.size(), 20u);
}

TEST(Maze, AThousandBraidedHalfHasHalfAMillionOpenCells) {
  const Grid grid = make_maze({.size = 1000, .seed = 1, .braid = 0.5});
  const Shape shape = shape_of(grid);
  EXPECT_GE(shape.open, 500'000u);
  EXPECT_EQ(shape.reached, shape.open);
}

TEST(Maze, BecomesAModelWithOneStart) {
  const auto mdp = to_mdp(make_maze({.size = 21, .seed = 2, .braid = 0.5}));
  ASSERT_TRUE(mdp) << message(mdp.error());
  EXPECT_TRUE(mdp->deterministic());
  ASSERT_EQ(mdp->start().size(), 1u);
  EXPECT_EQ(mdp->state_name(mdp->start()[0]), "r0c0");
  EXPECT_EQ(mdp->discount(), 1.0);
}

}  // namespace
}  // namespace quoll
