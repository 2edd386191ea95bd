// Puddle world as a table: the unit square in size x size cells, moves to the four cells next to
// it, the goal in the upper right corner. A move costs 1 and, where it ends in a puddle, 400 times
// the depth there: the distance from the cell's centre to the puddle's edge. Two puddles, all
// points within 0.1 of the segments (0.10, 0.75)-(0.45, 0.75) and (0.45, 0.40)-(0.45, 0.80);
// where they meet the deeper one counts. A move slips to either side with probability slip / 2.
// Starts anywhere but in the goal; discount 1.
// Sutton 1996, "Generalization in reinforcement learning: successful examples using sparse coarse
// coding", section 3, where position is continuous and a move is 0.05 with a little noise; size=20
// has that step.
// State: its name, "r<row>c<column>" from the top left. One draw a step where it may slip.

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/env/worlds/pictures.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t size = 20;
  double slip = 0.1;

  void describe(Describer& d) {
    d("size", size, 2, 2000, "cells per side");
    d("slip", slip, 0, 1, "probability of slipping, half to each side");
  }
};

// Depth of the puddle around the segment from (x0, y0) to (x1, y1), which is parallel to an axis.
double depth(double x, double y, double x0, double y0, double x1, double y1) {
  const double dx = x - std::clamp(x, x0, x1);
  const double dy = y - std::clamp(y, y0, y1);
  return std::max(0.0, 0.1 - std::sqrt(dx * dx + dy * dy));
}

class Square {
 public:
  explicit Square(std::uint32_t size) : size_(size) {}

  // Cells whose centre is at 0.95 or more in both directions; at least the corner.
  bool goal(std::uint32_t row, std::uint32_t column) const {
    return far(column) && far(size_ - 1 - row);
  }
  double cost(std::uint32_t row, std::uint32_t column) const {
    const double x = (column + 0.5) / size_;
    const double y = (size_ - 1 - row + 0.5) / size_;
    const double deepest =
        std::max(depth(x, y, 0.10, 0.75, 0.45, 0.75), depth(x, y, 0.45, 0.40, 0.45, 0.80));
    return 1.0 + 400.0 * deepest;
  }

 private:
  bool far(std::uint32_t index) const {
    return index == size_ - 1 || (2 * index + 1) * 10 >= 19 * size_;
  }
  std::uint32_t size_;
};

constexpr const char* direction_names[] = {"N", "E", "S", "W"};
constexpr std::pair<int, int> directions[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};

void add_moves(MdpBuilder& builder, const Square& square, std::uint32_t size, State from,
               double slip) {
  for (std::uint32_t move = 0; move < 4; ++move) {
    const std::pair<std::uint32_t, double> parts[] = {
        {move, 1.0 - slip}, {(move + 3) % 4, slip / 2}, {(move + 1) % 4, slip / 2}};
    for (const auto& [way, probability] : parts) {
      if (probability == 0.0) continue;
      const int last = static_cast<int>(size) - 1;
      const auto column = static_cast<std::uint32_t>(
          std::clamp(static_cast<int>(from % size) + directions[way].first, 0, last));
      const auto row = static_cast<std::uint32_t>(
          std::clamp(static_cast<int>(from / size) + directions[way].second, 0, last));
      builder.move(from, move, row * size + column, -square.cost(row, column), probability);
    }
  }
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("puddle", given);
  if (!settings) return settings.error();
  const auto size = static_cast<std::uint32_t>(settings->size);
  const Square square(size);
  MdpBuilder builder(1.0);
  Layout layout{size, size, {}, {}};
  std::vector<std::string> picture(size, std::string(size, '.'));
  for (std::uint32_t cell = 0; cell < size * size; ++cell) {
    const std::uint32_t row = cell / size;
    const std::uint32_t column = cell % size;
    builder.state(cell_name(row, column));
    layout.cell.push_back(cell);
    if (square.cost(row, column) > 1.0) picture[row][column] = '~';
    if (square.goal(row, column)) picture[row][column] = 'G';
  }
  for (std::uint32_t move = 0; move < 4; ++move) {
    builder.action(direction_names[move]);
    layout.direction.push_back(directions[move]);
  }
  for (State from = 0; from < size * size; ++from) {
    if (!square.goal(from / size, from % size)) {
      add_moves(builder, square, size, from, settings->slip);
    }
  }
  std::vector<std::uint32_t> cells = layout.cell;
  builder.layout(std::move(layout));
  Result<Mdp> mdp = builder.build();
  if (!mdp) return mdp.error();
  return to_world("puddle", std::move(*mdp), grid_looks(std::move(picture), std::move(cells)));
}

}  // namespace

extern const WorldEntry puddle_world;
const WorldEntry puddle_world{"puddle",
                              "",
                              "two puddles to walk around, the deeper the dearer",
                              "Sutton 1996, section 3; here a table",
                              make,
                              parameters_of<Settings>};

}  // namespace quoll
