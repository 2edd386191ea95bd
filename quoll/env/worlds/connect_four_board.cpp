#include "quoll/env/worlds/connect_four.hpp"

namespace quoll {

std::string ConnectFour::cells(const Board& at) const {
  std::string text;
  for (std::uint64_t height = rows; height-- > 0;) {
    for (std::uint64_t c = 0; c < columns; ++c) {
      const std::uint64_t here = bit(c, height);
      text += (at.x & here) != 0 ? 'X' : (at.o & here) != 0 ? 'O' : '.';
    }
    if (height > 0) text += '/';
  }
  return text;
}

std::optional<ConnectFour::Board> ConnectFour::parse(std::string_view text) const {
  if (text.size() != rows * (columns + 1) - 1) return std::nullopt;
  Board at;
  for (std::uint64_t i = 0; i < text.size(); ++i) {
    const std::uint64_t c = i % (columns + 1), height = rows - 1 - i / (columns + 1);
    if (c == columns) {
      if (text[i] != '/') return std::nullopt;
      continue;
    }
    if (text[i] == 'X')
      at.x |= bit(c, height);
    else if (text[i] == 'O')
      at.o |= bit(c, height);
    else if (text[i] != '.')
      return std::nullopt;
  }
  const std::uint64_t full = at.x | at.o;
  for (std::uint64_t c = 0; c < columns; ++c) {
    bool above_gap = false;
    for (std::uint64_t height = 0; height < rows; ++height) {
      const bool stone = (full & bit(c, height)) != 0;
      if (stone && above_gap) return std::nullopt;
      above_gap = !stone;
    }
  }
  const int more = std::popcount(at.x) - std::popcount(at.o);
  if (more != 0 && more != 1) return std::nullopt;
  // Who connected made the last move.
  if (has_row(at.x) && (has_row(at.o) || more != 1)) return std::nullopt;
  if (has_row(at.o) && more != 0) return std::nullopt;
  return at;
}

std::vector<std::string> ConnectFour::move_names() const {
  std::vector<std::string> names;
  for (std::uint64_t c = 0; c < columns; ++c) names.emplace_back(1, static_cast<char>('a' + c));
  return names;
}

void ConnectFour::observe(const Board& at, std::span<float> x) const {
  const bool first = to_move(at) == board::Side::x;
  const std::uint64_t own = first ? at.x : at.o, others = first ? at.o : at.x;
  std::size_t i = 0;
  for (std::uint64_t height = rows; height-- > 0;) {
    for (std::uint64_t c = 0; c < columns; ++c) {
      x[i++] = (own & bit(c, height)) != 0 ? 1.0f : 0.0f;
      x[i++] = (others & bit(c, height)) != 0 ? 1.0f : 0.0f;
    }
  }
}

std::string ConnectFourPosition::take(std::string_view text) {
  const std::size_t blank = std::min(text.find(' '), text.size());
  const std::optional<ConnectFour::Board> board = game.parse(text.substr(0, blank));
  if (!board) {
    return "a board of " + std::to_string(game.rows) + " rows of " + std::to_string(game.columns) +
           " cells expected, as in '" + game.cells(game.begin()) + " x'";
  }
  const board::Outcome natural = game.outcome(*board);
  const board::Side mover = game.to_move(*board);
  // A stone into a full column leaves the board as it is and loses.
  const board::Outcome given_up = board::won_by(board::other(mover));
  const std::string_view turn = text.substr(std::min(blank + 1, text.size()));
  if (turn == board::turn_text(natural, mover)) {
    outcome = natural;
  } else if (natural == board::Outcome::running && turn == board::turn_text(given_up, mover) &&
             game.open(*board) < game.columns) {
    outcome = given_up;
  } else {
    return "'" + board::turn_text(natural, mover) + "' expected after the cells, not '" +
           std::string(turn) + "'";
  }
  stones = *board;
  return "";
}

}  // namespace quoll
