#include "quoll/env/worlds/pictures.hpp"

#include <memory>
#include <numeric>
#include <string_view>

#include "quoll/env/grid_window.hpp"

namespace quoll {
namespace {

struct Picture {
  std::vector<std::string> rows;
  std::vector<std::uint32_t> cells;

  std::uint32_t high() const { return static_cast<std::uint32_t>(rows.size()); }
  std::uint32_t wide() const { return static_cast<std::uint32_t>(rows.front().size()); }
  std::string text(State at) const {
    const GridWindow view = grid_window(high(), wide(), cells[at], 100, 160);
    std::string lines;
    for (std::uint32_t r = 0; r < view.rows; ++r) {
      lines += std::string_view(rows[view.top + r]).substr(view.left, view.columns);
      lines += '\n';
    }
    const std::uint32_t row = cells[at] / wide() - view.top;
    lines[std::size_t{row} * (view.columns + 1) + cells[at] % wide() - view.left] = '@';
    return lines;
  }
  Drawing drawing(State at) const {
    const GridWindow view = grid_window(high(), wide(), cells[at], 60, 160);
    Drawing drawing{static_cast<double>(view.columns), static_cast<double>(view.rows), {}};
    for (std::uint32_t r = 0; r < view.rows; ++r) {
      for (std::uint32_t c = 0; c < view.columns; ++c) {
        const char letter = rows[view.top + r][view.left + c];
        if (letter != ' ') drawing.box(ink(letter), c, r, 1.0, 1.0);
      }
    }
    const std::uint32_t row = cells[at] / wide() - view.top;
    const std::uint32_t column = cells[at] % wide() - view.left;
    return drawing.circle(Ink::agent, column + 0.5, row + 0.5, 0.35);
  }
  static Ink ink(char letter) {
    switch (letter) {
      case '#':
        return Ink::wall;
      case 'G':
      case 'F':
        return Ink::goal;
      case '~':
      case 'P':
      case 'H':
      case 'C':
        return Ink::danger;
      default:
        return Ink::floor;
    }
  }
};

}  // namespace

Looks grid_looks(std::vector<std::string> picture, std::vector<std::uint32_t> cells) {
  const auto shared =
      std::make_shared<const Picture>(Picture{std::move(picture), std::move(cells)});
  Looks looks;
  looks.text = [shared](State at) { return shared->text(at); };
  looks.drawing = [shared](State at) { return shared->drawing(at); };
  return looks;
}

Layout grid_layout(std::uint32_t rows, std::uint32_t columns,
                   std::vector<std::pair<int, int>> direction) {
  std::vector<std::uint32_t> cells(std::size_t{rows} * columns);
  std::iota(cells.begin(), cells.end(), 0u);
  return {rows, columns, std::move(cells), std::move(direction)};
}

Looks row_looks(std::string letters) {
  std::vector<std::uint32_t> cells(letters.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
  return grid_looks({std::move(letters)}, std::move(cells));
}

Layout row_layout(std::uint32_t states, std::vector<std::pair<int, int>> direction) {
  return grid_layout(1, states, std::move(direction));
}

std::string cell_name(std::uint32_t row, std::uint32_t column) {
  return "r" + std::to_string(row) + "c" + std::to_string(column);
}

}  // namespace quoll
