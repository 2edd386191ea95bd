#pragma once
// The boards of Connect Four as bits: column c holds bits c * (rows + 1) upwards from the bottom,
// the topmost bit of a column always 0, so that shifted boards find stones in a row.

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/env/worlds/board_game.hpp"

namespace quoll {

struct ConnectFour {
  std::uint64_t rows = 6, columns = 7, connect = 4;  ///< (rows + 1) * columns <= 64

  struct Board {
    std::uint64_t x = 0, o = 0;
  };

  Board begin() const { return {}; }
  std::uint64_t bit(std::uint64_t column, std::uint64_t height) const {
    return std::uint64_t{1} << (column * (rows + 1) + height);
  }
  /// One bit above each column's highest stone, and all stones' bits below it tell a board from
  /// all others: x's stones beside them.
  std::uint64_t key(const Board& at) const {
    std::uint64_t bottom = 0;
    for (std::uint64_t c = 0; c < columns; ++c) bottom |= bit(c, 0);
    return (at.x | at.o) + bottom + at.x;
  }
  std::uint32_t stones(const Board& at) const {
    return static_cast<std::uint32_t>(std::popcount(at.x | at.o));
  }
  board::Side to_move(const Board& at) const {
    return stones(at) % 2 == 0 ? board::Side::x : board::Side::o;
  }
  bool legal(const Board& at, std::uint32_t column) const {
    return ((at.x | at.o) & bit(column, rows - 1)) == 0;
  }
  /// Number of columns that are not full.
  std::uint32_t open(const Board& at) const {
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < columns; ++c) count += legal(at, c) ? 1 : 0;
    return count;
  }
  Board play(const Board& at, std::uint32_t column) const {
    const std::uint64_t full = at.x | at.o;
    const std::uint64_t inside = bit(column, rows) - bit(column, 0);
    const std::uint64_t stone = (full + bit(column, 0)) & ~full & inside;
    return to_move(at) == board::Side::x ? Board{at.x | stone, at.o} : Board{at.x, at.o | stone};
  }
  /// Whether `connect` of these stones lie in a row.
  bool has_row(std::uint64_t stones_of_one) const {
    for (const std::uint64_t step : {std::uint64_t{1}, rows, rows + 1, rows + 2}) {
      std::uint64_t row = stones_of_one;
      for (std::uint64_t k = 1; k < connect && row != 0; ++k) row &= row >> step;
      if (row != 0) return true;
    }
    return false;
  }
  board::Outcome outcome(const Board& at) const {
    if (has_row(at.x)) return board::Outcome::x_won;
    if (has_row(at.o)) return board::Outcome::o_won;
    return stones(at) == rows * columns ? board::Outcome::drawn : board::Outcome::running;
  }
  /// The top row first, rows divided by '/'.
  std::string cells(const Board& at) const;
  /// The board of such a text; nothing where stones hang, their numbers do not fit, or the shape is
  /// another one.
  std::optional<Board> parse(std::string_view cells) const;
  std::vector<std::string> move_names() const;
  /// {rows, columns, 2}: stones of the player to move, then of the other.
  void observe(const Board& at, std::span<float> x) const;
};

/// A game as it stands; its shape is the world's.
struct ConnectFourPosition {
  ConnectFour game;
  ConnectFour::Board stones;
  board::Outcome outcome = board::Outcome::running;

  template <class A>
  void persist(A& archive) {
    std::string board = game.cells(stones) + " " + board::turn_text(outcome, game.to_move(stones));
    archive("board", board);
    if (archive.saving()) return;
    if (const std::string why = take(board); !why.empty()) archive.fail(why);
  }
  /// Why a text is no position of this board, or "" when it was taken.
  std::string take(std::string_view text);
};

}  // namespace quoll
