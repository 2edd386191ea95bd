#include "quoll/env/worlds/minatar.hpp"

namespace quoll::minatar {
namespace {

// The channels that are shown, lowest first.
std::vector<std::size_t> layers(std::span<const Channel> channels) {
  std::vector<std::size_t> order;
  for (const bool trails : {true, false}) {
    for (std::size_t c = channels.size(); c-- > 0;) {
      if (channels[c].letter != 0 && (channels[c].ink == Ink::faint) == trails) order.push_back(c);
    }
  }
  return order;
}

}  // namespace

std::string text(std::span<const Channel> channels, std::span<const float> flags, Move previous) {
  std::array<char, 100> cells;
  cells.fill('.');
  for (const std::size_t c : layers(channels)) {
    for (std::size_t cell = 0; cell < 100; ++cell) {
      if (flags[cell * channels.size() + c] != 0.0f) cells[cell] = channels[c].letter;
    }
  }
  std::string lines;
  for (std::size_t row = 0; row < 10; ++row) {
    lines.append(&cells[10 * row], 10);
    lines += '\n';
  }
  std::string legend;
  for (const Channel& channel : channels) {
    if (channel.letter == 0) continue;
    if (!legend.empty()) legend += ", ";
    (legend += channel.letter) += ' ';
    legend += channel.name;
  }
  return lines + legend + "\nprevious action: " + std::string(move_names[previous]);
}

Drawing drawing(std::span<const Channel> channels, std::span<const float> flags) {
  Drawing picture{10.0, 10.0, {}};
  picture.box(Ink::floor, 0.0, 0.0, 10.0, 10.0);
  for (const std::size_t c : layers(channels)) {
    for (std::size_t cell = 0; cell < 100; ++cell) {
      if (flags[cell * channels.size() + c] == 0.0f) continue;
      const std::size_t column = cell % 10, row = cell / 10;
      picture.box(channels[c].ink, static_cast<double>(column), static_cast<double>(row), 1.0, 1.0);
    }
  }
  return picture;
}

}  // namespace quoll::minatar
