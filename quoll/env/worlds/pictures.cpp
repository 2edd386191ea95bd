#include "quoll/env/worlds/pictures.hpp"

#include <memory>
#include <numeric>

namespace quoll {
namespace {

struct Picture {
  std::vector<std::string> rows;
  std::vector<std::uint32_t> cells;

  std::size_t columns() const { return rows.front().size(); }
  std::string text(State at) const {
    std::string lines;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      lines += rows[r];
      if (cells[at] / columns() == r) lines[lines.size() - columns() + cells[at] % columns()] = '@';
      lines += '\n';
    }
    return lines;
  }
  Drawing drawing(State at) const {
    Drawing drawing{static_cast<double>(columns()), static_cast<double>(rows.size()), {}};
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t c = 0; c < columns(); ++c) {
        if (rows[r][c] == ' ') continue;
        drawing.box(ink(rows[r][c]), static_cast<double>(c), static_cast<double>(r), 1.0, 1.0);
      }
    }
    const std::size_t row = cells[at] / columns(), column = cells[at] % columns();
    return drawing.circle(Ink::agent, static_cast<double>(column) + 0.5,
                          static_cast<double>(row) + 0.5, 0.35);
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
