// Connect Four: stones fall to the bottom of a column; `connect` in a row, across, up or aslant,
// win. rows=6, columns=7, connect=4 is the game sold by Milton Bradley since 1974; an action is a
// column, "a" to "g".
//
// opponent=self: the learner plays both sides; a step is one move and passes the turn, and values
// and observations are those of the player to move. Whoever connects earns 1. opponent=uniform or a
// file: the learner has the side `mark`, the answer is part of the step, and reward -1 when that
// wins. uniform answers in any open column; a file is a policy with the names of this world, as
// `play --policy` takes it; where it says nothing unknown=uniform takes any open column. A saved
// network as an opponent is asked on every board, for what it would observe there. A draw earns 0.
// A stone into a full column loses at once, reward -1; so it does for a network as an opponent.
//
// Observation {rows, columns, 2}, the top row first: 1 where a stone of the player to move lies,
// then 1 where one of the other lies. JSON state: {"board": "......./.../... x"}: the cells, the
// top row first, and whose turn it is or how the game ended ("X won", "O won", "drawn").
//
// Draws: where the opponent moves by chance one, below the number of open columns: at the start
// with mark=o, and in a step if the game goes on after the learner's move; else none.
//
// Boards of at most 16 cells are compiled to a model, whose states are named like the JSON state
// and whose actions are the open columns; a start and a step then take one number each.
//
// Source: the rules; Allis 1988 ("A knowledge-based approach of Connect-Four"), who proves that the
// first player wins on 6 x 7; the stones' bits as in Tromp's Fhourstones: a column is rows + 1
// bits, the topmost always 0, so that shifts find rows of stones.

#include "quoll/env/worlds/connect_four.hpp"

#include <limits>
#include <memory>
#include <utility>

#include "quoll/env/dynamics.hpp"

#include "quoll/env/worlds/board_opponent.hpp"

namespace quoll {
namespace {

using board::Opponent;
using board::Outcome;
using board::Reply;
using board::Side;

constexpr std::uint64_t most_compiled = 16;  // cells

using Saved = board::SavedMoves<ConnectFour>;

struct ConnectFourSettings : board::OpponentSettings {
  std::uint64_t rows = 6, columns = 7, connect = 4;
  double discount = 1.0;

  void describe(Describer& describe) {
    describe("rows", rows, 2, 8, "cells of a column");
    describe("columns", columns, 2, 10, "columns; rows + 1 times columns is at most 64");
    describe("connect", connect, 2, 10, "stones in a row that win");
    board::OpponentSettings::describe(
        describe, "self, uniform, or a file .csv, .json or .quoll with a policy of such boards");
    describe("discount", discount, std::numeric_limits<double>::denorm_min(), 1.0,
             "the reward's factor per step");
  }
};

struct ConnectFourWorld {
  using Position = ConnectFourPosition;
  ConnectFour game;
  Opponent opponent = Opponent::self;
  Side mark = Side::x;
  std::shared_ptr<const Saved> saved = nullptr;  // with an opponent from a file
  SeeingPlayer player = {};                      // that has no table

  Spaces spaces() const {
    const auto rows = static_cast<std::uint32_t>(game.rows);
    const auto columns = static_cast<std::uint32_t>(game.columns);
    return {columns, 0, rows * columns * 2, {rows, columns, 2}, true};
  }
  Position start(auto& dice) const {
    Position at{game, game.begin(), Outcome::running};
    if (opponent != Opponent::self && mark == Side::o) respond(at, dice);
    return at;
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (at.outcome != Outcome::running) return {0.0, true, false, false};
    const Side own = game.to_move(at.stones);
    if (action >= game.columns || !game.legal(at.stones, action)) {
      at.outcome = board::won_by(board::other(own));
      return {-1.0, true, false, false};
    }
    put(at, action);
    if (at.outcome == Outcome::running && opponent != Opponent::self) respond(at, dice);
    const bool over = at.outcome != Outcome::running;
    const double reward = at.outcome == board::won_by(own)                 ? 1.0
                          : at.outcome == board::won_by(board::other(own)) ? -1.0
                                                                           : 0.0;
    return {reward, over, false, !over && opponent == Opponent::self};
  }
  void observe(const Position& at, std::span<float> x) const { game.observe(at.stones, x); }
  std::vector<std::string> action_names() const { return game.move_names(); }
  std::string text(const Position& at) const {
    return board::text_of(game.cells(at.stones), turn(at));
  }
  Drawing drawing(const Position& at) const {
    return board::drawing_of(game.cells(at.stones), turn(at));
  }

 private:
  void respond(Position& at, auto& dice) const {
    const std::uint32_t column = answer(at.stones, dice);
    if (column < game.columns && game.legal(at.stones, column)) return put(at, column);
    at.outcome = board::won_by(board::other(game.to_move(at.stones)));
  }
  // The opponent's column: as the file says, else any open one. A player without a table may choose
  // a full one.
  std::uint32_t answer(const ConnectFour::Board& at, auto& dice) const {
    if (player) {
      std::vector<float> seen(spaces().observation);
      game.observe(at, seen);
      return player(seen);
    }
    if (saved) {
      if (const std::optional<std::uint32_t> said = saved->move(at)) return *said;
    }
    std::uint32_t open = dice.below(game.open(at));
    std::uint32_t column = 0;
    while (!game.legal(at, column) || open-- > 0) ++column;
    return column;
  }
  void put(Position& at, std::uint32_t column) const {
    at.stones = game.play(at.stones, column);
    at.outcome = game.outcome(at.stones);
  }
  std::string turn(const Position& at) const {
    return board::turn_text(at.outcome, game.to_move(at.stones));
  }
};

Looks looks_of(const ConnectFour& game, std::vector<ConnectFour::Board> boards) {
  const auto shared = std::make_shared<const std::vector<ConnectFour::Board>>(std::move(boards));
  const auto turn = [game](const ConnectFour::Board& at) {
    return board::turn_text(game.outcome(at), game.to_move(at));
  };
  Looks looks;
  looks.text = [=](State s) {
    return board::text_of(game.cells((*shared)[s]), turn((*shared)[s]));
  };
  looks.drawing = [=](State s) {
    return board::drawing_of(game.cells((*shared)[s]), turn((*shared)[s]));
  };
  looks.observation = [=](State s) {
    const Spaces spaces = ConnectFourWorld{game}.spaces();
    std::vector<float> x(spaces.observation);
    game.observe((*shared)[s], x);
    return observation_tree(spaces, x);
  };
  return looks;
}

Result<board::Compiled<ConnectFour>> compile(const ConnectFour& game,
                                             const ConnectFourSettings& settings, Opponent opponent,
                                             const Saved* saved) {
  board::Compiler compiler(game, settings.discount);
  if (opponent == Opponent::self) return compiler.self_play();
  return compiler.against(settings.mark, [&](const ConnectFour::Board& at) {
    return saved ? saved->reply(at) : Result<Reply>(board::uniform_reply(game, at));
  });
}

// Boards without a model: what the opponent does must be known in every position.
Result<World> played(const ConnectFour& game, const ConnectFourSettings& settings,
                     Opponent opponent, std::shared_ptr<const Saved> saved) {
  const SeeingPlayer player = saved ? saved->player() : SeeingPlayer();
  if (saved && !player && settings.unknown != board::Unknown::uniform) {
    return Error{"--with unknown", 0, 0,
                 "uniform expected: no table says what to do on every board of " +
                     std::to_string(settings.rows * settings.columns) +
                     " cells; a saved network does",
                 ""};
  }
  WorldFacts facts;
  facts.discount = settings.discount;
  facts.traits.deterministic = opponent == Opponent::self;
  facts.traits.players = opponent == Opponent::self ? 2 : 1;
  facts.traits.reward_bounds = {-1.0, 1.0};
  return to_world("connect-four",
                  ConnectFourWorld{game, opponent, settings.mark, std::move(saved), player}, facts);
}

Result<World> make(const Parameters& parameters) {
  const Result<ConnectFourSettings> settings =
      read_parameters<ConnectFourSettings>("connect-four", parameters);
  if (!settings) return settings.error();
  if ((settings->rows + 1) * settings->columns > 64) {
    return Error{"--with columns", 0, 0,
                 "at most " + std::to_string(64 / (settings->rows + 1)) + " columns of " +
                     std::to_string(settings->rows) + " rows expected, not " +
                     std::to_string(settings->columns),
                 ""};
  }
  const Result<Opponent> opponent = settings->kind(false);
  if (!opponent) return opponent.error();
  const ConnectFour game{settings->rows, settings->columns, settings->connect};
  std::shared_ptr<const Saved> saved;
  if (*opponent == Opponent::file) {
    Result<Saved> read = Saved::read(game, "connect-four", *settings, parameters);
    if (!read) return read.error();
    saved = std::make_shared<const Saved>(std::move(*read));
  }
  if (settings->rows * settings->columns > most_compiled) {
    return played(game, *settings, *opponent, std::move(saved));
  }
  Result<board::Compiled<ConnectFour>> model = compile(game, *settings, *opponent, saved.get());
  if (!model) return model.error();
  return to_world("connect-four", std::move(model->mdp), looks_of(game, std::move(model->boards)));
}

}  // namespace

extern const WorldEntry connect_four_world;
const WorldEntry connect_four_world{
    "connect-four",
    "",
    "four in a row of falling stones, against oneself or an opponent",
    "the rules; Allis 1988 proves that the first player wins",
    make,
    parameters_of<ConnectFourSettings>};

}  // namespace quoll
