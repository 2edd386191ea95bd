// A grid with random walls and a goal, the classic test of solvers: 4 moves, each slips with
// probability `slip`, half to each side; moves into a wall or off the grid stay. -1 a move, 0 at
// the goal (bottom right), start top left, discount 0.99. walls: each cell but start and goal is a
// wall with this probability, one draw a cell in reading order from the stream (seed, "gridworld").
// Cells that no path joins to the goal become walls too; if the start is one of them the next seed
// is tried, so that the goal can always be reached. State: its name, "r<row>c<column>" from the top
// left. One draw a step. Grids over 200 cells a side have no picture.

#include <utility>
#include <vector>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/grid.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t largest_picture = 200;

struct Settings {
  std::uint64_t size = 20;
  double walls = 0.2;
  double slip = 0.2;
  std::uint64_t seed = 1;

  void describe(Describer& d) {
    d("size", size, 2, 20000, "side of the grid in cells");
    d("walls", walls, 0, 0.5, "probability that a cell is a wall");
    d("slip", slip, 0, 1, "probability that a move slips, half to each side");
    d("seed", seed, "which grid");
  }
};

std::vector<std::string> random_rows(const Settings& settings, std::uint64_t seed) {
  const std::size_t size = settings.size;
  std::vector<std::string> rows(size, std::string(size, '.'));
  Rng dice = stream(seed, "gridworld");
  for (std::string& row : rows) {
    for (char& letter : row) {
      if (dice.uniform() < settings.walls) letter = '#';
    }
  }
  rows.front().front() = 'S';
  rows.back().back() = 'G';
  return rows;
}

// Walls up every cell that no path joins to the goal; false if the start is one.
bool keep_joined(std::vector<std::string>& rows) {
  const std::size_t size = rows.size();
  std::vector<bool> joined(size * size);
  std::vector<std::size_t> stack{size * size - 1};
  joined.back() = true;
  while (!stack.empty()) {
    const std::size_t row = stack.back() / size, column = stack.back() % size;
    stack.pop_back();
    const auto visit = [&](std::size_t r, std::size_t c) {  // -1 wraps: off the grid
      if (r >= size || c >= size || rows[r][c] == '#' || joined[r * size + c]) return;
      joined[r * size + c] = true;
      stack.push_back(r * size + c);
    };
    visit(row - 1, column);
    visit(row + 1, column);
    visit(row, column - 1);
    visit(row, column + 1);
  }
  for (std::size_t i = 0; i < joined.size(); ++i) {
    if (!joined[i] && rows[i / size][i % size] == '.') rows[i / size][i % size] = '#';
  }
  return joined.front();
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("gridworld", given);
  if (!settings) return settings.error();
  Grid grid;
  for (std::uint64_t seed = settings->seed;; ++seed) {
    grid.rows = random_rows(*settings, seed);
    if (keep_joined(grid.rows)) break;
  }
  grid.slip = settings->slip;
  grid.discount = 0.99;
  Result<MdpArrays> arrays = to_arrays(grid);
  if (!arrays) return arrays.error();
  if (settings->size > largest_picture) grid.rows = {};
  Result<Mdp> mdp = Mdp::make(std::move(*arrays));
  if (!mdp) return mdp.error();
  Looks looks;
  if (!grid.rows.empty()) looks = grid_looks(std::move(grid.rows), mdp->layout()->cell);
  return to_world("gridworld", std::move(*mdp), std::move(looks));
}

}  // namespace

extern const WorldEntry gridworld_world;
const WorldEntry gridworld_world{"gridworld",
                                 "",
                                 "a slippery grid of any size with random walls",
                                 "the usual test of solvers (Russell, Norvig 2021, 17.1)",
                                 make,
                                 parameters_of<Settings>};

}  // namespace quoll
