#include "quoll/env/worlds/taxi.hpp"

#include <algorithm>
#include <string_view>

namespace quoll {
namespace {

// ':' between two cells is a way, '|' a wall.
constexpr std::string_view town[] = {"+---------+", "|R: | : :G|", "| : | : : |", "| : : : : |",
                                     "| | : | : |", "|Y| : |B: |", "+---------+"};
constexpr std::string_view places = "RGYB";

struct Place {
  std::uint32_t row, column;
};
constexpr Place place_at[] = {{0, 0}, {0, 4}, {4, 0}, {4, 3}};

bool is_at(const Cab& cab, std::uint32_t place) {
  return cab.row == place_at[place].row && cab.column == place_at[place].column;
}

// The place where the taxi stands, or 4.
std::uint32_t place_of(const Cab& cab) {
  std::uint32_t place = 0;
  while (place < 4 && !is_at(cab, place)) ++place;
  return place;
}

bool wall_east_of(std::uint32_t row, std::uint32_t column) {
  return town[1 + row][2 * column + 2] != ':';
}

CabMove drop_off(Cab cab) {
  const std::uint32_t place = place_of(cab);
  if (cab.passenger != aboard || place == 4) return {cab, -10.0};
  cab.passenger = place;
  return {cab, place == cab.destination ? 20.0 : -1.0};
}

}  // namespace

State cab_number(const Cab& cab) {
  return ((cab.row * 5 + cab.column) * 5 + cab.passenger) * 4 + cab.destination;
}

Cab cab_of(State number) {
  return {number / 100, number / 20 % 5, number / 4 % 5, number % 4};
}

bool has_arrived(const Cab& cab) {
  return cab.passenger == cab.destination && is_at(cab, cab.destination);
}

bool may_start(const Cab& cab) {
  return cab.passenger != aboard && cab.passenger != cab.destination;
}

CabMove drive(const Cab& cab, Action action) {
  CabMove move{cab, -1.0};
  switch (action) {
    case 0:
      move.cab.row = std::min(cab.row + 1, 4u);
      break;
    case 1:
      move.cab.row = cab.row > 0 ? cab.row - 1 : 0;
      break;
    case 2:
      move.cab.column += wall_east_of(cab.row, cab.column) ? 0 : 1;
      break;
    case 3:
      move.cab.column -= cab.column == 0 || wall_east_of(cab.row, cab.column - 1) ? 0 : 1;
      break;
    case 4:
      if (cab.passenger == aboard || !is_at(cab, cab.passenger)) return {cab, -10.0};
      move.cab.passenger = aboard;
      break;
    default:
      return drop_off(cab);
  }
  return move;
}

std::array<Action, 2> sides_of(Action heading) {
  constexpr std::array<Action, 2> sides[] = {{2, 3}, {3, 2}, {1, 0}, {0, 1}};
  return sides[heading];
}

std::string cab_name(const Cab& cab) {
  std::string name = "r" + std::to_string(cab.row) + "c" + std::to_string(cab.column) + "-";
  if (cab.passenger == aboard) {
    name += "aboard";
  } else {
    name += places[cab.passenger];
  }
  return name + "-to-" + places[cab.destination];
}

std::string cab_text(const Cab& cab) {
  std::string text;
  for (std::size_t line = 0; line < std::size(town); ++line) {
    const std::size_t begin = text.size();
    text += town[line];
    if (line == 1 + cab.row) text[begin + 2 * cab.column + 1] = cab.passenger == aboard ? 'T' : 't';
    text += '\n';
  }
  text += "passenger ";
  text += cab.passenger == aboard ? "aboard"
                                  : (has_arrived(cab) ? "arrived at " : "waits at ") +
                                        std::string(1, places[cab.passenger]);
  if (!has_arrived(cab)) text += std::string(", destination ") + places[cab.destination];
  return text + '\n';
}

Drawing cab_drawing(const Cab& cab) {
  Drawing drawing;
  drawing.width = drawing.height = 5.0;
  drawing.box(Ink::floor, 0.0, 0.0, 5.0, 5.0);
  const Place& to = place_at[cab.destination];
  drawing.box(Ink::goal, to.column, to.row, 1.0, 1.0);
  for (std::uint32_t place = 0; place < 4; ++place) {
    drawing.write(Ink::line, place_at[place].column + 0.5, place_at[place].row + 0.5, 0.4,
                  std::string(1, places[place]));
  }
  for (std::uint32_t row = 0; row < 5; ++row) {
    for (std::uint32_t column = 0; column < 4; ++column) {
      if (!wall_east_of(row, column)) continue;
      const double x = column + 1.0, y = row;
      drawing.line(Ink::wall, {{x, y}, {x, y + 1.0}}, 0.1);
    }
  }
  drawing.line(Ink::wall, {{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 0}}, 0.1);
  const double x = cab.column, y = cab.row;
  drawing.box(Ink::agent, x + 0.2, y + 0.3, 0.6, 0.4);
  if (cab.passenger == aboard) {
    drawing.circle(Ink::reward, x + 0.5, y + 0.5, 0.12);
  } else {
    const Place& at = place_at[cab.passenger];
    drawing.circle(Ink::reward, at.column + 0.82, at.row + 0.18, 0.12);
  }
  return drawing;
}

}  // namespace quoll
