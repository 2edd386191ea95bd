#pragma once
// Board games of two who move in turn, compiled to models: x moves first, o second. A game is a
// struct that knows its boards:
//
//   struct Game {
//     struct Board;                                        // any copyable type
//     Board begin() const;
//     std::uint64_t key(const Board&) const;               // differs from board to board
//     Outcome outcome(const Board&) const;                 // of a board that play() gave
//     Side to_move(const Board&) const;
//     std::string cells(const Board&) const;               // "X.O/.X./..O", the top row first
//     std::optional<Board> parse(std::string_view cells) const;   // nothing: no board of the game
//     std::vector<std::string> move_names() const;
//     bool legal(const Board&, std::uint32_t move) const;  // of a running game
//     Board play(const Board&, std::uint32_t move) const;
//   };
//
// States are the boards that can come up, breadth first by move; their names are the cells and
// whose turn it is, "X.O/.X./..O x", or how the game ended: "X won", "O won", "drawn". A winning
// move earns 1, losing -1, a draw 0.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "quoll/env/drawing.hpp"
#include "quoll/model/mdp.hpp"

#include "quoll/env/worlds/table_writer.hpp"

namespace quoll::board {

enum class Side : std::uint8_t { x, o };
inline constexpr std::string_view side_names[] = {"x", "o"};
enum class Outcome : std::uint8_t { running, x_won, o_won, drawn };
inline constexpr std::string_view outcome_names[] = {"", "X won", "O won", "drawn"};

inline Side other(Side side) {
  return side == Side::x ? Side::o : Side::x;
}
inline Outcome won_by(Side side) {
  return side == Side::x ? Outcome::x_won : Outcome::o_won;
}

/// " x", " o" or how the game ended: what follows the cells in a name.
inline std::string turn_text(Outcome outcome, Side to_move) {
  if (outcome != Outcome::running) return std::string(outcome_names[static_cast<int>(outcome)]);
  return std::string(side_names[static_cast<int>(to_move)]);
}

template <class Game>
std::string name_of(const Game& game, const typename Game::Board& at) {
  return game.cells(at) + " " + turn_text(game.outcome(at), game.to_move(at));
}

/// Cells as lines of a picture, blanks between them, and a last line: whose turn it is.
std::string text_of(std::string_view cells, std::string_view turn);
/// The same as shapes: x as crosses, o as rings.
Drawing drawing_of(std::string_view cells, std::string_view turn);

/// Probability of each move.
using Reply = std::vector<std::pair<std::uint32_t, double>>;

template <class Game>
struct Compiled {
  Mdp mdp;
  std::vector<typename Game::Board> boards;  ///< per state
};

template <class Game>
class Compiler {
 public:
  using Board = typename Game::Board;

  Compiler(const Game& game, double discount) : game_(game), table_(discount) {}

  /// Both players are the learner: a model in which the turn passes.
  Result<Compiled<Game>> self_play() {
    table_.arrays().alternating = true;
    table_.start(state_of(game_.begin()));
    for (State s = 0; s < boards_.size(); ++s) {
      each_move(s, [&](std::uint32_t move, const Board& after, double reward) {
        table_.choice(move);
        table_.outcome(1.0, state_of(after), reward);
      });
    }
    return finish();
  }

  /// One player has `own` side; the other one's answer is part of the step. reply(board) gives a
  /// Result<Reply> for the boards at which the other side is to move.
  template <class Replies>
  Result<Compiled<Game>> against(Side own, const Replies& reply) {
    if (own == Side::x) {
      table_.start(state_of(game_.begin()));
    } else {
      const Result<Reply> first = reply(game_.begin());
      if (!first) return first.error();
      for (const auto& [move, p] : *first) {
        table_.start(state_of(game_.play(game_.begin(), move)), p);
      }
    }
    std::optional<Error> error;
    for (State s = 0; s < boards_.size(); ++s) {
      each_move(s, [&](std::uint32_t move, const Board& after, double reward) {
        table_.choice(move);
        if (game_.outcome(after) != Outcome::running) {
          table_.outcome(1.0, state_of(after), reward);
          return;
        }
        const Result<Reply> answer = reply(after);
        if (!answer) {
          if (!error) error = answer.error();
          table_.outcome(1.0, s, 0.0);
          return;
        }
        for (const auto& [to, p] : *answer) {
          const Board last = game_.play(after, to);
          const bool lost = game_.outcome(last) == won_by(other(own));
          table_.outcome(p, state_of(last), lost ? -1.0 : 0.0);
        }
      });
    }
    if (error) return *error;
    return finish();
  }

 private:
  State state_of(const Board& board) {
    const auto [found, added] =
        index_.try_emplace(game_.key(board), static_cast<State>(boards_.size()));
    if (added) boards_.push_back(board);
    return found->second;
  }

  template <class Use>
  void each_move(State s, const Use& use) {
    const Board at = boards_[s];
    table_.state(name_of(game_, at));
    if (game_.outcome(at) != Outcome::running) return;
    const auto moves = static_cast<std::uint32_t>(game_.move_names().size());
    for (std::uint32_t move = 0; move < moves; ++move) {
      if (!game_.legal(at, move)) continue;
      const Board after = game_.play(at, move);
      use(move, after, game_.outcome(after) == won_by(game_.to_move(at)) ? 1.0 : 0.0);
    }
  }

  Result<Compiled<Game>> finish() {
    for (const std::string& name : game_.move_names()) {
      table_.arrays().action_names.push_back(name);
    }
    Result<Mdp> mdp = table_.finish();
    if (!mdp) return mdp.error();
    return Compiled<Game>{std::move(*mdp), std::move(boards_)};
  }

  const Game& game_;
  TableWriter table_;
  std::unordered_map<std::uint64_t, State> index_;  // by key; only looked up
  std::vector<Board> boards_;
};

/// Every legal move equally often.
template <class Game>
Reply uniform_reply(const Game& game, const typename Game::Board& at) {
  Reply reply;
  const auto moves = static_cast<std::uint32_t>(game.move_names().size());
  for (std::uint32_t move = 0; move < moves; ++move) {
    if (game.legal(at, move)) reply.emplace_back(move, 0.0);
  }
  for (auto& [move, p] : reply) p = 1.0 / static_cast<double>(reply.size());
  return reply;
}

}  // namespace quoll::board
