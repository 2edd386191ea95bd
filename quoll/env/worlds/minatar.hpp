#pragma once
// What the five games of MinAtar have in common (Young and Tian 2019, "MinAtar", arXiv 1903.03176;
// the rules are those of its program, version 1.0.15, step by step and oddities included):
//
// - A grid of 10 x 10 cells, x to the right, y down, row 0 at the top. An observation is 10 x 10 x
//   channels flags, row by row, the channels of a cell together; each game's file names its own.
// - Six actions: stay, left, up, right, down, fire = 0..5; minimal=true leaves those that the game
//   has a use for.
// - Sticky actions: each step begins with one uniform draw; below `sticky` the previous action is
//   repeated. A repeated action is the previous one of the next step. An episode begins with stay.
//   (In the original the last action of an episode is still the previous one of the next episode.)
// - Draws of a step: the sticky one first, then those that the game's file lists, in that order.
//   The numbers that the original draws, handed in as a tape, give the original's path.
// - The end is an end by the rules. The original knows no other limit; here one of 100,000 steps,
//   which no game comes near, stands for none: without it learning would cut at its usual 2,000,
//   and Freeway takes 2,500. Discount 0.99.
//
// A state as data has the game's fields and
//   previous   the action that a sticky step repeats
//   over       whether the episode has ended
// Sets of cells are ten rows of ten letters, '#' where there is something and '.' elsewhere.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/env/drawing.hpp"
#include "quoll/env/dynamics.hpp"
#include "quoll/env/parameters.hpp"

namespace quoll::minatar {

enum Move : std::uint8_t { stay, left, up, right, down, fire };
inline constexpr std::string_view move_names[] = {"stay", "left", "up", "right", "down", "fire"};
inline constexpr int move_x[] = {0, -1, 0, 1, 0, 0};
inline constexpr int move_y[] = {0, 0, -1, 0, 1, 0};

struct Settings {
  double sticky = 0.1;
  bool ramping = true;
  bool minimal = false;
};

/// The settings of a game; only one that ramps can be told not to.
template <class Game>
struct SettingsOf : Settings {
  void describe(Describer& describe) {
    describe("sticky", sticky, 0.0, 1.0, "probability that the previous action is repeated");
    if constexpr (Game::ramps) describe("ramping", ramping, "the game grows harder");
    describe("minimal", minimal, "offer only the actions that this game has a use for");
  }
};

inline bool outside(int x) {
  return x < 0 || x > 9;
}

/// A number of a state that must lie in [low, high].
template <class Number>
void persist_within(auto& archive, std::string_view name, Number& value, int low, int high) {
  archive(name, value);
  if (archive.saving() || (value >= low && value <= high)) return;
  archive.fail(std::string(name) + ": a whole number from " + std::to_string(low) + " to " +
               std::to_string(high) + " expected");
}

/// A number of a state that is shown as a word.
template <class Value>
void persist_word(auto& archive, std::string_view name, Value& value,
                  std::span<const std::string_view> words) {
  std::string word(words[static_cast<std::size_t>(value)]);
  archive(name, word);
  if (archive.saving()) return;
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) {
    value = static_cast<Value>(found - words.begin());
    return;
  }
  std::string all;
  for (const std::string_view one : words) (all += all.empty() ? "" : ", ") += one;
  archive.fail(std::string(name) + ": one of " + all + " expected");
}

/// What every position has.
struct Common {
  Move previous = stay;
  bool over = false;

  void persist_common(auto& archive) {
    persist_word(archive, "previous", previous, move_names);
    archive("over", over);
  }
};

/// A set of cells: bit 10 y + x, five rows in each half.
struct Board {
  static constexpr std::uint64_t all = (std::uint64_t{1} << 50) - 1;
  static constexpr std::uint64_t row = 0x3ff;
  static constexpr std::uint64_t column = 1 | 1 << 10 | 1 << 20 | 1 << 30 | std::uint64_t{1} << 40;

  std::array<std::uint64_t, 2> half{};

  static constexpr std::uint64_t bit(int x, int y) {
    return std::uint64_t{1} << (y < 5 ? 10 * y + x : 10 * y + x - 50);
  }
  constexpr bool has(int x, int y) const { return (half[y >= 5] & bit(x, y)) != 0; }
  constexpr void add(int x, int y) { half[y >= 5] |= bit(x, y); }
  constexpr void remove(int x, int y) { half[y >= 5] &= ~bit(x, y); }
  constexpr bool any() const { return (half[0] | half[1]) != 0; }
  constexpr int count() const { return std::popcount(half[0]) + std::popcount(half[1]); }
  /// Row y as ten bits.
  constexpr std::uint64_t of_row(int y) const { return half[y >= 5] >> (10 * (y % 5)) & row; }
  /// Whether any cell of column x is in the set.
  constexpr bool any_in_column(int x) const { return ((half[0] | half[1]) & (column << x)) != 0; }
  /// The columns that hold anything, as ten bits.
  constexpr std::uint64_t columns() const {
    const std::uint64_t both = half[0] | half[1];
    return (both | both >> 10 | both >> 20 | both >> 30 | both >> 40) & row;
  }
  /// Everything one row down, or up; what leaves the grid is lost.
  constexpr Board lowered() const {
    return {{half[0] << 10 & all, (half[1] << 10 & all) | half[0] >> 40}};
  }
  constexpr Board raised() const {
    return {{half[0] >> 10 | (half[1] & row) << 40, half[1] >> 10}};
  }
  /// Everything one column to the right, or left; nothing may stand in the column it leaves by.
  constexpr Board moved(bool rightwards) const {
    return rightwards ? Board{{half[0] << 1, half[1] << 1}} : Board{{half[0] >> 1, half[1] >> 1}};
  }
  constexpr Board operator&(const Board& other) const {
    return {{half[0] & other.half[0], half[1] & other.half[1]}};
  }
  constexpr Board without(const Board& other) const {
    return {{half[0] & ~other.half[0], half[1] & ~other.half[1]}};
  }
  bool operator==(const Board&) const = default;
};

/// A board as ten rows of ten letters.
template <class Archive>
void persist_board(Archive& archive, std::string_view name, Board& board) {
  std::array<std::string, 10> rows;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) rows[y] += board.has(x, y) ? '#' : '.';
  }
  archive(name, rows);
  if (archive.saving()) return;
  board = {};
  for (int y = 0; y < 10; ++y) {
    if (rows[y].size() != 10 || rows[y].find_first_not_of(".#") != std::string::npos) {
      return archive.fail(std::string(name) + "[" + std::to_string(y) +
                          "]: ten letters '.' or '#' expected");
    }
    for (int x = 0; x < 10; ++x) {
      if (rows[y][x] == '#') board.add(x, y);
    }
  }
}

/// One channel of an observation, and how it looks. A channel without a letter (0) is not shown.
struct Channel {
  std::string_view name;
  char letter;
  Ink ink;
};

/// The flags of one observation, all 0 at first.
template <std::size_t channels>
struct Flags {
  float* x;

  void set(std::size_t channel, int column, int row) const {
    x[static_cast<std::size_t>(10 * row + column) * channels + channel] = 1.0f;
  }
  void set(std::size_t channel, const Board& board) const {
    for (int i = 0; i < 2; ++i) {
      for (std::uint64_t bits = board.half[i]; bits != 0; bits &= bits - 1) {
        x[static_cast<std::size_t>(50 * i + std::countr_zero(bits)) * channels + channel] = 1.0f;
      }
    }
  }
};

/// Ten lines of ten letters, one line that says what they mean, and the previous action. Trails lie
/// lowest; of the others the first channel lies on top.
std::string text(std::span<const Channel> channels, std::span<const float> flags, Move previous);
Drawing drawing(std::span<const Channel> channels, std::span<const float> flags);

/// A game becomes a world. A Game has
///   Position : Common                                     with persist()
///   channels, minimal, reward_bounds, ramps               constants
///   Position start(auto& dice)
///   double act(Position&, Move, bool ramping, auto& dice)  the reward; sets `over`
///   void show(const Position&, Flags<n>)
template <class Game>
struct Play {
  using Position = typename Game::Position;
  static constexpr std::size_t channels = std::size(Game::channels);

  Settings settings;

  Spaces spaces() const {
    return {.actions = settings.minimal ? static_cast<std::uint32_t>(std::size(Game::minimal)) : 6,
            .states = 0,
            .observation = 100 * channels,
            .shape = {10, 10, channels},
            .whole = true};
  }
  Position start(auto& dice) const { return Game::start(dice); }

  Feedback step(Position& at, Action action, auto& dice) const {
    if (at.over) return {0.0, true, false};
    const Move chosen = settings.minimal ? Game::minimal[action] : static_cast<Move>(action);
    at.previous = chance(dice, settings.sticky) ? at.previous : chosen;
    const double reward = Game::act(at, at.previous, settings.ramping, dice);
    return {reward, at.over, false};
  }
  void observe(const Position& at, std::span<float> x) const {
    std::fill_n(x.data(), 100 * channels, 0.0f);
    Game::show(at, Flags<channels>{x.data()});
  }
  std::vector<std::string> action_names() const {
    std::vector<std::string> names;
    for (std::size_t a = 0; a < spaces().actions; ++a) {
      names.emplace_back(move_names[settings.minimal ? std::size_t{Game::minimal[a]} : a]);
    }
    return names;
  }
  std::string text(const Position& at) const {
    return minatar::text(Game::channels, flags(at), at.previous);
  }
  Drawing drawing(const Position& at) const { return minatar::drawing(Game::channels, flags(at)); }

 private:
  std::vector<float> flags(const Position& at) const {
    std::vector<float> x(100 * channels);
    observe(at, x);
    return x;
  }
};

template <class Game>
Result<World> make(std::string_view name, const Parameters& given) {
  const Result<SettingsOf<Game>> settings = read_parameters<SettingsOf<Game>>(name, given);
  if (!settings) return settings.error();
  WorldFacts facts;
  facts.discount = 0.99;
  facts.episode_steps = 100'000;
  facts.traits.reward_bounds = Game::reward_bounds;
  return to_world(std::string(name), Play<Game>{*settings}, facts);
}

}  // namespace quoll::minatar
