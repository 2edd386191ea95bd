#include "quoll/model/grid.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/letters.hpp"

namespace quoll {
namespace {

constexpr State wall = std::numeric_limits<State>::max();
constexpr double pit_reward = -100.0;

struct Direction {
  std::string_view name;
  int right;
  int down;
  int left_side;  // indices of the directions next to it, with 4 and with 8 moves
  int right_side;
  int left_side_of_8;
  int right_side_of_8;
};
constexpr std::array<Direction, 8> directions = {{{"N", 0, -1, 3, 1, 7, 4},
                                                  {"E", 1, 0, 0, 2, 4, 5},
                                                  {"S", 0, 1, 1, 3, 5, 6},
                                                  {"W", -1, 0, 2, 0, 6, 7},
                                                  {"NE", 1, -1, 0, 0, 0, 1},
                                                  {"SE", 1, 1, 0, 0, 1, 2},
                                                  {"SW", -1, 1, 0, 0, 2, 3},
                                                  {"NW", -1, -1, 0, 0, 3, 0}}};

// What each letter means, looked up once per cell.
struct Alphabet {
  std::array<bool, 256> known{}, open{}, end{};
  std::array<double, 256> entering{};  // reward of a move that ends on this letter
};

Alphabet alphabet_of(const Grid& grid) {
  Alphabet a;
  const auto learn = [&](char letter) {
    const auto index = static_cast<unsigned char>(letter);
    a.known[index] = true;
    a.open[index] = letter != '#';
  };
  for (const char letter : std::string_view("#. SGP")) learn(letter);
  for (const char letter : grid.terminal) {
    learn(letter);
    a.end[static_cast<unsigned char>(letter)] = true;
  }
  a.entering.fill(grid.move_reward);
  a.entering['P'] = grid.move_reward + pit_reward;
  for (const auto& [letter, reward] : grid.reward) {
    learn(letter);
    a.entering[static_cast<unsigned char>(letter)] = grid.move_reward + reward;
  }
  a.entering[' '] = a.entering['.'];
  return a;
}

Error fault(std::string expected, std::uint64_t line = 0, std::uint64_t column = 0) {
  return {"grid", line, column, std::move(expected), ""};
}

struct Extent {
  std::uint64_t open = 0;
  std::uint64_t ends = 0;
  bool starts = false;
};

Result<Extent> measure(const Grid& grid, const Alphabet& alphabet) {
  if (grid.moves != 4 && grid.moves != 8) return fault("expected 4 or 8 moves");
  if (!(grid.slip >= 0 && grid.slip <= 1)) return fault("expected a slip from 0 to 1");
  for (const char letter : std::string_view("#S")) {
    if (grid.terminal.find(letter) != std::string::npos) {
      return fault(std::string("expected no '") + letter + "' among the letters of ends");
    }
  }
  if (grid.reward.count('#') != 0) return fault("expected no reward for walls: nobody enters them");
  if (grid.rows.empty() || grid.rows.front().empty()) return fault("expected a picture");
  const std::uint64_t columns = grid.rows.front().size();
  if (columns > std::numeric_limits<std::uint32_t>::max() / grid.rows.size()) {
    return fault("expected fewer than 2^32 cells");
  }
  Extent extent;
  for (std::size_t r = 0; r < grid.rows.size(); ++r) {
    const std::string& row = grid.rows[r];
    if (row.size() != columns) {
      return fault("expected " + std::to_string(columns) + " letters as in the first row, found " +
                       std::to_string(row.size()),
                   r + 1, std::min<std::uint64_t>(row.size(), columns) + 1);
    }
    for (std::size_t c = 0; c < columns; ++c) {
      const auto letter = static_cast<unsigned char>(row[c]);
      if (!alphabet.known[letter]) {
        const bool plain = letter > 0x20 && letter < 0x7f;
        const std::size_t bytes =
            letter < 0x80 ? 0 : letter_length(std::string_view(row).substr(c));
        const std::string shown = plain || bytes > 0
                                      ? row.substr(c, std::max<std::size_t>(bytes, 1))
                                      : "byte " + std::to_string(letter);
        return fault("letter '" + shown + "' is not known; use # . S G P" +
                         (plain ? " or add 'reward." + shown + " = ...'" : std::string()),
                     r + 1, c + 1);
      }
      extent.open += alphabet.open[letter];
      extent.ends += alphabet.end[letter];
      extent.starts = extent.starts || letter == 'S';
    }
  }
  if (extent.open == extent.ends) return fault("expected at least one cell that is no wall or end");
  if (extent.open > max_states) return fault("expected at most 2^31 - 1 cells that are no walls");
  return extent;
}

// States of one row's cells, `wall` where there is none.
class RowStates {
 public:
  explicit RowStates(std::size_t columns) : states_(columns, wall) {}
  // Numbers the open cells of `row` from `first` and returns the number after the last.
  State number(const std::string& row, const Alphabet& alphabet, State first) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      states_[c] = alphabet.open[static_cast<unsigned char>(row[c])] ? first++ : wall;
    }
    return first;
  }
  void clear() { std::fill(states_.begin(), states_.end(), wall); }
  State operator[](std::size_t column) const { return states_[column]; }

 private:
  std::vector<State> states_;
};

class GridBuilder {
 public:
  GridBuilder(const Grid& grid, const Alphabet& alphabet, const Extent& extent)
      : grid_(grid), alphabet_(alphabet), columns_(grid.rows.front().size()) {
    const std::uint64_t choices = (extent.open - extent.ends) * grid.moves;
    a_.choice_begin.reserve(extent.open + 1);
    a_.reward.reserve(choices);
    a_.action.reserve(choices);
    cells_.reserve(extent.open);
    const std::uint64_t outcomes = grid.slip > 0 ? 3 * choices : choices;
    a_.next.reserve(outcomes);
    if (grid.slip > 0) {
      a_.outcome_begin.reserve(choices + 1);
      a_.probability.reserve(outcomes);
    }
  }

  // Three rows of numbers pass over the picture, so that memory goes to the model alone.
  MdpArrays build() {
    RowStates above(columns_), here(columns_), below(columns_);
    State numbered = here.number(grid_.rows[0], alphabet_, 0);
    for (std::size_t r = 0; r < grid_.rows.size(); ++r) {
      if (r + 1 < grid_.rows.size()) {
        numbered = below.number(grid_.rows[r + 1], alphabet_, numbered);
      } else {
        below.clear();
      }
      around_ = {&above, &here, &below};
      for (std::size_t c = 0; c < columns_; ++c) {
        if (here[c] != wall) add_cell(r, c);
      }
      std::swap(above, here);
      std::swap(here, below);
    }
    finish();
    return std::move(a_);
  }

 private:
  struct Arrival {
    State state;
    double reward;
  };

  char letter(std::size_t row, std::size_t column) const { return grid_.rows[row][column]; }

  State state_at(std::size_t column, int right, int down) const {
    const std::size_t to = column + static_cast<std::size_t>(right);  // -1 wraps: off the grid
    return to < columns_ ? (*around_[static_cast<std::size_t>(down + 1)])[to] : wall;
  }

  Arrival arrival(std::size_t r, std::size_t c, const Direction& d) const {
    const State to = state_at(c, d.right, d.down);
    const bool cut = d.right != 0 && d.down != 0 &&
                     (state_at(c, d.right, 0) == wall || state_at(c, 0, d.down) == wall);
    if (to == wall || cut) return {(*around_[1])[c], grid_.move_reward};
    const char entered =
        letter(r + static_cast<std::size_t>(d.down), c + static_cast<std::size_t>(d.right));
    return {to, alphabet_.entering[static_cast<unsigned char>(entered)]};
  }

  void add_cell(std::size_t r, std::size_t c) {
    a_.choice_begin.push_back(a_.action.size());
    cells_.push_back(static_cast<std::uint32_t>(r * columns_ + c));
    if (letter(r, c) == 'S') a_.start.push_back((*around_[1])[c]);
    if (alphabet_.end[static_cast<unsigned char>(letter(r, c))]) return;
    for (std::uint32_t move = 0; move < grid_.moves; ++move) {
      a_.action.push_back(move);
      const Direction& d = directions[move];
      const Arrival straight = arrival(r, c, d);
      if (grid_.slip > 0) {
        const bool four = grid_.moves == 4;
        add_slipping(straight, arrival(r, c, directions[four ? d.left_side : d.left_side_of_8]),
                     arrival(r, c, directions[four ? d.right_side : d.right_side_of_8]));
      } else {
        a_.next.push_back(straight.state);
        a_.reward.push_back(straight.reward);
      }
    }
  }

  // Outcomes that end on the same cell are one. Rewards are kept by outcome only from the first
  // choice on whose outcomes differ in it.
  void add_slipping(const Arrival& straight, const Arrival& left, const Arrival& right) {
    const std::size_t begin = a_.next.size();
    a_.outcome_begin.push_back(begin);
    const std::array<std::pair<const Arrival*, double>, 3> parts = {
        {{&straight, 1 - grid_.slip}, {&left, grid_.slip / 2}, {&right, grid_.slip / 2}}};
    for (const auto& [part, probability] : parts) {
      if (probability == 0) continue;
      const auto first = a_.next.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto same = std::find(first, a_.next.end(), part->state);
      if (same != a_.next.end()) {
        const auto o = static_cast<std::size_t>(same - a_.next.begin());
        a_.probability.set(o, a_.probability[o] + probability);
        continue;
      }
      if (a_.next.size() == begin) a_.reward.push_back(part->reward);
      if (a_.outcome_reward.empty() && part->reward != a_.reward.back()) begin_outcome_reward();
      a_.next.push_back(part->state);
      a_.probability.push_back(probability);
      if (!a_.outcome_reward.empty()) a_.outcome_reward.push_back(part->reward);
    }
  }

  // Until now the outcomes of each choice had one reward.
  void begin_outcome_reward() {
    for (std::size_t choice = 0; choice < a_.reward.size(); ++choice) {
      const bool last = choice + 1 == a_.reward.size();
      const std::uint64_t end = last ? a_.next.size() : a_.outcome_begin[choice + 1];
      a_.outcome_reward.resize(end, a_.reward[choice]);
    }
  }

  void finish() {
    a_.choice_begin.push_back(a_.action.size());
    if (grid_.slip > 0) a_.outcome_begin.push_back(a_.next.size());
    if (!a_.outcome_reward.empty()) a_.reward = {};  // make() expects them
    Layout layout;
    layout.rows = static_cast<std::uint32_t>(grid_.rows.size());
    layout.columns = static_cast<std::uint32_t>(columns_);
    layout.cell = cells_;
    for (std::uint32_t move = 0; move < grid_.moves; ++move) {
      a_.action_names.push_back(directions[move].name);
      layout.direction.emplace_back(directions[move].right, directions[move].down);
    }
    a_.layout = std::move(layout);
    a_.state_names = Names::cells(static_cast<std::uint32_t>(columns_), std::move(cells_));
    a_.discount = grid_.discount;
  }

  const Grid& grid_;
  const Alphabet& alphabet_;
  std::size_t columns_;
  std::array<const RowStates*, 3> around_{};  // rows above, here, below
  std::vector<std::uint32_t> cells_;
  MdpArrays a_;
};

}  // namespace

Result<MdpArrays> to_arrays(const Grid& grid) {
  const Alphabet alphabet = alphabet_of(grid);
  const auto extent = measure(grid, alphabet);
  if (!extent) return extent.error();
  return GridBuilder(grid, alphabet, *extent).build();
}

Result<Mdp> to_mdp(const Grid& grid) {
  auto arrays = to_arrays(grid);
  if (!arrays) return arrays.error();
  return Mdp::make(*std::move(arrays));
}

}  // namespace quoll
