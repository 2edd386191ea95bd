#include "quoll/env/worlds/krk_endgame.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace quoll::krk {
namespace {

int file_of(unsigned square) {
  return static_cast<int>(square & 7u);
}
int rank_of(unsigned square) {
  return static_cast<int>(square >> 3);
}

bool touch(unsigned a, unsigned b) {
  return std::abs(file_of(a) - file_of(b)) <= 1 && std::abs(rank_of(a) - rank_of(b)) <= 1;
}

// The squares around each square, ascending.
constexpr auto around = [] {
  std::array<Squares, 64> table{};
  for (int square = 0; square < 64; ++square) {
    for (int rank = square / 8 - 1; rank <= square / 8 + 1; ++rank) {
      for (int file = square % 8 - 1; file <= square % 8 + 1; ++file) {
        const int to = rank * 8 + file;
        if (rank < 0 || rank > 7 || file < 0 || file > 7 || to == square) continue;
        Squares& list = table[static_cast<std::size_t>(square)];
        list.square[list.count++] = static_cast<std::uint8_t>(to);
      }
    }
  }
  return table;
}();

// Whether c lies strictly between a and b, which share a rank or a file.
bool between(unsigned a, unsigned c, unsigned b) {
  const auto [low, high] = std::minmax(a, b);
  if (c <= low || c >= high) return false;
  if (rank_of(a) == rank_of(b)) return true;  // the numbers between are the rank between
  return file_of(c) == file_of(a);
}

bool rook_attacks(unsigned rook, unsigned square, unsigned blocker) {
  if (rook == square) return false;
  if (file_of(rook) != file_of(square) && rank_of(rook) != rank_of(square)) return false;
  return !between(rook, blocker, square);
}

bool apart(Placement at) {
  return at.king != at.rook && at.king != at.enemy && at.rook != at.enemy &&
         !touch(at.king, at.enemy);
}

// The rook's squares along the lines until a piece stands in the way, ascending.
Squares rook_slides(Placement at) {
  Squares all;
  const auto slide = [&](int step, int count) {
    const std::size_t from = all.count;
    unsigned square = at.rook;
    for (int i = 0; i < count; ++i) {
      square = static_cast<unsigned>(static_cast<int>(square) + step);
      if (square == at.king || square == at.enemy) break;
      all.add(square);
    }
    if (step < 0) std::reverse(all.square + from, all.square + all.count);
  };
  slide(-8, rank_of(at.rook));
  slide(-1, file_of(at.rook));
  slide(1, 7 - file_of(at.rook));
  slide(8, 7 - rank_of(at.rook));
  return all;
}

// What Black, to move, can say at once: the fate, or 0 and the number of replies to come.
struct Outlook {
  std::uint8_t fate = illegal, replies = 0;
};

Outlook outlook(Placement at) {
  if (!apart(at)) return {};
  const Squares replies = enemy_moves(at);
  for (const unsigned square : replies) {
    if (square == at.rook) return {rook_falls, 0};
  }
  if (replies.count > 0) return {illegal, static_cast<std::uint8_t>(replies.count)};
  return {in_check(at) ? std::uint8_t{0} : std::uint8_t{stalemate}, 0};
}

// One layer at a time: Black lost in n -> White mates in n + 1 -> Black, whose replies are all used
// up, lost in n + 1.
struct Retrograde {
  Endgame known;
  std::vector<std::uint8_t> replies;  // of Black, not yet known to lose
  std::vector<unsigned> lost, won;    // the newest layers

  Retrograde() {
    known.mate_in.assign(placements, illegal);
    known.lost_in.assign(placements, illegal);
    replies.assign(placements, 0);
    for (unsigned index = 0; index < placements; ++index) {
      const Outlook black = outlook(Placement::of(index));
      known.lost_in[index] = black.fate;
      replies[index] = black.replies;
      if (black.fate == 0) lost.push_back(index);
    }
  }

  // White stood at `at` before the move; illegal with Black in check.
  void reach(Placement at, std::uint8_t moves) {
    std::uint8_t& mate_in = known.mate_in[at.index()];
    if (mate_in != illegal || in_check(at)) return;
    mate_in = moves;
    won.push_back(at.index());
  }

  void take_back_white(std::uint8_t moves) {
    won.clear();
    for (const unsigned index : lost) {
      const Placement at = Placement::of(index);
      for (const unsigned square : around[at.king]) {
        const Placement before{square, at.rook, at.enemy};
        if (apart(before)) reach(before, moves);
      }
      for (const unsigned square : rook_slides(at)) {
        reach({at.king, square, at.enemy}, moves);
      }
    }
  }

  void take_back_black(std::uint8_t moves) {
    lost.clear();
    for (const unsigned index : won) {
      const Placement at = Placement::of(index);
      for (const unsigned square : around[at.enemy]) {
        const unsigned before = Placement{at.king, at.rook, square}.index();
        if (replies[before] == 0 || --replies[before] != 0) continue;
        known.lost_in[before] = moves;
        lost.push_back(before);
      }
    }
  }
};

}  // namespace

bool in_check(Placement at) {
  return rook_attacks(at.rook, at.enemy, at.king);
}

Squares king_moves(Placement at) {
  Squares moves;
  for (const unsigned square : around[at.king]) {
    if (square != at.rook && !touch(square, at.enemy)) moves.add(square);
  }
  return moves;
}

Squares rook_moves(Placement at) {
  return rook_slides(at);
}

Squares enemy_moves(Placement at) {
  Squares moves;
  for (const unsigned square : around[at.enemy]) {
    if (!touch(square, at.king) && !rook_attacks(at.rook, square, at.king)) moves.add(square);
  }
  return moves;
}

unsigned Endgame::best_reply(Placement at) const {
  unsigned best = 0, longest_mate = 0;
  for (const unsigned square : enemy_moves(at)) {
    const unsigned moves = mate_in[Placement{at.king, at.rook, square}.index()];
    if (moves > longest_mate) {
      longest_mate = moves;
      best = square;
    }
  }
  return best;
}

Endgame solve_endgame() {
  Retrograde work;
  for (std::uint8_t moves = 1; !work.lost.empty(); ++moves) {
    work.take_back_white(moves);
    work.take_back_black(moves);
  }
  return std::move(work.known);
}

std::string name_of_square(unsigned square) {
  return {static_cast<char>('a' + file_of(square)), static_cast<char>('1' + rank_of(square))};
}

std::string name_of(Placement at) {
  return "K" + name_of_square(at.king) + " R" + name_of_square(at.rook) + " k" +
         name_of_square(at.enemy);
}

}  // namespace quoll::krk
