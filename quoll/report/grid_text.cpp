#include "quoll/report/grid_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/report/grid_cells.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

namespace {

constexpr std::uint32_t policy_rows = 60;  // more lines than this scroll out of sight

std::string_view arrow(std::pair<int, int> step, bool unicode) {
  static constexpr std::array<std::string_view, 9> pretty{"↖", "↑", "↗", "←", "•",
                                                          "→", "↙", "↓", "↘"};
  static constexpr std::array<std::string_view, 9> plain{"\\", "^", "/", "<", "o",
                                                         ">",  "/", "v", "\\"};
  const auto sign = [](int x) { return (x > 0) - (x < 0); };
  const auto index = static_cast<std::size_t>((sign(step.second) + 1) * 3 + sign(step.first) + 1);
  return unicode ? pretty[index] : plain[index];
}

/// Nearest colour of the 6 x 6 x 6 cube to "#rrggbb". Levels 0, 95, 135, 175, 215, 255.
int cube_color(const std::string& rgb) {
  int index = 16;
  for (const auto& [at, factor] : {std::pair{1, 36}, {3, 6}, {5, 1}}) {
    const int level = std::stoi(rgb.substr(static_cast<std::size_t>(at), 2), nullptr, 16);
    index += factor * (level < 48 ? 0 : level < 115 ? 1 : (level - 35) / 40);
  }
  return index;
}

std::string colored(std::string_view letters, double share) {
  return fmt::format("\x1b[38;5;{};48;5;{}m{}\x1b[0m", scale_is_light(share) ? 16 : 231,
                     cube_color(scale_color(share)), letters);
}

std::string_view mark_letter(CellMark mark) {
  switch (mark) {
    case CellMark::start:
      return "S";
    case CellMark::goal:
      return "G";
    case CellMark::pit:
      return "P";
    case CellMark::none:
      break;
  }
  return "";
}

/// The rectangle of cells shown, and letters per cell.
struct Window {
  std::uint32_t row = 0, column = 0, rows = 0, columns = 0;
  bool spaced = false;
};

Window crop(const GridView& view, const GridCells& cells, std::uint32_t width) {
  Window w{0, 0, cells.rows, cells.columns, false};
  w.spaced = width == 0 || 2 * std::uint64_t{cells.columns} <= width + 1;
  if (width == 0) return w;
  const std::uint32_t cell = view.mdp->layout()->cell[view.mdp->start().front()];
  const auto around = [](std::uint32_t centre, std::uint32_t room, std::uint32_t all) {
    return std::min(centre - std::min(centre, room / 2), all - room);
  };
  w.columns = std::min(cells.columns, width);
  w.rows = std::min(cells.rows, std::max(policy_rows, w.columns / 2));
  w.column = around(cell % cells.columns, w.columns, cells.columns);
  w.row = around(cell / cells.columns, w.rows, cells.rows);
  return w;
}

std::string policy_cell(const GridView& view, const GridCells& cells, State s,
                        const TerminalStyle& style, bool spaced) {
  const std::string_view pad = spaced ? " " : "";
  if (s == no_state) return fmt::format("{}{}", style.unicode ? "█" : "#", pad);
  std::string_view letter = mark_letter(cells.mark[s]);
  if (letter.empty()) {
    const bool chosen = !view.policy.empty() && view.policy[s] != no_action;
    std::uint64_t choice = chosen ? view.mdp->choice_begin(s) + view.policy[s] : 0;
    const std::vector<std::uint64_t> shown = shown_choices(view, s);
    if (!chosen && !shown.empty()) choice = shown.front();
    letter = chosen || !shown.empty() ? arrow(direction(*view.mdp, choice), style.unicode) : ".";
  }
  const std::string letters = fmt::format("{}{}", letter, pad);
  if (!style.color || view.value.empty() || view.mdp->terminal(s)) return letters;
  return std::isfinite(view.value[s]) ? colored(letters, cells.share(view.value[s])) : letters;
}

/// "S start, its move ->" for a single start, whose arrow the letter hides.
std::string start_words(const GridView& view, const GridCells& cells, bool unicode) {
  if (view.mdp->start().size() != 1) return "S start";
  const State s = view.mdp->start().front();
  if (cells.mark[s] != CellMark::start || view.policy.empty() || view.policy[s] == no_action) {
    return "S start";
  }
  const std::uint64_t choice = view.mdp->choice_begin(s) + view.policy[s];
  return fmt::format("S start (its move {})", arrow(direction(*view.mdp, choice), unicode));
}

std::string mark_legend(const GridView& view, const GridCells& cells, bool unicode) {
  std::string legend = unicode ? "█ wall" : "# wall";
  const auto present = [&](CellMark mark) {
    return std::find(cells.mark.begin(), cells.mark.end(), mark) != cells.mark.end();
  };
  if (present(CellMark::start)) legend += "  " + start_words(view, cells, unicode);
  if (present(CellMark::goal)) legend += "  G goal";
  if (present(CellMark::pit)) legend += "  P pit";
  return legend + "\n";
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + "\n";
}

std::string heading(const GridView& view) {
  return view.title.empty() ? "" : view.title + "\n";
}

/// The letter of a value without colour: digits, or shades of five steps.
std::string_view shade(double share, bool unicode) {
  static constexpr std::array<std::string_view, 5> blocks{"·", "░", "▒", "▓", "█"};
  static constexpr std::string_view digits = "0123456789";
  if (unicode) return blocks[std::min<std::size_t>(4, static_cast<std::size_t>(share * 5))];
  return digits.substr(std::min<std::size_t>(9, static_cast<std::size_t>(share * 10)), 1);
}

std::string heat_block(const GridCells& cells, const BlockMean& block, const TerminalStyle& style,
                       std::size_t repeat) {
  std::string letter;
  double share = -1;
  if (block.mark != CellMark::none) {
    letter = mark_letter(block.mark);
    letter.resize(repeat, ' ');
  } else if (block.valued == 0) {
    const std::string_view filler = block.walls > 0 ? (style.unicode ? "╬" : "#") : "?";
    for (std::size_t i = 0; i < repeat; ++i) letter += filler;
  } else {
    share = cells.share(block.mean);
    const std::string_view step = style.color ? " " : shade(share, style.unicode);
    for (std::size_t i = 0; i < repeat; ++i) letter += step;
  }
  return style.color && share >= 0 ? colored(letter, share) : letter;
}

std::string heat_legend(const GridCells& cells, const TerminalStyle& style) {
  if (cells.low > cells.high) return "no values yet\n";
  std::string scale;
  for (int i = 0; i < 10; ++i) {
    const double share = (i + 0.5) / 10;
    scale += style.color ? colored(" ", share) : std::string(shade(share, style.unicode));
  }
  return fmt::format("{} {} {}  {} wall\n", number_text(cells.low), scale, number_text(cells.high),
                     style.unicode ? "╬" : "#");
}

}  // namespace

Result<std::string> grid_policy_text(const GridView& view, const TerminalStyle& style) {
  const Result<GridCells> read = grid_cells(view);
  if (!read) return read.error();
  const GridCells& cells = *read;
  const Window w = crop(view, cells, style.width);
  std::string out = heading(view);
  for (std::uint32_t r = w.row; r < w.row + w.rows; ++r) {
    std::string line;
    for (std::uint32_t c = w.column; c < w.column + w.columns; ++c) {
      line += policy_cell(view, cells, cells.at(r, c), style, w.spaced);
    }
    append_line(out, std::move(line));
  }
  out += mark_legend(view, cells, style.unicode);
  if (w.rows < cells.rows || w.columns < cells.columns) {
    out += fmt::format("rows {}-{} and columns {}-{} of {} x {}; -o FILE.svg shows the whole\n",
                       w.row, w.row + w.rows - 1, w.column, w.column + w.columns - 1, cells.rows,
                       cells.columns);
  }
  return out;
}

Result<std::string> grid_heat_text(const GridView& view, const TerminalStyle& style) {
  const Result<GridCells> read = grid_cells(view);
  if (!read) return read.error();
  const GridCells& cells = *read;
  const std::uint32_t width = style.width == 0 ? cells.columns : std::max(style.width, 1U);
  const std::uint32_t side = (cells.columns + width - 1) / width;
  const std::size_t repeat = style.width == 0 || 2 * std::uint64_t{cells.columns} <= width ? 2 : 1;
  std::string out = heading(view);
  for (std::uint32_t r = 0; r < cells.rows; r += side) {
    std::string line;
    for (std::uint32_t c = 0; c < cells.columns; c += side) {
      line += heat_block(cells, block_mean(view, cells, r, c, side), style, repeat);
    }
    append_line(out, std::move(line));
  }
  out += heat_legend(cells, style);
  if (side > 1) {
    out += fmt::format("each letter is the mean of {0} x {0} cells of {1} x {2}\n", side,
                       cells.rows, cells.columns);
  }
  return out;
}

}  // namespace quoll
