// Tic-tac-toe: three in a row on a board of nine cells. A state is a board and whose turn it is,
// "X.O/.X./..O x", the top row first, or how the game ended ("X.O/XO./X.. X won"); an action is a
// cell, "a1" at the bottom left to "c3" at the top right. Whoever completes a row earns 1.
//
// opponent=self: the learner plays both sides. A step is one move and passes the turn, values are
// those of the player to move (negamax); 5,478 positions.
// opponent=uniform, perfect or a file: the learner has the side `mark`, and the answer is part of
// the step, with reward -1 when it wins. uniform: any free cell, equally likely. perfect: a move of
// the greatest game value, the first in the order of the actions (a3, b3, c3, a2, ... c1). A file
// is a policy with the names of this world, as `play --policy` takes it; it must have an action
// wherever it can come to move, or unknown=uniform takes any free cell there.
//
// Draws: a start takes one number; a step takes one, used where the opponent moves by chance. JSON
// state: the position's name.
//
// Source: the rules. Sutton, Barto 2018, section 1.5 (learning to play it); Zermelo 1913.

#include <bit>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "quoll/env/world.hpp"

#include "quoll/env/worlds/board_game.hpp"
#include "quoll/env/worlds/board_opponent.hpp"

namespace quoll {
namespace {

using board::Opponent;
using board::Outcome;
using board::Reply;
using board::Side;

struct TicTacToe {
  struct Board {
    std::uint32_t x = 0, o = 0;  // bit i: cell i in reading order
  };

  Board begin() const { return {}; }
  std::uint64_t key(const Board& at) const { return at.x | std::uint64_t{at.o} << 9; }
  static bool has_row(std::uint32_t cells) {
    constexpr std::uint32_t rows[] = {0007, 0070, 0700, 0111, 0222, 0444, 0421, 0124};
    for (const std::uint32_t row : rows) {
      if ((cells & row) == row) return true;
    }
    return false;
  }
  Outcome outcome(const Board& at) const {
    if (has_row(at.x)) return Outcome::x_won;
    if (has_row(at.o)) return Outcome::o_won;
    return (at.x | at.o) == 0777 ? Outcome::drawn : Outcome::running;
  }
  Side to_move(const Board& at) const {
    return std::popcount(at.x) == std::popcount(at.o) ? Side::x : Side::o;
  }
  std::string cells(const Board& at) const {
    std::string text;
    for (std::uint32_t i = 0; i < 9; ++i) {
      if (i == 3 || i == 6) text += '/';
      text += at.x >> i & 1u ? 'X' : at.o >> i & 1u ? 'O' : '.';
    }
    return text;
  }
  std::optional<Board> parse(std::string_view cells) const {
    if (cells.size() != 11 || cells[3] != '/' || cells[7] != '/') return std::nullopt;
    Board at;
    for (std::uint32_t i = 0; i < 9; ++i) {
      const char cell = cells[i + i / 3];
      if (cell != 'X' && cell != 'O' && cell != '.') return std::nullopt;
      if (cell == 'X') at.x |= 1u << i;
      if (cell == 'O') at.o |= 1u << i;
    }
    const int more = std::popcount(at.x) - std::popcount(at.o);
    const bool x_row = has_row(at.x), o_row = has_row(at.o);  // made by the last move
    const bool possible = more == 0 ? !x_row : more == 1 && !o_row;
    return possible ? std::optional<Board>(at) : std::nullopt;
  }
  std::vector<std::string> move_names() const {
    return {"a3", "b3", "c3", "a2", "b2", "c2", "a1", "b1", "c1"};
  }
  bool legal(const Board& at, std::uint32_t move) const {
    return ((at.x | at.o) >> move & 1u) == 0;
  }
  Board play(const Board& at, std::uint32_t move) const {
    const std::uint32_t cell = 1u << move;
    return to_move(at) == Side::x ? Board{at.x | cell, at.o} : Board{at.x, at.o | cell};
  }
};

// The value to the player to move, by going through the whole game once.
class GameTree {
 public:
  int value(TicTacToe::Board at) {
    const Outcome outcome = game_.outcome(at);
    if (outcome == Outcome::drawn) return 0;
    if (outcome != Outcome::running) return -1;  // only the other one can have won
    const auto known = known_.find(game_.key(at));
    if (known != known_.end()) return known->second;
    int best = -1;
    for (std::uint32_t move = 0; move < 9; ++move) {
      if (game_.legal(at, move)) best = std::max(best, -value(game_.play(at, move)));
    }
    known_.emplace(game_.key(at), best);
    return best;
  }
  Reply best(TicTacToe::Board at) {
    const int goal = value(at);
    std::uint32_t move = 0;
    while (!game_.legal(at, move) || -value(game_.play(at, move)) != goal) ++move;
    return {{move, 1.0}};
  }

 private:
  TicTacToe game_;
  std::unordered_map<std::uint64_t, int> known_;  // only looked up
};

struct TicTacToeSettings : board::OpponentSettings {
  double discount = 1.0;

  void describe(Describer& describe) {
    board::OpponentSettings::describe(
        describe, "self, uniform, perfect, or a file .csv, .json or .quoll with a policy");
    describe("discount", discount, std::numeric_limits<double>::denorm_min(), 1.0,
             "the reward's factor per step");
  }
};

using Model = board::Compiled<TicTacToe>;

Result<Model> compile(const TicTacToeSettings& settings, const Parameters& parameters) {
  const TicTacToe game;
  board::Compiler compiler(game, settings.discount);
  const Result<Opponent> kind = settings.kind(true);
  if (!kind) return kind.error();
  if (*kind == Opponent::self) return compiler.self_play();
  if (*kind == Opponent::uniform) {
    return compiler.against(settings.mark, [&](TicTacToe::Board at) {
      return Result<Reply>(board::uniform_reply(game, at));
    });
  }
  if (*kind == Opponent::perfect) {
    GameTree tree;
    return compiler.against(settings.mark,
                            [&](TicTacToe::Board at) { return Result<Reply>(tree.best(at)); });
  }
  const auto saved = board::SavedMoves<TicTacToe>::read(game, "tic-tac-toe", settings, parameters);
  if (!saved) return saved.error();
  return compiler.against(settings.mark, [&](TicTacToe::Board at) { return saved->reply(at); });
}

Result<World> make(const Parameters& parameters) {
  const Result<TicTacToeSettings> settings =
      read_parameters<TicTacToeSettings>("tic-tac-toe", parameters);
  if (!settings) return settings.error();
  Result<Model> model = compile(*settings, parameters);
  if (!model) return model.error();
  const auto boards =
      std::make_shared<const std::vector<TicTacToe::Board>>(std::move(model->boards));
  const auto turn = [](TicTacToe::Board at) {
    return board::turn_text(TicTacToe().outcome(at), TicTacToe().to_move(at));
  };
  Looks looks;
  looks.text = [boards, turn](State s) {
    return board::text_of(TicTacToe().cells((*boards)[s]), turn((*boards)[s]));
  };
  looks.drawing = [boards, turn](State s) {
    return board::drawing_of(TicTacToe().cells((*boards)[s]), turn((*boards)[s]));
  };
  return to_world("tic-tac-toe", std::move(model->mdp), std::move(looks));
}

}  // namespace

extern const WorldEntry tic_tac_toe_world;
const WorldEntry tic_tac_toe_world{"tic-tac-toe",
                                   "",
                                   "three in a row, against oneself or an opponent",
                                   "the rules; Sutton, Barto 2018, section 1.5",
                                   make,
                                   parameters_of<TicTacToeSettings>};

}  // namespace quoll
