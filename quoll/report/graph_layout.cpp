// E. R. Gansner, Y. Koren, S. North, "Graph drawing by stress majorization", Graph Drawing 2004.
//   stress(X) = sum over i < j of w_ij (|X_i - X_j| - d_ij)^2,  w_ij = d_ij^-2,
//   d_ij = moves between i and j, directions ignored
//   repeat for each i (section 2.3, localized):
//     X_i := sum over j != i of w_ij (X_j + d_ij (X_i - X_j) / |X_i - X_j|) / sum over j of w_ij
// X -> points, d -> distance.
#include "quoll/report/graph_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "quoll/report/svg.hpp"

namespace quoll {

namespace {

using Points = std::vector<GraphPoint>;

struct Link {
  std::size_t from, to;
};

struct Skeleton {
  std::size_t size = 0;
  std::vector<Link> links;                    ///< each joined pair once
  std::vector<std::vector<double>> distance;  ///< in moves; parts not joined stand a little apart
  std::vector<double> to_end;                 ///< moves to the nearest end, or the largest distance
  bool has_end = false;
};

std::vector<Link> links_of(const Mdp& mdp) {
  std::vector<Link> links;
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        const Link link{std::min(s, mdp.next(o)), std::max(s, mdp.next(o))};
        const bool known = std::any_of(links.begin(), links.end(), [&](const Link& l) {
          return l.from == link.from && l.to == link.to;
        });
        if (link.from != link.to && !known) links.push_back(link);
      }
    }
  }
  return links;
}

Skeleton skeleton_of(const Mdp& mdp) {
  Skeleton g;
  g.size = mdp.states();
  g.links = links_of(mdp);
  std::vector<std::vector<std::size_t>> neighbours(g.size);
  for (const Link& link : g.links) {
    neighbours[link.from].push_back(link.to);
    neighbours[link.to].push_back(link.from);
  }
  double largest = 1;
  g.distance.assign(g.size, std::vector<double>(g.size, -1));
  for (std::size_t root = 0; root < g.size; ++root) {
    std::vector<double>& row = g.distance[root];
    std::deque<std::size_t> queue{root};
    row[root] = 0;
    while (!queue.empty()) {
      const std::size_t at = queue.front();
      queue.pop_front();
      largest = std::max(largest, row[at]);
      for (const std::size_t next : neighbours[at]) {
        if (row[next] >= 0) continue;
        row[next] = row[at] + 1;
        queue.push_back(next);
      }
    }
  }
  for (auto& row : g.distance) {
    for (double& d : row) d = d < 0 ? std::min(largest + 1, 3.0) : d;
  }
  g.to_end.assign(g.size, largest);
  for (State end = 0; end < g.size; ++end) {
    if (!mdp.terminal(end)) continue;
    g.has_end = true;
    for (std::size_t i = 0; i < g.size; ++i) {
      g.to_end[i] = std::min(g.to_end[i], g.distance[i][end]);
    }
  }
  return g;
}

/// Knuth's 64-bit linear congruential generator: scatters beginnings, nothing more.
class Scatter {
 public:
  explicit Scatter(std::uint64_t seed) : state_(seed) {}
  double next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state_ >> 33) / static_cast<double>(1U << 31);
  }

 private:
  std::uint64_t state_;
};

Points beginning(const Skeleton& g, std::uint64_t attempt) {
  Scatter scatter(attempt + 1);
  Points points(g.size);
  const double reach = std::sqrt(static_cast<double>(g.size));
  for (std::size_t i = 0; i < g.size; ++i) {
    const double x = scatter.next(), y = scatter.next();
    // Every other beginning already has the ends at the right.
    points[i] = {attempt % 2 == 0 ? x - g.to_end[i] : x * reach, y * reach};
  }
  return points;
}

void majorize(const Skeleton& g, Points& points, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < g.size; ++i) {
      double sum_x = 0, sum_y = 0, weights = 0;
      for (std::size_t j = 0; j < g.size; ++j) {
        if (j == i) continue;
        const double d = g.distance[i][j], w = 1 / (d * d);
        const double dx = points[i].x - points[j].x, dy = points[i].y - points[j].y;
        const double pull = d / std::max(1e-6, std::sqrt(dx * dx + dy * dy));
        sum_x += w * (points[j].x + dx * pull);
        sum_y += w * (points[j].y + dy * pull);
        weights += w;
      }
      if (weights > 0) points[i] = {sum_x / weights, sum_y / weights};
    }
  }
}

double stress(const Skeleton& g, const Points& points) {
  double sum = 0;
  for (std::size_t i = 0; i < g.size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = points[i].x - points[j].x, dy = points[i].y - points[j].y;
      const double miss = std::sqrt(dx * dx + dy * dy) / g.distance[i][j] - 1;
      sum += miss * miss;
    }
  }
  return sum;
}

double side(const GraphPoint& a, const GraphPoint& b, const GraphPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Pairs of links that cross, and links that pass a third state closely.
double faults(const Skeleton& g, const Points& p) {
  double count = 0;
  for (std::size_t i = 0; i < g.links.size(); ++i) {
    const auto [a, b] = g.links[i];
    for (std::size_t j = 0; j < i; ++j) {
      const auto [c, d] = g.links[j];
      if (a == c || a == d || b == c || b == d) continue;
      if (side(p[a], p[b], p[c]) * side(p[a], p[b], p[d]) < 0 &&
          side(p[c], p[d], p[a]) * side(p[c], p[d], p[b]) < 0) {
        ++count;
      }
    }
    const double dx = p[b].x - p[a].x, dy = p[b].y - p[a].y;
    const double square = std::max(1e-9, dx * dx + dy * dy);
    for (std::size_t k = 0; k < g.size; ++k) {
      if (k == a || k == b) continue;
      const double along = ((p[k].x - p[a].x) * dx + (p[k].y - p[a].y) * dy) / square;
      const double off = side(p[a], p[b], p[k]);
      if (along > 0 && along < 1 && off * off < 0.0625 * square) count += 2;
    }
  }
  return count;
}

void turn(Points& points, double right, double down) {
  const double length = std::sqrt(right * right + down * down);
  if (length < 1e-6) return;
  const double c = right / length, s = down / length;
  for (GraphPoint& p : points) p = {c * p.x + s * p.y, c * p.y - s * p.x};
}

/// Turns the picture so that the way to the ends leads right, or, without ends, its longer side
/// lies level; state 0 in the upper half.
void orient(const Skeleton& g, Points& points) {
  double mean_x = 0, mean_y = 0, mean_end = 0;
  for (std::size_t i = 0; i < g.size; ++i) {
    mean_x += points[i].x / static_cast<double>(g.size);
    mean_y += points[i].y / static_cast<double>(g.size);
    mean_end += g.to_end[i] / static_cast<double>(g.size);
  }
  double right = 0, down = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < g.size; ++i) {
    const double dx = points[i].x - mean_x, dy = points[i].y - mean_y;
    right -= (g.to_end[i] - mean_end) * dx;
    down -= (g.to_end[i] - mean_end) * dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    points[i] = {dx, dy};
  }
  if (!g.has_end) {  // the larger eigenvector of the 2 x 2 matrix of moments
    const double root = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
    const double larger = (xx + yy) / 2 + root;
    right = std::abs(xy) > 1e-9 ? xy : (xx >= yy ? 1 : 0);
    down = std::abs(xy) > 1e-9 ? larger - xx : (xx >= yy ? 0 : 1);
  }
  turn(points, right, down);
  const bool flip = !points.empty() && points[0].y > 1e-6;
  for (GraphPoint& p : points) p.y = flip ? -p.y : p.y;
}

}  // namespace

std::vector<GraphPoint> graph_layout(const Mdp& mdp) {
  constexpr std::uint64_t attempts = 12;
  const Skeleton g = skeleton_of(mdp);
  Points best;
  double lowest = HUGE_VAL;
  for (std::uint64_t attempt = 0; attempt < attempts; ++attempt) {
    Points points = beginning(g, attempt);
    majorize(g, points, 150);
    const double cost = faults(g, points) + stress(g, points) / static_cast<double>(g.size);
    // A clear gain only, so that rounding never chooses between mirror images.
    if (cost < lowest - 1e-3) {
      lowest = cost;
      best = std::move(points);
    }
  }
  orient(g, best);
  return best;
}

}  // namespace quoll
