#pragma once
// A model from one row per outcome, as tables of transitions hold it. Rows that come grouped by
// state and action, as they nearly always do, go straight to the arrays; other orders are sorted at
// the end.

#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"

namespace quoll {

/// States and actions are given as numbers of the caller's (from 0, without large gaps). In the
/// arrays a state's index is its place among the states that have rows or are declared, in order of
/// first such mention; after these come those met only as successors, in order of number.
class MdpRows {
 public:
  /// Reserves address space, not memory, for this many rows; more may come.
  explicit MdpRows(std::uint64_t expected_rows);

  /// One outcome but for its successor. At most 2^32 - 1 rows; `line` is where it stands, for
  /// messages.
  void add(std::uint32_t state, std::uint32_t action, double probability, double reward,
           std::uint64_t line);
  /// The successors, row by row; they may lag behind, because looking up names takes its time.
  void add_next(std::uint32_t next) { arrays_.next.push_back(next); }
  /// Gives a state its place without a row.
  void declare(std::uint32_t state);

  std::uint64_t size() const { return rows_; }

  /// The arrays, when each row has its successor, of all but names, start, terminal and discount;
  /// fills `index` with the state's index for each of the caller's `states` numbers. A choice's
  /// actions stand in order of first mention. Peak memory: the arrays, and if sorting was needed
  /// once more the largest of them.
  MdpArrays finish(std::uint32_t states, std::vector<std::uint32_t>& index);

 private:
  void open_state(std::uint32_t state);
  void open_choice(std::uint32_t action, double reward, std::uint64_t line);
  void begin_sorting();
  void begin_outcome_begin();
  void begin_outcome_reward();
  std::vector<std::uint32_t> sorted_segments();
  void sort();

  // Until the end a "choice" of arrays_ is a segment: rows of one state and action that follow each
  // other. choice_begin, outcome_begin lack their last entry.
  MdpArrays arrays_;
  std::uint64_t expected_rows_;
  std::uint64_t rows_ = 0;
  std::vector<std::uint32_t> index_;          // per state number: its index, or nobody
  std::vector<std::uint32_t> last_state_;     // per action: the last state that opened it
  std::vector<std::uint32_t> segment_state_;  // per segment, only when sorting is needed
  std::uint32_t opened_ = 0;                  // states with an index
  std::uint32_t state_ = 0;                   // current state: number, index, and its action
  std::uint32_t state_index_ = 0;
  std::uint32_t action_ = 0;
  bool in_state_ = false;
  bool in_choice_ = false;
  bool sorting_ = false;
};

}  // namespace quoll
