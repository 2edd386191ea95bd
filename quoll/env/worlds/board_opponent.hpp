#pragma once
// Who has the other side of a board game: the learner itself, chance, a perfect player where the
// game knows one, or a policy that somebody saved.

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "quoll/base/parameters.hpp"
#include "quoll/base/text.hpp"
#include "quoll/env/policy_reader.hpp"
#include "quoll/model/formats/fields.hpp"
#include "quoll/model/formats/lines.hpp"

#include "quoll/env/worlds/board_game.hpp"

namespace quoll::board {

enum class Opponent : std::uint8_t { self, uniform, perfect, file };
/// What a player from a file does where the file says nothing.
enum class Unknown : std::uint8_t { refuse, uniform };
inline constexpr std::string_view unknown_names[] = {"refuse", "uniform"};

/// The parameters that games have in common.
struct OpponentSettings {
  std::string opponent = "self";
  Side mark = Side::x;
  Unknown unknown = Unknown::refuse;

  void describe(Describer& describe, std::string_view who) {
    describe("opponent", opponent, who);
    describe.choice("mark", mark, side_names, "the learner's side against an opponent; x begins");
    describe.choice("unknown", unknown, unknown_names,
                    "what an opponent from a file does where the file says nothing");
  }
  /// What a parameter has no effect without.
  std::string_view needs(std::string_view name) const {
    if (name == "mark" && opponent == "self") return "an opponent";
    return name == "unknown" && !from_file() ? "an opponent from a file" : "";
  }
  bool from_file() const { return names_a_policy(opponent); }

  /// Error: a word that is none of those, with the nearest.
  Result<Opponent> kind(bool has_perfect) const;
};

/// The moves of a policy file: greedy on what was saved. A policy that knows no rows but what is
/// observed is kept as a player, for games that show it: `Game::observe`.
template <class Game>
class SavedMoves {
 public:
  using Board = typename Game::Board;

  /// `world` is the game's name as a world, `parameters` what was given for it. Error: file, line,
  /// what is no position or move of it.
  static Result<SavedMoves> read(const Game& game, std::string_view world,
                                 const OpponentSettings& settings, const Parameters& parameters) {
    SavedMoves saved(game, settings);
    const std::string& path = settings.opponent;
    Result<SavedPolicy> content = read_saved_policy(path, world, parameters);
    if (!content) return content.error();
    if (content->player) {
      saved.player_ = std::move(content->player);
      return saved;
    }
    Lines lines(content->rows);
    std::string_view line;
    bool header = true;
    while (lines.next(line)) {
      if (trim(line).empty() || line.front() == '#') continue;
      Fields fields;
      const auto refuse = [&](std::string expected) {
        return Error{path, path.ends_with(".csv") ? lines.number() : 0, 0, std::move(expected), ""};
      };
      if (fields.split(line) || fields.count != 2) return refuse("state,action expected");
      const std::string name(fields.text[0]), action(fields.text[1]);
      if (std::exchange(header, false)) {
        if (name == "state" && action == "action") continue;
        return refuse("the header state,action expected");
      }
      const std::optional<Board> board = saved.find_board(name);
      if (!board) {
        return refuse("a position of " + std::string(world) + " expected, not '" + name + "'");
      }
      if (action.empty()) continue;
      const std::optional<std::uint32_t> move = saved.find_move(*board, action);
      if (!move) return refuse("a legal move of " + name + " expected, not '" + action + "'");
      saved.moves_[game.key(*board)] = *move;
    }
    return saved;
  }

  /// The move that the file says, if any.
  std::optional<std::uint32_t> move(const Board& at) const {
    const auto found = moves_.find(game_.key(at));
    if (found == moves_.end()) return std::nullopt;
    return found->second;
  }
  /// Who moves instead, with no table: then no board is unknown.
  const SeeingPlayer& player() const { return player_; }
  /// The answer as a model takes it.
  Result<Reply> reply(const Board& at) const {
    if (const std::optional<std::uint32_t> said = move(at)) return Reply{{*said, 1.0}};
    if (settings_.unknown == Unknown::uniform) return uniform_reply(game_, at);
    return Error{
        settings_.opponent, 0, 0,
        "no action for state " + name_of(game_, at) + "; --with unknown=uniform takes any there",
        ""};
  }

 private:
  SavedMoves(const Game& game, const OpponentSettings& settings)
      : game_(game), settings_(settings) {}

  std::optional<Board> find_board(const std::string& name) const {
    const std::optional<Board> board = game_.parse(name.substr(0, name.find(' ')));
    if (!board || name_of(game_, *board) != name) return std::nullopt;
    return board;
  }
  // By name, or by number among the legal ones; an ended game has none.
  std::optional<std::uint32_t> find_move(const Board& at, std::string_view word) const {
    if (game_.outcome(at) != Outcome::running) return std::nullopt;
    const std::vector<std::string> names = game_.move_names();
    const std::optional<std::uint64_t> number = parse_count(word);
    std::uint64_t count = 0;
    for (std::uint32_t move = 0; move < names.size(); ++move) {
      if (!game_.legal(at, move)) continue;
      if (names[move] == word || number == count) return move;
      ++count;
    }
    return std::nullopt;
  }

  Game game_;
  OpponentSettings settings_;
  SeeingPlayer player_;
  std::unordered_map<std::uint64_t, std::uint32_t> moves_;  // by key; only looked up
};

}  // namespace quoll::board
