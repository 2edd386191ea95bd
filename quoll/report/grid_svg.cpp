#include "quoll/report/grid_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "quoll/report/grid_cells.hpp"
#include "quoll/report/legend.hpp"

namespace quoll {

namespace {

constexpr double margin = 28;
constexpr double grid_top = 64;
constexpr double picture_side = 720;  // of the longer side of the grid, in pixels
constexpr double largest_cell = 84;
constexpr double roomy_cell = 44;     // from here on values are printed
constexpr double lettered_cell = 14;  // from here on S, G and P are printed
constexpr int levels = 64;            // shades of the scale; cells of one shade share a path

struct Frame {
  const GridView& view;
  const GridCells& cells;
  std::uint32_t block;  ///< cells per drawn square
  std::uint32_t rows, columns;
  double size;  ///< pixels per drawn square
  double left = margin;

  Box box(std::uint32_t row, std::uint32_t column) const {
    return {left + column * size, grid_top + row * size, size, size};
  }
  double width() const { return columns * size; }
  double height() const { return rows * size; }
};

Frame frame_of(const GridView& view, const GridCells& cells) {
  const std::uint32_t longest = std::max(cells.rows, cells.columns);
  const std::uint32_t block = (longest + grid_svg_side - 1) / grid_svg_side;
  const auto blocks = [block](std::uint32_t side) { return (side + block - 1) / block; };
  const double size = std::min(largest_cell, std::floor(picture_side / blocks(longest)));
  return {view, cells, block, blocks(cells.rows), blocks(cells.columns), size};
}

void append_square(std::string& path, const Box& box, double inset) {
  path += fmt::format("M{} {}h{}v{}h-{}z", svg_number(box.x + inset), svg_number(box.y + inset),
                      svg_number(box.width - 2 * inset), svg_number(box.height - 2 * inset),
                      svg_number(box.width - 2 * inset));
}

/// Squares by shade, walls, ends and starts.
void draw_squares(SvgWriter& svg, const Frame& f) {
  std::array<std::string, levels> shades;
  std::string walls, unknown, goals, pits, starts;
  const double inset = f.size >= 20 ? 1 : 0;
  for (std::uint32_t r = 0; r < f.rows; ++r) {
    for (std::uint32_t c = 0; c < f.columns; ++c) {
      const BlockMean block = block_mean(f.view, f.cells, r * f.block, c * f.block, f.block);
      const Box box = f.box(r, c);
      if (block.mark == CellMark::goal || block.mark == CellMark::pit) {
        append_square(block.mark == CellMark::goal ? goals : pits, box, inset);
        continue;
      }
      if (block.mark == CellMark::start) append_square(starts, box, std::max(1.0, f.size / 24));
      if (block.valued == 0) {
        append_square(block.walls > 0 ? walls : unknown, box, block.walls > 0 ? 0 : inset);
        continue;
      }
      const double share = f.cells.share(block.mean);
      append_square(shades[std::min(levels - 1, static_cast<int>(share * levels))], box, inset);
    }
  }
  const auto fill = [&svg](const std::string& path, std::string_view color) {
    if (path.empty()) return;
    svg.path(path, fmt::format(R"(fill="{}" shape-rendering="crispEdges")", color));
  };
  fill(unknown, "#eef1f4");
  for (int i = 0; i < levels; ++i) {
    fill(shades[static_cast<std::size_t>(i)], scale_color((i + 0.5) / levels));
  }
  fill(walls, palette::wall);
  fill(goals, palette::green);
  fill(pits, palette::orange);
  if (!starts.empty()) {
    const std::string fill_color = f.size < roomy_cell ? std::string(palette::amber) : "none";
    svg.path(starts, fmt::format(R"(fill="{}" stroke="{}" stroke-width="{}")", fill_color,
                                 palette::amber, svg_number(std::max(1.5, f.size / 16))));
  }
}

struct Point {
  double x, y;
};

/// A filled arrow from `from` to `to` as a closed path: shaft of width `thick`, head three times
/// that.
void append_arrow(std::string& path, Point from, Point to, double thick) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  const double ux = dx / length, uy = dy / length;
  const double head = std::min(length, 2.6 * thick), half = thick / 2, wide = 1.5 * thick;
  const Point neck{to.x - ux * head, to.y - uy * head};
  const auto corner = [&](Point at, double side) {
    return fmt::format("{} {}", svg_number(at.x - uy * side), svg_number(at.y + ux * side));
  };
  path += fmt::format("M{}L{}L{}L{} {}L{}L{}L{}z", corner(from, half), corner(neck, half),
                      corner(neck, wide), svg_number(to.x), svg_number(to.y), corner(neck, -wide),
                      corner(neck, -half), corner(from, -half));
}

/// Arrows of one state: at the edges around the value in roomy cells, else from the middle.
void append_arrows(std::string& path, const Frame& f, const Box& box, State s) {
  const Point centre{box.x + box.width / 2, box.y + box.height / 2};
  const std::vector<std::uint64_t> shown = shown_choices(f.view, s);
  std::vector<std::pair<int, int>> steps;
  for (const std::uint64_t choice : shown) {
    const std::pair<int, int> step = direction(*f.view.mdp, choice);
    const bool known = std::find(steps.begin(), steps.end(), step) != steps.end();
    if (step != std::pair{0, 0} && !known) steps.push_back(step);
  }
  const bool roomy = f.size >= roomy_cell;
  for (const auto& [right, down] : steps) {
    const double length = std::sqrt(static_cast<double>(right * right + down * down));
    const double ux = right / length, uy = down / length;
    const auto at = [&](double share) {
      return Point{centre.x + ux * share * f.size, centre.y + uy * share * f.size};
    };
    if (roomy) {
      append_arrow(path, at(0.33), at(0.46), f.size / 20);
    } else {
      append_arrow(path, at(steps.size() == 1 ? -0.34 : 0.0), at(0.40), f.size / 8);
    }
  }
}

void draw_arrows(SvgWriter& svg, const Frame& f) {
  std::string dark, light;
  for (std::uint32_t r = 0; r < f.rows; ++r) {
    for (std::uint32_t c = 0; c < f.columns; ++c) {
      const State s = f.cells.at(r, c);
      if (s == no_state) continue;
      const bool valued = !f.view.value.empty() && std::isfinite(f.view.value[s]);
      const bool on_light = !valued || scale_is_light(f.cells.share(f.view.value[s]));
      append_arrows(on_light ? dark : light, f, f.box(r, c), s);
    }
  }
  if (!dark.empty()) svg.path(dark, fmt::format(R"(fill="{}")", palette::ink));
  if (!light.empty()) svg.path(light, R"(fill="#ffffff")");
}

std::string cell_number(double value) {
  const double size = std::abs(value);
  return size >= 100 && size < 1e5 ? fmt::format("{:.0f}", value)
                                   : number_text(std::stod(fmt::format("{:.3g}", value)));
}

/// The largest font in which every value fits its cell, or 0.
double value_font(const Frame& f) {
  double widest = 0;
  for (State s = 0; s < f.view.mdp->states(); ++s) {
    if (f.view.mdp->terminal(s) || !std::isfinite(f.view.value[s])) continue;
    widest = std::max(widest, text_width(cell_number(f.view.value[s]), 1));
  }
  // Arrows need a third of the cell at the sides.
  const double font = std::min(f.size * 0.24, widest > 0 ? f.size * 0.56 / widest : 0);
  return font >= 9 ? font : 0;
}

void draw_letters(SvgWriter& svg, const Frame& f) {
  const bool roomy = f.size >= roomy_cell;
  const double font = roomy && !f.view.value.empty() ? value_font(f) : 0;
  for (std::uint32_t r = 0; r < f.rows; ++r) {
    for (std::uint32_t c = 0; c < f.columns; ++c) {
      const State s = f.cells.at(r, c);
      if (s == no_state) continue;
      const Box box = f.box(r, c);
      const double x = box.x + box.width / 2, y = box.y + box.height / 2;
      const CellMark mark = f.cells.mark[s];
      if (mark == CellMark::goal || mark == CellMark::pit) {
        const double size = f.size * (roomy ? 0.42 : 0.7);
        svg.text(x, y + size * 0.36, mark == CellMark::goal ? "G" : "P",
                 {.size = size, .color = "#ffffff", .bold = true});
        continue;
      }
      const bool valued = !f.view.value.empty() && std::isfinite(f.view.value[s]);
      const bool on_light = !valued || scale_is_light(f.cells.share(f.view.value[s]));
      const std::string_view color = on_light ? palette::ink : std::string_view("#ffffff");
      if (valued && font > 0) {
        svg.text(x, y + font * 0.36, cell_number(f.view.value[s]), {.size = font, .color = color});
      }
      if (mark == CellMark::start && roomy) {
        svg.text(box.x + f.size * 0.11, box.y + f.size * 0.27, "S",
                 {.size = f.size * 0.19, .color = color, .bold = true, .anchor = "start"});
      }
    }
  }
}

bool present(const GridCells& cells, CellMark mark) {
  return std::find(cells.mark.begin(), cells.mark.end(), mark) != cells.mark.end();
}

std::vector<LegendItem> legend_items(const Frame& f) {
  std::vector<LegendItem> items;
  const bool walls =
      std::find(f.cells.state.begin(), f.cells.state.end(), no_state) != f.cells.state.end();
  if (walls) items.push_back({LegendItem::Kind::square, palette::wall, "wall"});
  if (present(f.cells, CellMark::start)) {
    const auto sign = f.size < roomy_cell ? LegendItem::Kind::square : LegendItem::Kind::ring;
    items.push_back({sign, palette::amber, "start"});
  }
  if (present(f.cells, CellMark::goal)) {
    items.push_back({LegendItem::Kind::square, palette::green, "goal"});
  }
  if (present(f.cells, CellMark::pit)) {
    items.push_back({LegendItem::Kind::square, palette::orange, "pit"});
  }
  if (f.block > 1) {
    items.push_back({LegendItem::Kind::none, palette::grey,
                     fmt::format("each square: mean of {0} x {0} cells", f.block)});
  } else if (!f.view.optimal.empty()) {
    items.push_back({LegendItem::Kind::arrow, palette::ink, "optimal moves"});
  } else if (!f.view.policy.empty()) {
    items.push_back({LegendItem::Kind::arrow, palette::ink, "policy"});
  }
  return items;
}

}  // namespace

Result<Picture> grid_svg(const GridView& view) {
  const Result<GridCells> read = grid_cells(view);
  if (!read) return read.error();
  const std::string title = view.title.empty() ? "values and moves" : view.title;
  constexpr double title_size = 22;
  Frame f = frame_of(view, *read);
  const double inner = std::max({f.width(), 420.0, text_width(title, title_size, true)});
  f.left = margin + (inner - f.width()) / 2;
  SvgWriter svg;
  svg.text(margin + inner / 2, 40, title, {.size = title_size, .bold = true});
  draw_squares(svg, f);
  if (f.block == 1) {
    draw_arrows(svg, f);
    if (f.size >= lettered_cell) draw_letters(svg, f);
  }
  double y = grid_top + f.height() + 22;
  if (read->low <= read->high) y = draw_scale(svg, margin, y, inner, read->low, read->high);
  y = draw_legend(svg, margin, y, inner, legend_items(f));
  return svg.finish(inner + 2 * margin, y + 12, title);
}

}  // namespace quoll
