// The chess endgame king and rook against king. The learner is White; a state is a position with
// White to move, "Kc3 Ra1 kd5", an action White's move, "Ra8" or "Kd3", and Black's reply is part
// of the step. Reward 1 for mate, 0 else, so that the value of a position is 0.99^(n - 1) when mate
// takes n moves at best. Three ends: "mate", "stalemate" and "rook lost", both draws.
//
// defender=optimal: Black takes the rook if possible, else puts off mate longest, by the lowest
// square among equals; the world is deterministic. defender=random: a uniformly random legal move.
// defender=learning: Black learns too. A step is one piece's move and passes the turn, values are
// those of the player to move (negamax), and 223,660 states with Black to move, named
// "Kc3 Ra1 kd5 black", follow White's; their actions are "kd6" and the like. A step is half a move
// and counts sqrt(discount), so that White's positions are worth what they are against the best
// defender.
// start=any: each of the 175,168 positions, equally likely; longest: the 916 with mate in 16.
// Games are cut off after 50 moves of each side, as chess calls them drawn.
//
// Draws: a start takes one number; a step takes one, used with the random defender only, whose
// replies are ordered by square, a1 first. JSON state: the position's name.
//
// Source: the rules of chess; the tables are solved here (krk_endgame.hpp).

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "quoll/env/world.hpp"

#include "quoll/env/worlds/krk_endgame.hpp"

namespace quoll {
namespace {

using krk::Placement;

enum class Defender : std::uint8_t { optimal, random, learning };
constexpr std::string_view defender_names[] = {"optimal", "random", "learning"};
enum class Starts : std::uint8_t { any, longest };
constexpr std::string_view start_names[] = {"any", "longest"};

struct KrkSettings {
  Defender defender = Defender::optimal;
  Starts start = Starts::any;
  double discount = 0.99;

  void describe(Describer& describe) {
    describe.choice("defender", defender, defender_names,
                    "how Black, with the bare king, replies; learning: both sides learn");
    describe.choice("start", start, start_names,
                    "any position with White to move, or those with the longest mate");
    describe("discount", discount, std::numeric_limits<double>::denorm_min(), 1.0,
             "the reward's factor per move");
  }
};

constexpr std::string_view end_names[] = {"mate", "stalemate", "rook lost"};

// What the states are: legal placements with White to move, then those with Black to move if Black
// learns, then the ends.
struct Positions {
  std::vector<unsigned> placement;  // per state that is no end
  State blacks = 0;                 // the first state with Black to move
  bool black_moves(State s) const { return s >= blacks; }
};

class Compiler {
 public:
  explicit Compiler(const KrkSettings& settings)
      : settings_(settings), endgame_(krk::solve_endgame()) {
    number(white_, [&](unsigned index) { return endgame_.mate_in[index] != krk::illegal; });
    positions_.blacks = static_cast<State>(positions_.placement.size());
    if (learning()) {
      number(black_, [&](unsigned index) {
        const std::uint8_t fate = endgame_.lost_in[index];
        return fate != 0 && fate != krk::stalemate && fate != krk::illegal;
      });
    }
    mate_ = static_cast<State>(positions_.placement.size());
  }

  Result<Mdp> model() {
    name_everything();
    arrays_.choice_begin.push_back(0);
    if (random()) arrays_.outcome_begin.push_back(0);
    for (State s = 0; s < mate_; ++s) {
      const Placement at = Placement::of(positions_.placement[s]);
      if (positions_.black_moves(s)) {
        for (const unsigned to : krk::enemy_moves(at)) add_reply(to, at);
      } else {
        for (const unsigned to : krk::king_moves(at)) add_choice(to, {to, at.rook, at.enemy});
        for (const unsigned to : krk::rook_moves(at)) add_choice(64 + to, {at.king, to, at.enemy});
        const bool longest = endgame_.mate_in[at.index()] == krk::longest;
        if (longest || settings_.start == Starts::any) arrays_.start.push_back(s);
      }
      arrays_.choice_begin.push_back(arrays_.action.size());
    }
    for (std::size_t end = 0; end < std::size(end_names); ++end) {
      arrays_.choice_begin.push_back(arrays_.action.size());
    }
    arrays_.discount = learning() ? std::sqrt(settings_.discount) : settings_.discount;
    arrays_.alternating = learning();
    return Mdp::make(std::move(arrays_));
  }

  Positions positions() && { return std::move(positions_); }

 private:
  bool random() const { return settings_.defender == Defender::random; }
  bool learning() const { return settings_.defender == Defender::learning; }

  void number(std::vector<State>& state, const auto& is_state) {
    state.resize(krk::placements);
    for (unsigned index = 0; index < krk::placements; ++index) {
      if (!is_state(index)) continue;
      state[index] = static_cast<State>(positions_.placement.size());
      positions_.placement.push_back(index);
    }
  }

  void name_everything() {
    std::string text;
    std::vector<std::uint64_t> begin{0};
    const auto end_name = [&] { begin.push_back(text.size()); };
    for (State s = 0; s < mate_; ++s) {
      text += krk::name_of(Placement::of(positions_.placement[s]));
      if (positions_.black_moves(s)) text += " black";
      end_name();
    }
    for (const std::string_view end : end_names) {
      text += end;
      end_name();
    }
    arrays_.state_names = Names::stored(std::move(text), std::move(begin));
    for (const char piece : {'K', 'R', 'k'}) {
      if (piece == 'k' && !learning()) break;
      for (unsigned to = 0; to < 64; ++to) {
        arrays_.action_names.push_back(piece + krk::name_of_square(to));
      }
    }
  }

  // White's move `action` led to `at`, Black to move.
  void add_choice(unsigned action, Placement at) {
    const std::uint8_t fate = endgame_.lost_in[at.index()];
    arrays_.action.push_back(action);
    arrays_.reward.push_back(fate == 0 ? 1.0 : 0.0);
    if (fate == 0) {
      add_outcome(mate_, 1.0);
    } else if (fate == krk::stalemate) {
      add_outcome(mate_ + 1, 1.0);
    } else if (learning()) {
      add_outcome(black_[at.index()], 1.0);
    } else if (random()) {
      const krk::Squares replies = krk::enemy_moves(at);
      for (const unsigned to : replies) add_outcome(after(at, to), 1.0 / replies.count);
    } else {
      add_outcome(after(at, fate == krk::rook_falls ? at.rook : endgame_.best_reply(at)), 1.0);
    }
    if (random()) arrays_.outcome_begin.push_back(arrays_.next.size());
  }
  // Black, who learns, moves from `at` to a square.
  void add_reply(unsigned to, Placement at) {
    arrays_.action.push_back(128 + to);
    arrays_.reward.push_back(0.0);
    add_outcome(after(at, to), 1.0);
  }
  State after(Placement at, unsigned reply) const {
    return reply == at.rook ? mate_ + 2 : white_[Placement{at.king, at.rook, reply}.index()];
  }
  void add_outcome(State next, double probability) {
    arrays_.next.push_back(next);
    if (random()) arrays_.probability.push_back(probability);
  }

  KrkSettings settings_;
  krk::Endgame endgame_;
  Positions positions_;
  std::vector<State> white_, black_;  // per placement, with that side to move
  State mate_ = 0;                    // the first of the ends
  MdpArrays arrays_;
};

char piece_on(Placement at, unsigned square) {
  if (square == at.king) return 'K';
  if (square == at.rook) return 'R';
  return square == at.enemy ? 'k' : '.';
}

// Capital letters are White's.
std::string board_text(Placement at) {
  std::string text;
  for (unsigned rank = 8; rank-- > 0;) {
    text += static_cast<char>('1' + rank);
    for (unsigned file = 0; file < 8; ++file) {
      text += ' ';
      text += piece_on(at, rank * 8 + file);
    }
    text += '\n';
  }
  return text + "  a b c d e f g h\n";
}

Drawing board() {
  Drawing drawing{9.0, 9.0, {}};
  for (unsigned square = 0; square < 64; ++square) {
    const double x = 1.0 + (square & 7u), y = 7.0 - (square >> 3);
    drawing.box((square + (square >> 3)) % 2 == 0 ? Ink::faint : Ink::floor, x, y, 1.0, 1.0);
  }
  for (unsigned i = 0; i < 8; ++i) {
    drawing.write(Ink::line, 0.5, 7.5 - i, 0.5, std::string(1, static_cast<char>('1' + i)));
    drawing.write(Ink::line, 1.5 + i, 8.5, 0.5, std::string(1, static_cast<char>('a' + i)));
  }
  return drawing;
}

Drawing board_drawing(Placement at) {
  Drawing drawing = board();
  for (const unsigned square : {at.king, at.rook, at.enemy}) {
    const double x = 1.5 + (square & 7u), y = 7.5 - (square >> 3);
    const bool black = square == at.enemy;
    drawing.circle(black ? Ink::danger : Ink::agent, x, y, 0.42);
    drawing.write(Ink::floor, x, y, 0.55, black ? "k" : square == at.king ? "K" : "R");
  }
  return drawing;
}

Looks looks_of(Positions positions) {
  const auto shared = std::make_shared<const Positions>(std::move(positions));
  const auto end_of = [shared](State state) -> std::string_view {
    const std::size_t count = shared->placement.size();
    return state < count ? std::string_view() : end_names[state - count];
  };
  Looks looks;
  looks.text = [shared, end_of](State state) {
    if (const std::string_view end = end_of(state); !end.empty()) return std::string(end) + "\n";
    return board_text(Placement::of(shared->placement[state])) +
           (shared->black_moves(state) ? "black to move\n" : "");
  };
  looks.drawing = [shared, end_of](State state) {
    const std::string_view end = end_of(state);
    if (end.empty()) return board_drawing(Placement::of(shared->placement[state]));
    Drawing drawing = board();
    drawing.write(Ink::line, 5.0, 4.0, 1.0, std::string(end));
    return drawing;
  };
  return looks;
}

Result<World> make(const Parameters& parameters) {
  const Result<KrkSettings> settings = read_parameters<KrkSettings>("krk", parameters);
  if (!settings) return settings.error();
  Compiler compiler(*settings);
  Result<Mdp> mdp = compiler.model();
  if (!mdp) return mdp.error();
  const std::uint64_t limit = settings->defender == Defender::learning ? 100 : 50;
  return to_world("krk", std::move(*mdp), looks_of(std::move(compiler).positions()), limit);
}

}  // namespace

extern const WorldEntry krk_world;
const WorldEntry krk_world{"krk",
                           "",
                           "chess: mate with king and rook against the bare king",
                           "the rules of chess; solved by retrograde analysis (Thompson 1986)",
                           make,
                           parameters_of<KrkSettings>,
                           [] { return Offer{{22, 175'171}, 50, 0.99}; }};

}  // namespace quoll
