// A random maze, -1 a move, discount 1: see quoll/model/maze.hpp for how it is made. Start top
// left, goal bottom right.
// numbering: states are numbered as one reads the picture, or shuffled by the maze's seed. Rows
// number neighbours close together, which makes tables fast by accident; shuffled shows what the
// memory costs when neighbours are anywhere. Names and pictures are the same for both.
// State: its name, "r<row>c<column>" from the top left. No draws. Memory: about 80 bytes per open
// cell, a little over half of the cells. Mazes over 200 cells a side have no picture.

#include "quoll/model/maze.hpp"

#include <utility>

#include "quoll/env/worlds/pictures.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t largest_picture = 200;

enum class Numbering : std::uint8_t { rows, shuffled };
constexpr std::string_view numbering_names[] = {"rows", "shuffled"};

struct Settings {
  MazeSettings maze;
  Numbering numbering = Numbering::rows;

  void describe(Describer& d) {
    maze.describe(d);
    d.choice("numbering", numbering, numbering_names, "order of the states in memory");
  }
};

std::vector<State> shuffled_numbers(std::uint64_t count, std::uint64_t seed) {
  std::vector<State> number(count);
  Rng dice = stream(seed, "numbering");
  for (State i = 0; i < count; ++i) {
    const std::uint32_t other = dice.below(i + 1);
    number[i] = number[other];
    number[other] = i;
  }
  return number;
}

// Gives state s the number number[s]. Every state but the goal has the same four choices with the
// same reward, so that only successors, cells and the place of the goal change.
void renumber(MdpArrays& a, const std::vector<State>& number) {
  const auto states = static_cast<State>(number.size());
  std::vector<std::uint32_t> cell(states);
  for (State s = 0; s < states; ++s) cell[number[s]] = a.layout->cell[s];
  a.layout->cell = cell;
  a.state_names = Names::cells(a.layout->columns, std::move(cell));
  for (State& s : a.start) s = number[s];
  const State goal = number[states - 1];  // the last one one reads
  std::vector<State> next(a.next.size());
  for (State s = 0; s + 1 < states; ++s) {
    const std::uint64_t from = a.choice_begin[s];
    const std::uint64_t to = 4 * (std::uint64_t{number[s]} - (number[s] > goal ? 1 : 0));
    for (std::uint64_t i = 0; i < 4; ++i) next[to + i] = number[a.next[from + i]];
  }
  a.next = std::move(next);
  for (std::uint64_t s = 0; s <= states; ++s) a.choice_begin[s] = 4 * (s - (s > goal ? 1 : 0));
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("maze", given);
  if (!settings) return settings.error();
  Grid grid = make_maze(settings->maze);
  Result<MdpArrays> arrays = to_arrays(grid);
  if (!arrays) return arrays.error();
  if (settings->maze.size > largest_picture) grid.rows = {};
  if (settings->numbering == Numbering::shuffled) {
    renumber(*arrays, shuffled_numbers(arrays->layout->cell.size(), settings->maze.seed));
  }
  Result<Mdp> mdp = Mdp::make(std::move(*arrays));
  if (!mdp) return mdp.error();
  Looks looks;
  if (!grid.rows.empty()) looks = grid_looks(std::move(grid.rows), mdp->layout()->cell);
  return to_world("maze", std::move(*mdp), std::move(looks));
}

}  // namespace

extern const WorldEntry maze_world;
const WorldEntry maze_world{"maze",
                            "",
                            "a random maze of any size, with or without loops",
                            "depth-first search, some dead ends opened",
                            make,
                            parameters_of<Settings>};

}  // namespace quoll
