#pragma once
// Enumerable worlds packed for the learning loop: deterministic ones give successor, end and reward
// in one load; stochastic ones a short row of thresholds. Indexed by pair, in the layout of the
// rows (act/rows.hpp), so that padding costs nothing extra to skip.

#include <cstdint>
#include <memory>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

inline constexpr std::uint32_t end_bit = std::uint32_t{1} << 31;

/// Where a step led.
template <class Value>
struct Landing {
  State next;
  Value reward;
  bool terminated;
};

/// One move: 8 bytes for float, 16 for double.
template <class Value>
struct Move {
  std::uint32_t packed = 0;  ///< successor, and end_bit when it is an end
  Value reward = 0;
};

/// A move of probability given by thresholds: taken when the draw is at most `threshold` and above
/// those before it. The last one's threshold is the largest number, so no draw can fall off the
/// row.
template <class Value>
struct ChanceMove {
  std::uint64_t threshold = ~std::uint64_t{0};
  std::uint32_t packed = 0;
  Value reward = 0;
};

template <class Value>
struct DeterministicTable {
  std::vector<Move<Value>> moves;  ///< per pair

  struct View {
    const Move<Value>* moves;
    Landing<Value> step(std::uint64_t pair, std::uint64_t) const {
      const Move<Value> move = moves[pair];
      return {move.packed & ~end_bit, move.reward, (move.packed & end_bit) != 0};
    }
  };
  View view() const { return {moves.data()}; }
};

/// Rows of at most `short_row` moves everywhere are padded to one width, so that the outcome is
/// found without a branch; else each row has its own length.
template <class Value>
struct StochasticTable {
  static constexpr std::uint64_t short_row = 4;
  std::uint64_t width = 0;           ///< of every row; 0 = see begin
  std::vector<std::uint64_t> begin;  ///< per pair, and the end; empty when width > 0
  std::vector<ChanceMove<Value>> moves;

  struct View {
    std::uint64_t width;
    const std::uint64_t* begin;
    const ChanceMove<Value>* moves;
    Landing<Value> step(std::uint64_t pair, std::uint64_t draw) const {
      if (width > 0) {
        const ChanceMove<Value>* const row = moves + pair * width;
        std::uint64_t index = 0;
        for (std::uint64_t i = 0; i + 1 < width; ++i) index += row[i].threshold < draw;
        return {row[index].packed & ~end_bit, row[index].reward,
                (row[index].packed & end_bit) != 0};
      }
      const ChanceMove<Value>* move = moves + begin[pair];
      std::uint64_t count = begin[pair + 1] - begin[pair];
      while (count > 8) {  // halve long rows
        const std::uint64_t half = count / 2;
        if (move[half - 1].threshold < draw) {
          move += half;
          count -= half;
        } else {
          count = half;
        }
      }
      while (move->threshold < draw) ++move;
      return {move->packed & ~end_bit, move->reward, (move->packed & end_bit) != 0};
    }
  };
  View view() const { return {width, begin.data(), moves.data()}; }
};

/// First pair of each state (and the end) when rows are padded to `width`, or without padding when
/// width = 0. The model's own choice_begin serves the latter.
struct PairLayout {
  std::uint32_t width = 0;  ///< 4 or 0
  std::uint64_t pairs = 0;  ///< padding included

  std::uint64_t pair(const Mdp& mdp, State s, Action a) const {
    return width == 0 ? mdp.choice_begin(s) + a : std::uint64_t{s} * width + a;
  }
};

/// Four to a row when no state has more actions and padding at most doubles the table.
PairLayout pair_layout(const Mdp& mdp);

template <class Value>
DeterministicTable<Value> deterministic_table(const Mdp& mdp, PairLayout layout);
template <class Value>
StochasticTable<Value> stochastic_table(const Mdp& mdp, PairLayout layout);

}  // namespace quoll
