#include "quoll/report/grid_cells.hpp"

#include <algorithm>
#include <cmath>

namespace quoll {

namespace {

/// The best reward of entering each end; -infinity for other states and ends nothing enters.
std::vector<double> entry_rewards(const Mdp& mdp) {
  std::vector<double> best(mdp.states(), -HUGE_VAL);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        const State next = mdp.next(o);
        if (mdp.terminal(next)) best[next] = std::max(best[next], mdp.reward(c, o));
      }
    }
  }
  return best;
}

std::vector<CellMark> marks(const Mdp& mdp) {
  const std::vector<double> entry = entry_rewards(mdp);
  const double best = *std::max_element(entry.begin(), entry.end());
  std::vector<CellMark> mark(mdp.states(), CellMark::none);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) mark[s] = entry[s] < best ? CellMark::pit : CellMark::goal;
  }
  // Starts everywhere say nothing about a place.
  if (mdp.start().size() <= 4) {
    for (const State s : mdp.start()) {
      if (mark[s] == CellMark::none) mark[s] = CellMark::start;
    }
  }
  return mark;
}

}  // namespace

double GridCells::share(double value) const {
  return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 1.0;
}

Result<GridCells> grid_cells(const GridView& view) {
  const Mdp& mdp = *view.mdp;
  const Layout* layout = mdp.layout();
  const std::uint64_t count = layout ? std::uint64_t{layout->rows} * layout->columns : 0;
  if (count == 0 || layout->cell.size() != mdp.states()) {
    return Error{.file = "",
                 .expected =
                     "expected a world whose states are cells of a grid; for this one use "
                     "`show WORLD graph` or `solve WORLD --json`",
                 .nearest = ""};
  }
  GridCells cells{layout->rows, layout->columns, {}, marks(mdp), HUGE_VAL, -HUGE_VAL};
  cells.state.assign(count, no_state);
  for (State s = 0; s < mdp.states(); ++s) {
    State& place = cells.state[std::min<std::uint64_t>(layout->cell[s], count - 1)];
    if (place == no_state) place = s;
    if (view.value.empty() || mdp.terminal(s) || !std::isfinite(view.value[s])) continue;
    cells.low = std::min(cells.low, view.value[s]);
    cells.high = std::max(cells.high, view.value[s]);
  }
  return cells;
}

std::vector<std::uint64_t> shown_choices(const GridView& view, State s) {
  std::vector<std::uint64_t> shown;
  const Mdp& mdp = *view.mdp;
  if (mdp.terminal(s)) return shown;
  if (!view.optimal.empty()) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (view.optimal[c]) shown.push_back(c);
    }
  } else if (!view.policy.empty() && view.policy[s] != no_action) {
    shown.push_back(mdp.choice_begin(s) + view.policy[s]);
  }
  return shown;
}

std::pair<int, int> direction(const Mdp& mdp, std::uint64_t choice) {
  const auto& directions = mdp.layout()->direction;
  const std::uint32_t action = mdp.arrays().action[choice];
  return action < directions.size() ? directions[action] : std::pair{0, 0};
}

BlockMean block_mean(const GridView& view, const GridCells& cells, std::uint32_t row,
                     std::uint32_t column, std::uint32_t side) {
  BlockMean block;
  double sum = 0;
  for (std::uint32_t r = row; r < std::min(cells.rows, row + side); ++r) {
    for (std::uint32_t c = column; c < std::min(cells.columns, column + side); ++c) {
      ++block.cells;
      const State s = cells.at(r, c);
      if (s == no_state) {
        ++block.walls;
        continue;
      }
      block.mark = std::max(block.mark, cells.mark[s]);
      if (view.value.empty() || view.mdp->terminal(s) || !std::isfinite(view.value[s])) continue;
      sum += view.value[s];
      ++block.valued;
    }
  }
  if (block.valued > 0) block.mean = sum / static_cast<double>(block.valued);
  return block;
}

}  // namespace quoll
