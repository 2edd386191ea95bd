#include "quoll/env/worlds/board_game.hpp"

namespace quoll::board {

namespace {

// "X won" stays; "x" becomes "x to move".
std::string sentence(std::string_view turn) {
  return std::string(turn) + (turn.size() == 1 ? " to move" : "");
}

}  // namespace

std::string text_of(std::string_view cells, std::string_view turn) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == '/') {
      text += '\n';
      continue;
    }
    if (i > 0 && cells[i - 1] != '/') text += ' ';
    text += cells[i];
  }
  return text + "\n" + sentence(turn) + "\n";
}

Drawing drawing_of(std::string_view cells, std::string_view turn) {
  const std::string_view row = cells.substr(0, cells.find('/'));
  const auto columns = static_cast<double>(row.size());
  const std::size_t lines = (cells.size() + 1) / (row.size() + 1);
  const auto rows = static_cast<double>(lines);
  Drawing drawing{columns, rows + 0.8, {}};
  double x = 0.0, y = 0.0;
  for (const char cell : cells) {
    if (cell == '/') {
      x = 0.0;
      y += 1.0;
      continue;
    }
    drawing.box(Ink::floor, x + 0.03, y + 0.03, 0.94, 0.94);
    if (cell == 'X') {
      drawing.line(Ink::agent, {{x + 0.25, y + 0.25}, {x + 0.75, y + 0.75}}, 0.12);
      drawing.line(Ink::agent, {{x + 0.75, y + 0.25}, {x + 0.25, y + 0.75}}, 0.12);
    } else if (cell == 'O') {
      drawing.circle(Ink::danger, x + 0.5, y + 0.5, 0.32);
      drawing.circle(Ink::floor, x + 0.5, y + 0.5, 0.2);
    }
    x += 1.0;
  }
  drawing.write(Ink::line, columns / 2.0, rows + 0.4, 0.4, sentence(turn));
  return drawing;
}

}  // namespace quoll::board
