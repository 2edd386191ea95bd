#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/env/worlds/krk_endgame.hpp"

namespace quoll {
namespace {

using krk::Placement;

const krk::Endgame& endgame() {
  static const krk::Endgame tables = krk::solve_endgame();
  return tables;
}

World krk_world_with(const Parameters& parameters) {
  Result<World> world = find_world("krk", parameters);
  EXPECT_TRUE(world);
  return std::move(*world);
}

const World& optimal() {
  static const World world = krk_world_with({});
  return world;
}

State state(const World& world, std::string_view name) {
  const std::optional<State> found = world.mdp->find_state(name);
  EXPECT_TRUE(found) << name;
  return found.value_or(0);
}

// The successor of a move by name.
std::string after(const World& world, std::string_view from, std::string_view move) {
  const Mdp& mdp = *world.mdp;
  const State s = state(world, from);
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (mdp.action_name(c) == move) return mdp.state_name(mdp.next(mdp.outcome_begin(c)));
  }
  return "no such move";
}

std::string moves(const World& world, std::string_view from) {
  const Mdp& mdp = *world.mdp;
  const State s = state(world, from);
  std::string list;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    list += mdp.action_name(c) + " ";
  }
  return list;
}

// The board turned and mirrored in its eight ways: the smallest index names the class.
unsigned symmetry_class(Placement at) {
  unsigned least = krk::placements;
  for (unsigned way = 0; way < 8; ++way) {
    const auto turn = [way](unsigned square) {
      unsigned file = square & 7u, rank = square >> 3;
      if (way & 1u) file = 7 - file;
      if (way & 2u) rank = 7 - rank;
      if (way & 4u) std::swap(file, rank);
      return rank * 8 + file;
    };
    least = std::min(least, Placement{turn(at.king), turn(at.rook), turn(at.enemy)}.index());
  }
  return least;
}

std::size_t classes(const std::vector<std::uint8_t>& table, std::uint8_t fate) {
  std::set<unsigned> found;
  for (unsigned index = 0; index < krk::placements; ++index) {
    if (table[index] == fate) found.insert(symmetry_class(Placement::of(index)));
  }
  return found.size();
}

std::array<std::uint64_t, 256> histogram(const std::vector<std::uint8_t>& table) {
  std::array<std::uint64_t, 256> count{};
  for (const std::uint8_t fate : table) ++count[fate];
  return count;
}

TEST(Krk, CountsWhiteToMove) {
  const auto count = histogram(endgame().mate_in);
  EXPECT_EQ(krk::placements - count[krk::illegal], 175'168u);
  constexpr std::uint64_t known[] = {0,      1'512,  4'676,  3'852,  1'900,  4'848,
                                     8'708,  11'320, 17'172, 20'088, 19'016, 20'476,
                                     21'480, 17'824, 16'136, 5'244,  916};
  for (int moves = 0; moves <= 16; ++moves) EXPECT_EQ(count[moves], known[moves]) << moves;
  for (int moves = 17; moves < krk::illegal; ++moves) EXPECT_EQ(count[moves], 0u);
  EXPECT_EQ(classes(endgame().mate_in, 16), 121u);
}

TEST(Krk, CountsBlackToMove) {
  const auto count = histogram(endgame().lost_in);
  std::uint64_t legal = count[krk::stalemate] + count[krk::rook_falls];
  for (int moves = 0; moves <= 16; ++moves) legal += count[moves];
  EXPECT_EQ(legal, 223'944u);
  EXPECT_EQ(count[0], 216u);
  EXPECT_EQ(count[krk::stalemate], 68u);
  EXPECT_EQ(count[krk::rook_falls], 22'176u);
  EXPECT_EQ(count[16], 3'056u);
}

// The class distribution of Bain and van Hoff's database (1994; UCI Machine Learning Repository,
// Chess (King-Rook vs. King)): Black to move, up to symmetry, lost in 0 to 16, and drawn.
TEST(Krk, AgreesWithAPublishedDatabase) {
  constexpr std::size_t lost[] = {27,    78,    246,   81,    198,   471,   592,   683, 1'433,
                                  1'712, 1'985, 2'854, 3'597, 4'194, 4'553, 2'166, 390};
  const std::vector<std::uint8_t>& table = endgame().lost_in;
  for (std::uint8_t moves = 0; moves <= 16; ++moves) {
    EXPECT_EQ(classes(table, moves), lost[moves]) << int{moves};
  }
  EXPECT_EQ(classes(table, krk::stalemate) + classes(table, krk::rook_falls), 2'796u);
}

// Every legal placement of either side is told apart from the others, none is left undecided.
TEST(Krk, IllegalMeansIllegal) {
  for (unsigned index = 0; index < krk::placements; ++index) {
    const Placement at = Placement::of(index);
    const int files = std::abs(int(at.king & 7u) - int(at.enemy & 7u));
    const int ranks = std::abs(int(at.king >> 3) - int(at.enemy >> 3));
    const bool apart = std::max(files, ranks) > 1 && at.king != at.rook && at.rook != at.enemy;
    ASSERT_EQ(endgame().lost_in[index] != krk::illegal, apart);
    ASSERT_EQ(endgame().mate_in[index] != krk::illegal, apart && !krk::in_check(at));
  }
}

TEST(Krk, MovesOfASmallPosition) {
  // White's king in the corner a1, the rook beside it on b1, Black far away.
  EXPECT_EQ(moves(optimal(), "Ka1 Rb1 kh8"),
            "Ka2 Kb2 Rc1 Rd1 Re1 Rf1 Rg1 Rh1 Rb2 Rb3 Rb4 Rb5 Rb6 Rb7 Rb8 ");
  // Kings face to face on the d file: rank 5 belongs to Black's king.
  EXPECT_EQ(moves(optimal(), "Kd4 Ra1 kd6"),
            "Kc3 Kd3 Ke3 Kc4 Ke4 "
            "Rb1 Rc1 Rd1 Re1 Rf1 Rg1 Rh1 Ra2 Ra3 Ra4 Ra5 Ra6 Ra7 Ra8 ");
}

TEST(Krk, TheFourKindsOfStep) {
  // Mate on the back rank: the king on b6 guards a7, b7 and c7 against b8.
  EXPECT_EQ(after(optimal(), "Kb6 Rh1 kb8", "Rh8"), "mate");
  // The king in the corner, the rook cuts off the b file and is guarded at b7.
  EXPECT_EQ(after(optimal(), "Kb6 Rc7 ka8", "Rb7"), "stalemate");
  // Black steps to c5, the first of the squares from which mate takes longest.
  EXPECT_EQ(after(optimal(), "Ka1 Rh1 kd5", "Rh4"), "Ka1 Rh4 kc5");
  // The rook goes next to Black's king, unguarded.
  EXPECT_EQ(after(optimal(), "Ka1 Rh4 kd5", "Re4"), "rook lost");
}

TEST(Krk, NoSuchPosition) {
  EXPECT_FALSE(optimal().mdp->find_state("Kc3 Rd1 kd5"));  // Black in check with White to move
  EXPECT_FALSE(optimal().mdp->find_state("Kc3 Ra1 kd4"));  // kings side by side
}

TEST(Krk, TheDefenderPutsMateOffLongest) {
  for (unsigned index = 0; index < krk::placements; ++index) {
    const std::uint8_t fate = endgame().lost_in[index];
    if (fate == 0 || fate > krk::longest) continue;
    const Placement at = Placement::of(index);
    const unsigned reply = endgame().best_reply(at);
    for (const unsigned square : krk::enemy_moves(at)) {
      const int mate_in = endgame().mate_in[Placement{at.king, at.rook, square}.index()];
      ASSERT_LE(mate_in, square < reply ? fate - 1 : fate);
      ASSERT_TRUE(square != reply || mate_in == fate);
    }
  }
}

TEST(Krk, TheRandomDefenderMovesUniformly) {
  const World world = krk_world_with({{"defender", "random"}});
  const Mdp& mdp = *world.mdp;
  const State s = state(world, "Ka1 Rh4 kd5");
  std::uint64_t choice = mdp.choice_begin(s);
  while (mdp.action_name(choice) != "Re4") ++choice;
  // The king on d5 may go to c5, c6, d6 or take the rook on e4; rank 4 and the e file are covered.
  std::string replies;
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    EXPECT_EQ(mdp.probability(o), 0.25);
    replies += mdp.state_name(mdp.next(o)) + ", ";
  }
  EXPECT_EQ(replies, "rook lost, Ka1 Re4 kc5, Ka1 Re4 kc6, Ka1 Re4 kd6, ");
}

TEST(Krk, TheLongestStarts) {
  const World world = krk_world_with({{"start", "longest"}});
  EXPECT_EQ(world.mdp->start().size(), 916u);
  EXPECT_EQ(optimal().mdp->start().size(), 175'168u);
}

const World& learning() {
  static const World world = krk_world_with({{"defender", "learning"}});
  return world;
}

TEST(Krk, BlackLearnsWithMovesOfItsOwn) {
  // Of the 223,944 positions with Black to move 216 are mates and 68 stalemates: ends.
  EXPECT_EQ(learning().mdp->states(), 175'168u + 223'660u + 3u);
  EXPECT_EQ(learning().traits.players, 2u);
  EXPECT_TRUE(learning().traits.deterministic);
  EXPECT_EQ(learning().mdp->start().size(), 175'168u);
  EXPECT_EQ(moves(learning(), "Kd4 Ra1 kd6"), moves(optimal(), "Kd4 Ra1 kd6"));
  EXPECT_EQ(after(learning(), "Ka1 Rh4 kd5", "Re4"), "Ka1 Re4 kd5 black");
  EXPECT_EQ(moves(learning(), "Ka1 Re4 kd5 black"), "ke4 kc5 kc6 kd6 ");
  EXPECT_EQ(after(learning(), "Ka1 Re4 kd5 black", "ke4"), "rook lost");
  EXPECT_EQ(after(learning(), "Ka1 Re4 kd5 black", "kc6"), "Ka1 Re4 kc6");
  EXPECT_EQ(after(learning(), "Kb6 Rh1 kb8", "Rh8"), "mate");
  EXPECT_EQ(after(learning(), "Kb6 Rc7 ka8", "Rb7"), "stalemate");
  const auto environment = learning().make({1, 1, 0, nullptr});
  const State black = state(learning(), "Ka1 Re4 kd5 black");
  EXPECT_TRUE(environment->inspector()->text(0, black).ends_with("\nblack to move\n"));
}

// What the tables say solves V(s) = max over moves of reward - d V(next), d = sqrt(0.99): White's
// mate in n is worth d^(2 (n - 1)) = 0.99^(n - 1), Black's loss in n moves -d^(2 n - 1).
TEST(Krk, TheKnownValuesAreThoseOfBothSides) {
  const Mdp& mdp = *learning().mdp;
  const double d = mdp.discount();
  EXPECT_EQ(d, std::sqrt(0.99));
  std::vector<double> value(mdp.states());
  State s = 0;
  for (unsigned index = 0; index < krk::placements; ++index) {
    const std::uint8_t n = endgame().mate_in[index];
    if (n != krk::illegal) value[s++] = std::pow(d, 2 * (n - 1));
  }
  for (unsigned index = 0; index < krk::placements; ++index) {
    const std::uint8_t n = endgame().lost_in[index];
    if (n == 0 || n == krk::stalemate || n == krk::illegal) continue;
    value[s++] = n == krk::rook_falls ? 0.0 : -std::pow(d, 2 * n - 1);
  }
  ASSERT_EQ(s + 3, mdp.states());
  for (State at = 0; at < s; ++at) {
    double best = -2.0;
    for (std::uint64_t c = mdp.choice_begin(at); c < mdp.choice_end(at); ++c) {
      best = std::max(best, mdp.reward(c) + mdp.carry(d) * value[mdp.next(c)]);
    }
    ASSERT_NEAR(best, value[at], 1e-14) << mdp.state_name(at);
  }
}

TEST(Krk, LooksLikeABoard) {
  const auto environment = optimal().make({1, 1, 0, nullptr});
  Inspector* const look = environment->inspector();
  EXPECT_EQ(look->text(0, state(optimal(), "Kc3 Ra1 kd5")),
            "8 . . . . . . . .\n7 . . . . . . . .\n6 . . . . . . . .\n5 . . . k . . . .\n"
            "4 . . . . . . . .\n3 . . K . . . . .\n2 . . . . . . . .\n1 R . . . . . . .\n"
            "  a b c d e f g h\n");
  EXPECT_EQ(look->text(0, state(optimal(), "rook lost")), "rook lost\n");
  EXPECT_EQ(look->drawing(0, 0).width, 9.0);
}

TEST(Krk, RefusesOtherDefenders) {
  EXPECT_FALSE(find_world("krk", {{"defender", "sleeping"}}));
  EXPECT_FALSE(find_world("krk", {{"discount", "1.5"}}));
}

}  // namespace
}  // namespace quoll
