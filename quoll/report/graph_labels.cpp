#include "quoll/report/graph_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quoll {

namespace {

constexpr double padding = 4;
constexpr double node_gap = 5, label_gap = 3, head_reach = 9;

double length_of(const Arrow& arrow) {
  double length = 0;
  for (std::size_t i = 1; i < arrow.samples.size(); ++i) {
    const double dx = arrow.samples[i].x - arrow.samples[i - 1].x;
    const double dy = arrow.samples[i].y - arrow.samples[i - 1].y;
    length += std::sqrt(dx * dx + dy * dy);
  }
  return length;
}

bool holds(const Box& box, const GraphPoint& p) {
  return p.x > box.x && p.x < box.right() && p.y > box.y && p.y < box.bottom();
}

/// The box around an arrow and its head.
Box reach_of(const Arrow& arrow) {
  double left = HUGE_VAL, top = HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL;
  for (const GraphPoint& p : arrow.samples) {
    left = std::min(left, p.x - head_reach);
    top = std::min(top, p.y - head_reach);
    right = std::max(right, p.x + head_reach);
    bottom = std::max(bottom, p.y + head_reach);
  }
  return {left, top, right - left, bottom - top};
}

/// What a label in `box` would hide of arrows; heads weigh most. Stops counting at `limit`.
double hidden(const std::vector<Arrow>& arrows, const std::vector<Box>& reaches, std::size_t own,
              const Box& box, double limit) {
  double cost = 0;
  for (std::size_t i = 0; i < arrows.size() && cost < limit; ++i) {
    if (!box.overlaps(reaches[i])) continue;
    const GraphPoint tip = arrows[i].samples.back();
    const Box head{tip.x - head_reach, tip.y - head_reach, 2 * head_reach, 2 * head_reach};
    if (box.overlaps(head)) cost += 12;
    int covered = 0;
    for (const GraphPoint& p : arrows[i].samples) covered += holds(box, p);
    if (i != own) cost += 3 * covered;
    // A label may stand on its own arrow as long as most of it can still be seen.
    const double share = covered / static_cast<double>(arrows[i].samples.size());
    if (i == own && share > 0.4) cost += 25 * (share - 0.4);
  }
  return cost;
}

struct Candidate {
  Box box;
  double strain = 0;  ///< distance from the best place
};

/// Places on the curve from its middle outwards, then beside it.
std::vector<Candidate> candidates(const Arrow& arrow, const Box& size) {
  std::vector<Candidate> places;
  for (int step = 0; step <= 14; ++step) {
    for (const int sign : {1, -1}) {
      if (step == 0 && sign < 0) continue;
      const double t = 0.47 + 0.025 * step * sign;
      const GraphPoint p = point_at(arrow.curve, t);
      const GraphPoint q = point_at(arrow.curve, t + 0.01);
      const double dx = q.x - p.x, dy = q.y - p.y;
      const double length = std::max(1e-9, std::sqrt(dx * dx + dy * dy));
      const double nx = -dy / length, ny = dx / length;
      // Half the box's extent across the curve: so far beside it the curve stays visible.
      const double half = (std::abs(nx) * size.width + std::abs(ny) * size.height) / 2;
      for (const double beside : {0.0, 1.0, -1.0}) {
        const double off = beside * (half + 3);
        const Box box{p.x + nx * off - size.width / 2, p.y + ny * off - size.height / 2, size.width,
                      size.height};
        places.push_back({box, 0.6 * step + (beside == 0 ? 0.0 : 5.0)});
      }
    }
  }
  return places;
}

bool is_free(const Box& box, const std::vector<Box>& nodes,
             const std::vector<std::optional<Box>>& placed) {
  for (const Box& node : nodes) {
    if (box.overlaps(node, node_gap)) return false;
  }
  for (const auto& other : placed) {
    if (other && box.overlaps(*other, label_gap)) return false;
  }
  return true;
}

}  // namespace

Box label_size(const Arrow& arrow) {
  if (arrow.lines.empty()) return {};
  double width = 0;
  for (const ArrowLine& line : arrow.lines) {
    width = std::max(width, text_width(line.text, arrow_font, line.bold));
  }
  const double lines = static_cast<double>(arrow.lines.size());
  return {0, 0, width + 2 * padding, lines * arrow_font * 1.16 + 4};
}

std::vector<std::optional<Box>> place_labels(const std::vector<Arrow>& arrows,
                                             const std::vector<Box>& nodes, bool all_or_nothing) {
  std::vector<double> length;
  std::vector<Box> reaches;
  for (const Arrow& arrow : arrows) {
    length.push_back(length_of(arrow));
    reaches.push_back(reach_of(arrow));
  }
  std::vector<std::size_t> order(arrows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return length[a] < length[b]; });
  std::vector<std::optional<Box>> placed(arrows.size());
  for (const std::size_t i : order) {
    const Box size = label_size(arrows[i]);
    if (size.width == 0) continue;
    double lowest = HUGE_VAL;
    std::optional<Box> best;
    for (const Candidate& place : candidates(arrows[i], size)) {
      if (place.strain >= lowest || !is_free(place.box, nodes, placed)) continue;
      const double cost =
          place.strain + hidden(arrows, reaches, i, place.box, lowest - place.strain);
      if (cost >= lowest) continue;
      lowest = cost;
      best = place.box;
    }
    placed[i] = best;
    if (!best && all_or_nothing) break;
  }
  return placed;
}

}  // namespace quoll
