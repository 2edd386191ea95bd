#pragma once
// King and rook against king: every placement of the three pieces, solved backwards from the mates
// (Thompson 1986, "Retrograde analysis of certain endgames", ICCA Journal 9(3)). White owns the
// rook. Squares count a1 = 0, b1 = 1, ..., h8 = 63.

#include <cstdint>
#include <string>
#include <vector>

namespace quoll::krk {

struct Placement {
  unsigned king, rook, enemy;  ///< squares of White's king and rook and of Black's king

  unsigned index() const { return king << 12 | rook << 6 | enemy; }
  static Placement of(unsigned index) { return {index >> 12, index >> 6 & 63u, index & 63u}; }
};
inline constexpr unsigned placements = 64 * 64 * 64;

/// What is known of a placement besides a number of moves.
enum Fate : std::uint8_t { longest = 16, stalemate = 253, rook_falls = 254, illegal = 255 };

/// A list of at most 22 squares; no side has more moves.
struct Squares {
  unsigned count = 0;
  std::uint8_t square[22];

  void add(unsigned s) { square[count++] = static_cast<std::uint8_t>(s); }
  const std::uint8_t* begin() const { return square; }
  const std::uint8_t* end() const { return square + count; }
};

/// The legal moves of each piece, ascending; the placement must be legal for the side to move.
/// Black's may include the rook's square: the rook is taken.
Squares king_moves(Placement at);
Squares rook_moves(Placement at);
Squares enemy_moves(Placement at);

/// Whether Black's king is attacked by the rook; White's king may stand between.
bool in_check(Placement at);

struct Endgame {
  /// White to move, per placement: White's moves until mate, 1 to 16, or illegal. All are won.
  std::vector<std::uint8_t> mate_in;
  /// Black to move: White's moves still needed for mate, 0 (it is mate) to 16; or stalemate,
  /// rook_falls (Black takes the rook: a draw), illegal.
  std::vector<std::uint8_t> lost_in;

  /// The reply that puts off mate longest, the lowest square among equals; at must be lost in 1 or
  /// more.
  unsigned best_reply(Placement at) const;
};

/// Both tables; about 0.1 s.
Endgame solve_endgame();

/// "Kc3 Ra1 kd5".
std::string name_of(Placement at);
/// "d5".
std::string name_of_square(unsigned square);

}  // namespace quoll::krk
