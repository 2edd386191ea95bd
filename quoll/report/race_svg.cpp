#include "quoll/report/race_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "quoll/report/legend.hpp"
#include "quoll/report/progress.hpp"
#include "quoll/report/race_text.hpp"

namespace quoll {

namespace {

constexpr double row_height = 34, bar_height = 16, panel_width = 340, gap = 18, margin = 24;
constexpr double font = 15, tick_font = 13, widest_name = 330;
constexpr std::string_view yardstick_color = palette::orange, entrant_color = palette::blue;

/// A logarithmic axis between powers of ten.
struct LogAxis {
  double low = 0, high = 1;  // exponents
  double share(double value) const {
    return std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0);
  }
};

/// What a panel shows of each entrant.
struct Panel {
  std::string title;
  const Quartiles& (*quartiles)(const EntrantResult&);
  std::string (*cell)(const EntrantResult&);
  std::string (*tick)(double);
};

const Quartiles& steps_of(const EntrantResult& entrant) {
  return entrant.steps;
}
const Quartiles& seconds_of(const EntrantResult& entrant) {
  return entrant.seconds;
}

bool ran(const EntrantResult& entrant) {
  return !entrant.heats.empty() && entrant.refused.empty();
}

LogAxis axis_of(const std::vector<const EntrantResult*>& rows, const Panel& panel) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const EntrantResult* const row : rows) {
    for (const double value : {panel.quartiles(*row).lower, panel.quartiles(*row).upper}) {
      if (!(value > 0.0) || !std::isfinite(value)) continue;
      low = std::min(low, std::floor(std::log10(value)));
      high = std::max(high, std::ceil(std::log10(value)));
    }
  }
  if (low > high) return {0, 1};
  return {low, std::max(high, low + 1)};
}

/// The longest beginning of a name that fits.
std::string fitting(const std::string& name) {
  if (text_width(name, font) <= widest_name) return name;
  std::string cut = name;
  while (!cut.empty() && text_width(cut + "...", font) > widest_name) cut.pop_back();
  return cut + "...";
}

std::string cell_text(const EntrantResult& entrant, const Panel& panel) {
  std::string text = panel.cell(entrant);
  if (entrant.failures > 0) text += fmt::format(" ({} failed)", failures_cell(entrant));
  return text;
}

double widest_cell(const std::vector<const EntrantResult*>& rows, const Panel& panel) {
  double width = 0;
  for (const EntrantResult* const row : rows) {
    width = std::max(width, text_width(cell_text(*row, panel), tick_font));
  }
  return width;
}

void draw_axis(SvgWriter& svg, const Box& area, const LogAxis& axis, const Panel& panel) {
  double free_from = 0;
  for (double power = axis.low; power <= axis.high; ++power) {
    const double value = std::pow(10.0, power);
    const double x = area.x + axis.share(value) * area.width;
    svg.line(x, area.y, x, area.bottom(),
             fmt::format(R"(stroke="{}" stroke-width="1")", palette::pale));
    const TextStyle style{.size = tick_font, .color = palette::grey};
    const std::string words = panel.tick(value);
    const Box box = text_box(x, area.bottom() + 20, words, style);
    if (box.x < free_from) continue;
    svg.text(x, area.bottom() + 20, words, style);
    free_from = box.right() + 8;
  }
}

void draw_row(SvgWriter& svg, const Box& area, const LogAxis& axis, const EntrantResult& row,
              const Quartiles& values, double middle, bool yardstick) {
  if (!(values.median > 0.0)) return;
  const std::string_view color = yardstick ? yardstick_color : entrant_color;
  const double left = area.x + axis.share(values.lower) * area.width;
  const double right = area.x + axis.share(values.upper) * area.width;
  const double median = area.x + axis.share(values.median) * area.width;
  const double top = middle - bar_height / 2;
  // A band of no width is still seen.
  const Box band{std::min(left, median - 2), top, std::max(right - left, 4.0), bar_height};
  svg.rect(band, 3, fmt::format(R"(fill="{}" fill-opacity="0.28")", color));
  if (row.failed()) {
    svg.circle(median, middle, 6,
               fmt::format(R"(fill="#ffffff" stroke="{}" stroke-width="2.5")", color));
  } else {
    svg.rect({median - 2.5, top - 4, 5, bar_height + 8}, 2, fmt::format(R"(fill="{}")", color));
  }
}

void draw_panel(SvgWriter& svg, const Box& area, double cell_width,
                const std::vector<const EntrantResult*>& rows, const Panel& panel) {
  const LogAxis axis = axis_of(rows, panel);
  draw_axis(svg, area, axis, panel);
  svg.text(area.x + area.width / 2, area.bottom() + 46, panel.title, {.size = font});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double middle = area.y + (static_cast<double>(i) + 0.5) * row_height;
    draw_row(svg, area, axis, *rows[i], panel.quartiles(*rows[i]), middle, i == 0);
    svg.text(area.right() + gap + cell_width, middle + tick_font * 0.36, cell_text(*rows[i], panel),
             {.size = tick_font, .anchor = "end"});
  }
}

}  // namespace

Picture race_svg(const RaceResult& race) {
  SvgWriter svg;
  const std::string title = "race " + race.world +
                            (race.mode == RaceMode::all ? ", from all states" : ", from the start");
  std::vector<const EntrantResult*> rows;
  for (const EntrantResult& entrant : race.entrants) {
    if (ran(entrant)) rows.push_back(&entrant);
  }
  const Panel panels[] = {{"steps until within 1 % of optimal", steps_of, steps_cell, scaled_text},
                          {"processor time", seconds_of, seconds_cell, seconds_text}};
  double names = 0;
  for (const EntrantResult* const row : rows) {
    names = std::max(names, text_width(fitting(row->word), font));
  }
  double width = margin + names + gap;
  double cells[2];
  for (int i = 0; i < 2; ++i) {
    cells[i] = widest_cell(rows, panels[i]);
    width += panel_width + gap + cells[i] + (i == 0 ? 2 * gap : margin);
  }
  const double size = std::min(22.0, 22 * (width - 2 * margin) / text_width(title, 22, true));
  svg.text(width / 2, 40, title, {.size = size, .bold = true});
  if (rows.empty()) {
    svg.text(width / 2, 90, "no heats yet", {.size = font, .color = palette::grey});
    return svg.finish(width, 130, title);
  }
  const double top =
      draw_legend(svg, margin, 58, width - 2 * margin,
                  {{LegendItem::Kind::square, palette::orange, "the lecture's method"},
                   {LegendItem::Kind::square, palette::blue, "the others"},
                   {LegendItem::Kind::none, "",
                    fmt::format("band: quartiles of {} seeds, bar: median, ring: more than half "
                                "failed",
                                race.seeds)}}) +
      16;
  const double height = static_cast<double>(rows.size()) * row_height;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double middle = top + (static_cast<double>(i) + 0.5) * row_height;
    svg.text(margin + names, middle + font * 0.36, fitting(rows[i]->word),
             {.size = font, .anchor = "end"});
  }
  double x = margin + names + gap;
  for (int i = 0; i < 2; ++i) {
    draw_panel(svg, {x, top, panel_width, height}, cells[i], rows, panels[i]);
    x += panel_width + gap + cells[i] + 2 * gap;
  }
  return svg.finish(width, top + height + 66, title);
}

}  // namespace quoll
