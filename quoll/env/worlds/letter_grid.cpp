#include "quoll/env/worlds/letter_grid.hpp"

#include <numeric>
#include <utility>

namespace quoll {
namespace {

std::vector<std::uint32_t> all_cells(const LetterGrid& grid) {
  std::vector<std::uint32_t> cells(grid.size() * grid[0].size());
  std::iota(cells.begin(), cells.end(), 0u);
  return cells;
}

void draw_cell(Drawing& drawing, char letter, double x, double y) {
  const bool goal = letter == 'G';
  const bool danger = letter == 'H' || letter == 'C';
  drawing.box(goal ? Ink::goal : letter == 'C' ? Ink::danger : Ink::floor, x, y, 1.0, 1.0);
  if (letter == 'H') drawing.circle(Ink::danger, x + 0.5, y + 0.5, 0.35);
  if (goal || letter == 'S') {
    drawing.write(Ink::line, x + 0.5, y + 0.5, 0.4, std::string(1, letter));
  }
  if (!danger) {
    drawing.line(Ink::faint, {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}, {x, y}}, 0.02);
  }
}

}  // namespace

std::string letter_text(const LetterGrid& grid, State at) {
  std::string text;
  State cell = 0;
  for (const std::string& row : grid) {
    for (const char letter : row) {
      const bool here = cell++ == at;
      text += here ? '[' : ' ';
      text += letter;
      text += here ? ']' : ' ';
    }
    text += '\n';
  }
  return text;
}

Drawing letter_drawing(const LetterGrid& grid, State at) {
  Drawing drawing;
  drawing.height = static_cast<double>(grid.size());
  drawing.width = static_cast<double>(grid[0].size());
  for (std::size_t row = 0; row < grid.size(); ++row) {
    for (std::size_t column = 0; column < grid[row].size(); ++column) {
      draw_cell(drawing, grid[row][column], static_cast<double>(column), static_cast<double>(row));
    }
  }
  const auto columns = static_cast<State>(grid[0].size());
  drawing.circle(Ink::agent, at % columns + 0.5, at / columns + 0.5, 0.25);
  return drawing;
}

Layout letter_layout(const LetterGrid& grid, std::vector<std::pair<int, int>> direction) {
  return {static_cast<std::uint32_t>(grid.size()), static_cast<std::uint32_t>(grid[0].size()),
          all_cells(grid), std::move(direction)};
}

Names letter_names(const LetterGrid& grid) {
  return Names::cells(static_cast<std::uint32_t>(grid[0].size()), all_cells(grid));
}

}  // namespace quoll
