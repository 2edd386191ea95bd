#include "quoll/report/graph_arrows.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace quoll {

namespace {

constexpr double fan = 46;        // pixels between the middles of neighbouring arrows
constexpr double border_gap = 3;  // between a box and an arrow's ends
constexpr int sample_count = 33;
constexpr int clip_steps = 240;

GraphPoint middle(const Box& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

bool inside(const Box& box, const GraphPoint& p, double gap) {
  return p.x > box.x - gap && p.x < box.right() + gap && p.y > box.y - gap &&
         p.y < box.bottom() + gap;
}

/// "To-CAVE" says no more than the arrow to CAVE does.
bool says_target(const std::string& action, const std::string& target) {
  if (action.size() < target.size() || !action.ends_with(target)) return false;
  std::string before;
  for (const char c : action.substr(0, action.size() - target.size())) {
    if (c >= 'A' && c <= 'Z') before += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') before += c;
  }
  return before.empty() || before == "to" || before == "go" || before == "goto";
}

/// What one outcome's arrow says. `main`: the likeliest outcome of its choice, which carries Q.
std::vector<ArrowLine> lines_of(const GraphView& view, std::uint64_t choice, std::uint64_t outcome,
                                bool main, bool optimal) {
  const Mdp& mdp = *view.mdp;
  const bool chance = mdp.outcome_end(choice) - mdp.outcome_begin(choice) > 1;
  const std::string_view color = optimal ? palette::blue : palette::ink;
  const std::string name = mdp.action_name(choice);
  const bool named =
      chance || view.q.empty() || !says_target(name, mdp.state_name(mdp.next(outcome)));
  std::string first = named ? name : "";
  if (!view.q.empty() && main) first += (named ? " " : "") + label_number(view.q[choice]);
  std::vector<ArrowLine> lines;
  if (!first.empty()) lines.push_back({first, color, optimal});
  const double reward = mdp.reward(choice, outcome);
  std::string second = chance ? "p " + label_number(mdp.probability(outcome)) : "";
  if (reward != 0) second += (second.empty() ? "reward " : ", reward ") + label_number(reward);
  if (!second.empty()) lines.push_back({second, reward != 0 ? palette::orange : palette::grey});
  return lines;
}

/// Quadratic curve through `bend` pixels right of the middle of its chord, as a cubic.
Cubic bent(const GraphPoint& from, const GraphPoint& to, double bend) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double length = std::max(1e-6, std::sqrt(dx * dx + dy * dy));
  const GraphPoint control{(from.x + to.x) / 2 - dy / length * 2 * bend,
                           (from.y + to.y) / 2 + dx / length * 2 * bend};
  const auto towards = [&](const GraphPoint& end) {
    return GraphPoint{end.x + (control.x - end.x) * 2 / 3, end.y + (control.y - end.y) * 2 / 3};
  };
  return {from, towards(from), towards(to), to};
}

/// The piece of a curve between two parameters (de Casteljau).
Cubic piece(const Cubic& curve, double begin, double end) {
  const auto mix = [](const GraphPoint& a, const GraphPoint& b, double t) {
    return GraphPoint{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
  };
  const auto blossom = [&](double r, double s, double t) {
    const GraphPoint a = mix(curve[0], curve[1], r), b = mix(curve[1], curve[2], r),
                     c = mix(curve[2], curve[3], r);
    return mix(mix(a, b, s), mix(b, c, s), t);
  };
  return {blossom(begin, begin, begin), blossom(begin, begin, end), blossom(begin, end, end),
          blossom(end, end, end)};
}

/// The part of a curve between the borders of its two boxes.
Cubic clipped(const Cubic& curve, const Box& from, const Box& to) {
  double begin = 0, end = 1;
  for (int i = 0; i <= clip_steps; ++i) {
    const double t = static_cast<double>(i) / clip_steps;
    if (inside(from, point_at(curve, t), border_gap)) begin = t;
  }
  for (int i = clip_steps; i >= 0; --i) {
    const double t = static_cast<double>(i) / clip_steps;
    if (inside(to, point_at(curve, t), border_gap)) end = t;
  }
  return begin < end ? piece(curve, begin, end) : curve;
}

void set_curve(Arrow& arrow, const Cubic& curve) {
  arrow.curve = curve;
  arrow.samples.clear();
  for (int i = 0; i < sample_count; ++i) {
    arrow.samples.push_back(point_at(curve, static_cast<double>(i) / (sample_count - 1)));
  }
}

/// Foreign boxes the arrow's samples fall into.
int foreign_hits(const Arrow& arrow, const std::vector<Box>& nodes) {
  int hits = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (n == arrow.from || n == arrow.to) continue;
    for (const GraphPoint& p : arrow.samples) hits += inside(nodes[n], p, 8);
  }
  return hits;
}

void route_between(Arrow& arrow, const std::vector<Box>& nodes, double bend) {
  const Box &from = nodes[arrow.from], &to = nodes[arrow.to];
  Arrow best = arrow;
  int fewest = -1;
  for (const double extra : {0.0, 55.0, -55.0, 110.0, -110.0, 170.0, -170.0, 240.0, -240.0}) {
    set_curve(arrow, clipped(bent(middle(from), middle(to), bend + extra), from, to));
    const int hits = foreign_hits(arrow, nodes);
    if (fewest >= 0 && hits >= fewest) continue;
    fewest = hits;
    best = arrow;
    if (hits == 0) break;
  }
  arrow = std::move(best);
}

constexpr std::array<GraphPoint, 4> sides{{{0, -1}, {0, 1}, {1, 0}, {-1, 0}}};

/// How much of what surrounds a state lies on one side of it.
double crowding(const std::vector<Arrow>& arrows, const std::vector<Box>& nodes, State s,
                const GraphPoint& side) {
  double sum = 0;
  for (const Arrow& arrow : arrows) {
    if (arrow.from == arrow.to || (arrow.from != s && arrow.to != s)) continue;
    const GraphPoint here = middle(nodes[s]),
                     there = middle(nodes[arrow.from == s ? arrow.to : arrow.from]);
    const double dx = there.x - here.x, dy = there.y - here.y;
    const double along = (dx * side.x + dy * side.y) / std::sqrt(dx * dx + dy * dy + 1e-9);
    sum += along > 0 ? along * along : 0;
  }
  return sum;
}

/// Loop number `index` of a state: on the emptiest side first; the fifth outside the first, and so
/// on.
void route_loop(Arrow& arrow, const std::vector<Arrow>& arrows, const std::vector<Box>& nodes,
                std::size_t index) {
  std::array<std::pair<double, std::size_t>, 4> order;
  for (std::size_t i = 0; i < 4; ++i) {
    // Level sides carry most labels, so they come last among equals.
    order[i] = {crowding(arrows, nodes, arrow.from, sides[i]) + 0.01 * static_cast<double>(i), i};
  }
  std::sort(order.begin(), order.end());
  const GraphPoint out = sides[order[index % 4].second];
  const std::size_t full_rounds = index / 4;
  const auto ring = static_cast<double>(full_rounds);
  const double reach = 62 + 44 * ring, half = 13 + 5 * ring;
  const Box& box = nodes[arrow.from];
  const GraphPoint centre = middle(box);
  const GraphPoint border{centre.x + out.x * (box.width / 2 + border_gap),
                          centre.y + out.y * (box.height / 2 + border_gap)};
  const auto at = [&](double away, double along) {
    return GraphPoint{border.x + out.x * away - out.y * along,
                      border.y + out.y * away + out.x * along};
  };
  set_curve(arrow, {at(0, -half), at(reach, -half * 2.4), at(reach, half * 2.4), at(0, half)});
}

}  // namespace

GraphPoint point_at(const Cubic& curve, double t) {
  const double u = 1 - t;
  const double a = u * u * u, b = 3 * u * u * t, c = 3 * u * t * t, d = t * t * t;
  return {a * curve[0].x + b * curve[1].x + c * curve[2].x + d * curve[3].x,
          a * curve[0].y + b * curve[1].y + c * curve[2].y + d * curve[3].y};
}

std::vector<Arrow> arrows_of(const GraphView& view) {
  const Mdp& mdp = *view.mdp;
  std::vector<Arrow> arrows;
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const std::uint64_t begin = mdp.outcome_begin(c), end = mdp.outcome_end(c);
      std::uint64_t likeliest = begin;
      for (std::uint64_t o = begin; o < end; ++o) {
        if (mdp.probability(o) > mdp.probability(likeliest)) likeliest = o;
      }
      for (std::uint64_t o = begin; o < end; ++o) {
        Arrow arrow;
        arrow.from = s;
        arrow.to = mdp.next(o);
        arrow.optimal = !view.optimal.empty() && view.optimal[c] && !mdp.terminal(s);
        arrow.chance = end - begin > 1;
        arrow.lines = lines_of(view, c, o, o == likeliest, arrow.optimal);
        arrows.push_back(std::move(arrow));
      }
    }
  }
  return arrows;
}

void route(std::vector<Arrow>& arrows, const std::vector<Box>& nodes) {
  std::map<std::pair<State, State>, std::size_t> count, used;
  for (const Arrow& arrow : arrows) ++count[{arrow.from, arrow.to}];
  for (Arrow& arrow : arrows) {
    const std::size_t index = used[{arrow.from, arrow.to}]++;
    if (arrow.from == arrow.to) {
      route_loop(arrow, arrows, nodes, index);
      continue;
    }
    const bool two_way = count.contains({arrow.to, arrow.from});
    const double last = static_cast<double>(count[{arrow.from, arrow.to}] - 1);
    const double place = static_cast<double>(index) + (two_way ? 0.5 : -last / 2);
    route_between(arrow, nodes, place * fan);
  }
}

}  // namespace quoll
