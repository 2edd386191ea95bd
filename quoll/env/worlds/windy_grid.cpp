// Windy grid world: 7 rows and 10 columns, from r3c0 to r3c7, -1 a move, discount 1. A wind blows
// upwards in the middle columns: a move ends as many cells higher as the wind of the column it
// starts in, and the grid's edge stops it.
// Sutton, Barto 2018, "Reinforcement Learning", example 6.5 (shortest path: 15 moves); king's moves
// and a ninth, standing still: exercise 6.9 (7 moves); stochastic wind: exercise 6.10, one cell
// stronger or weaker with probability 1/3 each where there is wind.
// State: its name, "r<row>c<column>" from the top left. One draw a step when the wind is
// stochastic.

#include <algorithm>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

constexpr std::uint32_t rows = 7, columns = 10;
constexpr int wind[columns] = {0, 0, 0, 1, 1, 1, 2, 2, 1, 0};
constexpr std::uint32_t start_cell = 30, goal_cell = 37;

enum class Moves : std::uint8_t { four, eight, nine };
constexpr std::string_view moves_names[] = {"four", "eight", "nine"};

struct Settings {
  Moves moves = Moves::four;
  bool stochastic = false;

  void describe(Describer& d) {
    d.choice("moves", moves, moves_names, "four directions, a king's eight, or nine with stay");
    d("stochastic", stochastic, "wind one cell weaker or stronger, each in a third of the moves");
  }
};

struct Direction {
  const char* name;
  int right, down;
};
constexpr Direction directions[] = {{"N", 0, -1},  {"E", 1, 0},    {"S", 0, 1},
                                    {"W", -1, 0},  {"NE", 1, -1},  {"SE", 1, 1},
                                    {"SW", -1, 1}, {"NW", -1, -1}, {"stay", 0, 0}};

State landing(State from, const Direction& move, int gust) {
  const int row = static_cast<int>(from / columns) + move.down - gust;
  const int column = static_cast<int>(from % columns) + move.right;
  return static_cast<State>(std::clamp(row, 0, static_cast<int>(rows) - 1)) * columns +
         static_cast<State>(std::clamp(column, 0, static_cast<int>(columns) - 1));
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("windy-grid", given);
  if (!settings) return settings.error();
  const std::uint32_t moves = settings->moves == Moves::four    ? 4
                              : settings->moves == Moves::eight ? 8
                                                                : 9;
  MdpBuilder builder(1.0);
  Layout layout{rows, columns, {}, {}};
  for (std::uint32_t cell = 0; cell < rows * columns; ++cell) {
    builder.state(cell_name(cell / columns, cell % columns));
    layout.cell.push_back(cell);
  }
  for (std::uint32_t m = 0; m < moves; ++m) {
    builder.action(directions[m].name);
    layout.direction.emplace_back(directions[m].right, directions[m].down);
  }
  for (State from = 0; from < rows * columns; ++from) {
    if (from == goal_cell) continue;
    const int mean = wind[from % columns];
    for (std::uint32_t m = 0; m < moves; ++m) {
      if (!settings->stochastic || mean == 0) {
        builder.move(from, m, landing(from, directions[m], mean), -1.0, 1.0);
        continue;
      }
      for (const int gust : {mean, mean + 1, mean - 1}) {
        builder.move(from, m, landing(from, directions[m], gust), -1.0, 1.0 / 3.0);
      }
    }
  }
  builder.start(cell_name(start_cell / columns, start_cell % columns));
  std::vector<std::uint32_t> cells = layout.cell;
  builder.layout(std::move(layout));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  std::vector<std::string> picture(rows, std::string(columns, '.'));
  picture[3][0] = 'S';
  picture[3][7] = 'G';
  return to_world("windy-grid", std::move(*mdp), grid_looks(std::move(picture), std::move(cells)));
}

}  // namespace

extern const WorldEntry windy_grid_world;
const WorldEntry windy_grid_world{"windy-grid",
                                  "",
                                  "a grid with a wind across the way to the goal",
                                  "Sutton, Barto 2018, example 6.5, exercises 6.9 and 6.10",
                                  make,
                                  parameters_of<Settings>};

}  // namespace quoll
