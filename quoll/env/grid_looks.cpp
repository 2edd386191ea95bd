#include "quoll/env/grid_looks.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "quoll/env/grid_window.hpp"

namespace quoll {
namespace {

// Per state what stands in its cell; ends are told apart by the largest reward of a move into them.
std::string letters(const Mdp& mdp) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> entry(mdp.states(), none);
  double best = none;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        if (!mdp.terminal(mdp.next(o))) continue;
        double& known = entry[mdp.next(o)];
        known = std::max(known, mdp.reward(c, o));
        best = std::max(best, known);
      }
    }
  }
  std::string all(mdp.states(), '.');
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) all[s] = entry[s] < best ? 'X' : 'G';
  }
  if (mdp.start().size() == 1 && all[mdp.start()[0]] == '.') all[mdp.start()[0]] = 'S';
  return all;
}

}  // namespace

GridLooks::GridLooks(const Mdp& mdp) : layout_(*mdp.layout()) {
  letters_.assign(std::size_t{layout_.rows} * layout_.columns, '#');
  const std::string of_state = letters(mdp);
  for (State s = 0; s < mdp.states(); ++s) letters_[layout_.cell[s]] = of_state[s];
}

std::string GridLooks::text(State at) const {
  const std::uint32_t agent = layout_.cell[at];
  const GridWindow view = grid_window(layout_.rows, layout_.columns, agent, 100, 160);
  std::string text;
  for (std::uint32_t row = 0; row < view.rows; ++row) {
    const std::size_t first = std::size_t{view.top + row} * layout_.columns + view.left;
    for (std::size_t cell = first; cell < first + view.columns; ++cell) {
      text += cell == agent ? '@' : letters_[cell];
    }
    text += '\n';
  }
  return text;
}

Drawing GridLooks::drawing(State at) const {
  const std::uint32_t agent = layout_.cell[at];
  const GridWindow view = grid_window(layout_.rows, layout_.columns, agent, 60, 60);
  Drawing drawing{static_cast<double>(view.columns), static_cast<double>(view.rows), {}};
  for (std::uint32_t row = 0; row < view.rows; ++row) {
    for (std::uint32_t column = 0; column < view.columns; ++column) {
      const std::size_t cell = std::size_t{view.top + row} * layout_.columns + view.left + column;
      const char what = letters_[cell];
      const Ink ink = what == '#'   ? Ink::wall
                      : what == 'G' ? Ink::goal
                      : what == 'X' ? Ink::danger
                                    : Ink::floor;
      constexpr double gap = 0.02;
      drawing.box(ink, column + gap, row + gap, 1 - 2 * gap, 1 - 2 * gap);
      if (cell == agent) drawing.circle(Ink::agent, column + 0.5, row + 0.5, 0.32);
    }
  }
  return drawing;
}

}  // namespace quoll
