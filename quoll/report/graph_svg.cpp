#include "quoll/report/graph_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "quoll/report/graph_labels.hpp"
#include "quoll/report/legend.hpp"

namespace quoll {

namespace {

constexpr double name_font = 17, value_font = 14, pill_font = 11, title_font = 24;
constexpr double pill_height = 17;
constexpr double node_gap = 34;         // smallest distance between two boxes
constexpr double level_stretch = 1.15;  // boxes and labels are wider than high
constexpr double largest_side = 5000;   // beyond it the labels left over are listed below instead
constexpr double margin = 30;

/// Everything that has a place in the picture.
struct Drawing {
  std::vector<Box> bodies;  ///< the states' boxes
  std::vector<Box> nodes;   ///< the same with their pills
  std::vector<Arrow> arrows;
  std::vector<std::optional<Box>> labels;  ///< per arrow
  bool free = false;                       ///< no two boxes too near, every label placed
};

struct NodeText {
  std::string name, value, pill;
  std::string_view pill_color;
};

bool few_starts(const Mdp& mdp) {
  return mdp.start().size() <= 4;
}

NodeText node_text(const GraphView& view, State s) {
  const Mdp& mdp = *view.mdp;
  NodeText text{mdp.state_name(s), "", "", ""};
  if (!view.value.empty()) text.value = "V = " + label_number(view.value[s]);
  const auto start = mdp.start();
  if (mdp.terminal(s)) {
    text.pill = "end";
    text.pill_color = palette::green;
  } else if (few_starts(mdp) && std::find(start.begin(), start.end(), s) != start.end()) {
    text.pill = "start";
    text.pill_color = palette::amber;
  }
  return text;
}

Box node_size(const NodeText& text) {
  const double wide =
      std::max(text_width(text.name, name_font, true), text_width(text.value, value_font));
  return {0, 0, std::max(84.0, wide + 24), text.value.empty() ? 42.0 : 58.0};
}

/// Boxes, curves and labels for positions in pixels.
void arrange(Drawing& d, const std::vector<GraphPoint>& places, double unit,
             const std::vector<NodeText>& texts) {
  d.bodies.clear();
  d.nodes.clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    Box box = node_size(texts[i]);
    box.x = places[i].x * unit * level_stretch - box.width / 2;
    box.y = places[i].y * unit - box.height / 2;
    d.bodies.push_back(box);
    const double pill = texts[i].pill.empty() ? 0 : pill_height / 2;
    d.nodes.push_back({box.x, box.y - pill, box.width, box.height + pill});
  }
  d.free = true;
  for (std::size_t i = 0; i < d.nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (d.nodes[i].overlaps(d.nodes[j], node_gap)) d.free = false;
    }
  }
  if (!d.free) return;
  route(d.arrows, d.nodes);
  d.labels = place_labels(d.arrows, d.nodes, true);
  for (std::size_t i = 0; i < d.arrows.size(); ++i) {
    if (!d.labels[i] && !d.arrows[i].lines.empty()) d.free = false;
  }
}

Box bounds(const Drawing& d) {
  double left = HUGE_VAL, top = HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL;
  const auto include = [&](const Box& box) {
    left = std::min(left, box.x);
    top = std::min(top, box.y);
    right = std::max(right, box.right());
    bottom = std::max(bottom, box.bottom());
  };
  for (const Box& node : d.nodes) include(node);
  for (const Arrow& arrow : d.arrows) {
    for (const GraphPoint& p : arrow.samples) include({p.x - 6, p.y - 6, 12, 12});
  }
  for (const auto& label : d.labels) {
    if (label) include(*label);
  }
  return {left, top, right - left, bottom - top};
}

void shift(Drawing& d, double dx, double dy) {
  const auto move_box = [&](Box& box) {
    box.x += dx;
    box.y += dy;
  };
  const auto move_point = [&](GraphPoint& p) { p = {p.x + dx, p.y + dy}; };
  for (Box& box : d.bodies) move_box(box);
  for (Box& box : d.nodes) move_box(box);
  for (auto& label : d.labels) {
    if (label) move_box(*label);
  }
  for (Arrow& arrow : d.arrows) {
    for (GraphPoint& p : arrow.curve) move_point(p);
    for (GraphPoint& p : arrow.samples) move_point(p);
  }
}

/// The smallest picture in which every label is free; at largest_side the last one that has room
/// for the boxes.
Drawing drawing_of(const GraphView& view, const std::vector<NodeText>& texts) {
  Drawing d;
  d.arrows = arrows_of(view);
  const std::vector<GraphPoint> places = graph_layout(*view.mdp);
  double widest_node = 0, widest_label = 0;
  for (const NodeText& text : texts) widest_node = std::max(widest_node, node_size(text).width);
  for (const Arrow& arrow : d.arrows) {
    widest_label = std::max(widest_label, label_size(arrow).width);
  }
  double unit = std::clamp(widest_node + widest_label + 60, 180.0, 320.0) / level_stretch;
  for (;; unit *= 1.08) {
    arrange(d, places, unit, texts);
    if (d.free) break;
    if (d.labels.empty() && unit < 1e5) continue;  // boxes still too near: grow in any case
    const Box all = bounds(d);
    if (std::max(all.width, all.height) <= largest_side) continue;
    d.labels = place_labels(d.arrows, d.nodes, false);
    break;
  }
  return d;
}

void draw_arrow(SvgWriter& svg, const Arrow& arrow) {
  const double head = arrow.optimal ? 15 : 11, wide = arrow.optimal ? 7 : 4.5;
  const GraphPoint tip = arrow.curve[3];
  GraphPoint neck = arrow.curve[0];
  double cut = 0;  // the shaft ends inside the head
  for (int i = 100; i >= 0; --i) {
    neck = point_at(arrow.curve, i / 100.0);
    cut = i / 100.0;
    const double dx = tip.x - neck.x, dy = tip.y - neck.y;
    if (dx * dx + dy * dy >= head * head) break;
  }
  const double dx = tip.x - neck.x, dy = tip.y - neck.y;
  const double length = std::max(1e-6, std::sqrt(dx * dx + dy * dy));
  const GraphPoint side{-dy / length * wide, dx / length * wide};
  const GraphPoint base{tip.x - dx / length * head, tip.y - dy / length * head};
  std::string data =
      fmt::format("M{} {}", svg_number(arrow.curve[0].x), svg_number(arrow.curve[0].y));
  constexpr int pieces = 24;
  for (int i = 1; i <= pieces; ++i) {
    const GraphPoint p = point_at(arrow.curve, cut * i / pieces);
    data += fmt::format("L{} {}", svg_number(p.x), svg_number(p.y));
  }
  const std::string_view color = arrow.optimal ? palette::blue : std::string_view("#8a96a3");
  svg.path(
      data,
      fmt::format(R"(fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round"{})", color,
                  arrow.optimal ? "4" : "1.8", arrow.chance ? R"( stroke-dasharray="7 4")" : ""));
  svg.path(fmt::format("M{} {}L{} {}L{} {}z", svg_number(tip.x), svg_number(tip.y),
                       svg_number(base.x + side.x), svg_number(base.y + side.y),
                       svg_number(base.x - side.x), svg_number(base.y - side.y)),
           fmt::format(R"(fill="{}")", color));
}

void draw_label(SvgWriter& svg, const Arrow& arrow, const Box& box) {
  svg.rect(box, 4, R"(fill="#ffffff")");
  double baseline = box.y + 2 + arrow_font * 0.9;
  for (const ArrowLine& line : arrow.lines) {
    svg.text(box.x + box.width / 2, baseline, line.text,
             {.size = arrow_font, .color = line.color, .bold = line.bold});
    baseline += arrow_font * 1.16;
  }
}

void draw_node(SvgWriter& svg, const Box& box, const NodeText& text) {
  const bool end = text.pill == "end";
  svg.rect(box, 10,
           fmt::format(R"(fill="{}" stroke="{}" stroke-width="2")", end ? "#e3f4ee" : "#eef4fa",
                       end ? palette::green : std::string_view("#4a6a86")));
  const double x = box.x + box.width / 2;
  const double baseline =
      text.value.empty() ? box.y + box.height / 2 + name_font * 0.36 : box.y + 26;
  svg.text(x, baseline, text.name, {.size = name_font, .bold = true});
  if (!text.value.empty()) {
    svg.text(x, box.y + 47, text.value, {.size = value_font, .color = palette::grey});
  }
  if (text.pill.empty()) return;
  const double wide = text_width(text.pill, pill_font, true) + 14;
  svg.rect({x - wide / 2, box.y - pill_height / 2, wide, pill_height}, pill_height / 2,
           fmt::format(R"(fill="{}")", text.pill_color));
  svg.text(x, box.y + pill_font * 0.36, text.pill,
           {.size = pill_font, .color = "#ffffff", .bold = true});
}

std::string starts_text(const Mdp& mdp) {
  std::uint64_t moving = 0;
  for (State s = 0; s < mdp.states(); ++s) moving += !mdp.terminal(s);
  const std::uint64_t starts = mdp.start().size();
  return starts == moving ? "start: any state but ends" : fmt::format("start: {} states", starts);
}

std::vector<LegendItem> legend_of(const GraphView& view, const Drawing& d) {
  using Kind = LegendItem::Kind;
  std::vector<LegendItem> items;
  if (!view.optimal.empty()) items.push_back({Kind::thick_arrow, palette::blue, "optimal move"});
  items.push_back({Kind::arrow, "#8a96a3", view.optimal.empty() ? "move" : "other move"});
  if (std::any_of(d.arrows.begin(), d.arrows.end(), [](const Arrow& a) { return a.chance; })) {
    items.push_back({Kind::dashes, "#8a96a3", "by chance, with probability p"});
  }
  if (!view.q.empty()) items.push_back({Kind::none, "", "number on an arrow: Q of the move"});
  if (!few_starts(*view.mdp)) {
    items.push_back({Kind::none, "", starts_text(*view.mdp)});
  }
  return items;
}

/// Labels that found no place, as a list below the picture.
std::vector<LegendItem> left_over(const Drawing& d, const std::vector<NodeText>& texts) {
  std::vector<LegendItem> items;
  for (std::size_t i = 0; i < d.arrows.size(); ++i) {
    const Arrow& arrow = d.arrows[i];
    if (d.labels[i] || arrow.lines.empty()) continue;
    std::string words = fmt::format("{} to {}:", texts[arrow.from].name, texts[arrow.to].name);
    for (const ArrowLine& line : arrow.lines) words += " " + line.text;
    items.push_back({LegendItem::Kind::none, palette::ink, std::move(words)});
  }
  return items;
}

}  // namespace

Result<Picture> graph_svg(const GraphView& view) {
  if (view.mdp->states() > graph_states) {
    return Error{
        .file = "",
        .expected = fmt::format(
            "expected at most {} states for a graph, {} has {}; use `show {} map` for a "
            "grid, `check {}` or `solve {} --json`",
            graph_states, view.world, view.mdp->states(), view.world, view.world, view.world),
        .nearest = ""};
  }
  std::vector<NodeText> texts;
  for (State s = 0; s < view.mdp->states(); ++s) texts.push_back(node_text(view, s));
  Drawing d = drawing_of(view, texts);
  const std::string title = view.title.empty() ? "states and moves" : view.title;
  const Box all = bounds(d);
  const std::vector<LegendItem> legend = legend_of(view, d), rest = left_over(d, texts);
  double inner = std::max(
      {all.width, text_width(title, title_font, true), std::min(legend_width(legend), 900.0)});
  for (const LegendItem& item : rest) inner = std::max(inner, legend_width({item}));
  const double top = 76;
  shift(d, margin + (inner - all.width) / 2 - all.x, top - all.y);
  SvgWriter svg;
  svg.text(margin + inner / 2, 44, title, {.size = title_font, .bold = true});
  for (const bool optimal : {false, true}) {
    for (const Arrow& arrow : d.arrows) {
      if (arrow.optimal == optimal) draw_arrow(svg, arrow);
    }
  }
  for (std::size_t i = 0; i < d.arrows.size(); ++i) {
    if (d.labels[i]) draw_label(svg, d.arrows[i], *d.labels[i]);
  }
  for (std::size_t i = 0; i < texts.size(); ++i) draw_node(svg, d.bodies[i], texts[i]);
  double y = draw_legend(svg, margin, top + all.height + 24, inner, legend);
  y = draw_legend(svg, margin, y, inner, rest);
  Picture picture = svg.finish(inner + 2 * margin, y + 16, title);
  picture.nodes = d.nodes;
  return picture;
}

}  // namespace quoll
