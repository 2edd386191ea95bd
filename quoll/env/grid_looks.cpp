#include "quoll/env/grid_looks.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "quoll/env/grid_window.hpp"

namespace quoll {
namespace {

// The part of the grid that is shown, and which state stands in each of its cells.
struct Window : GridWindow {
  std::vector<State> state;  // rows x columns; no_state = a wall

  static constexpr State no_state = ~State{0};
  State in(std::uint32_t row, std::uint32_t column) const {
    return state[std::size_t{row} * columns + column];
  }
};

Window window(const Mdp& mdp, State at, const GridWindow& shown) {
  const Layout& layout = *mdp.layout();
  Window view{shown, {}};
  view.state.assign(std::size_t{view.rows} * view.columns, Window::no_state);
  for (State s = 0; s < mdp.states(); ++s) {
    const std::uint32_t row = layout.cell[s] / layout.columns - view.top;
    const std::uint32_t column = layout.cell[s] % layout.columns - view.left;
    if (row < view.rows && column < view.columns) {
      view.state[std::size_t{row} * view.columns + column] = s;
    }
  }
  view.state[std::size_t{layout.cell[at] / layout.columns - view.top} * view.columns +
             (layout.cell[at] % layout.columns - view.left)] = at;
  return view;
}

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

std::string grid_state_text(const Mdp& mdp, State at) {
  const Layout& layout = *mdp.layout();
  const Window view =
      window(mdp, at, grid_window(layout.rows, layout.columns, layout.cell[at], 100, 160));
  const std::string letter = letters(mdp);
  std::string text;
  for (std::uint32_t row = 0; row < view.rows; ++row) {
    for (std::uint32_t column = 0; column < view.columns; ++column) {
      const State s = view.in(row, column);
      text += s == at ? '@' : s == Window::no_state ? '#' : letter[s];
    }
    text += '\n';
  }
  return text;
}

Drawing grid_state_drawing(const Mdp& mdp, State at) {
  const Layout& layout = *mdp.layout();
  const Window view =
      window(mdp, at, grid_window(layout.rows, layout.columns, layout.cell[at], 60, 60));
  const std::string letter = letters(mdp);
  Drawing drawing{static_cast<double>(view.columns), static_cast<double>(view.rows), {}};
  for (std::uint32_t row = 0; row < view.rows; ++row) {
    for (std::uint32_t column = 0; column < view.columns; ++column) {
      const State s = view.in(row, column);
      const char what = s == Window::no_state ? '#' : letter[s];
      const Ink ink = what == '#'   ? Ink::wall
                      : what == 'G' ? Ink::goal
                      : what == 'X' ? Ink::danger
                                    : Ink::floor;
      constexpr double gap = 0.02;
      drawing.box(ink, column + gap, row + gap, 1 - 2 * gap, 1 - 2 * gap);
      if (s == at) drawing.circle(Ink::agent, column + 0.5, row + 0.5, 0.32);
    }
  }
  return drawing;
}

}  // namespace quoll
