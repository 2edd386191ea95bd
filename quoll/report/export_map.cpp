#include "quoll/report/export_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "quoll/base/math.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/fields.hpp"

namespace quoll {

namespace {

Result<const Layout*> grid_of(const Mdp& mdp) {
  const Layout* layout = mdp.layout();
  if (layout && layout->columns > 0 && layout->cell.size() == mdp.states()) return layout;
  return Error{"", 0, 0, "expected a world whose states are cells of a grid", ""};
}

struct Point {
  double x = 0.0, y = 0.0;
};

Point middle(const Layout& layout, std::uint32_t cell) {
  const std::uint32_t across = cell % layout.columns, down = cell / layout.columns;
  const double column = across, row = down;
  if (!layout.frame) return {column, row};
  const Layout::Frame& frame = *layout.frame;
  const double east = (column + 0.5) * frame.side;
  const double north = (layout.rows - row - 0.5) * frame.side;
  const double cosine = math::cos(frame.yaw);
  const double sine = math::sin(frame.yaw);
  return {frame.x + cosine * east - sine * north, frame.y + sine * east + cosine * north};
}

}  // namespace

Result<std::string> moves_csv(const MapExport& map) {
  const Mdp& mdp = *map.mdp;
  const Result<const Layout*> layout = grid_of(mdp);
  if (!layout) return layout.error();
  std::string out = map.cost.empty() ? "x,y,state,move\n" : "x,y,state,move,cost\n";
  for (State s = 0; s < mdp.states(); ++s) {
    const Point at = middle(**layout, (*layout)->cell[s]);
    const bool moves = !mdp.terminal(s) && map.policy[s] != no_action;
    out += shortest(at.x) + "," + shortest(at.y) + "," + as_field(mdp.state_name(s)) + ",";
    if (moves) out += as_field(mdp.action_name(mdp.choice_begin(s) + map.policy[s]));
    if (!map.cost.empty()) out += "," + shortest(map.cost[s] + 0.0);  // -0 is 0
    out += "\n";
  }
  return out;
}

Result<CostImage> cost_image(const MapExport& map, const std::string& image) {
  const Mdp& mdp = *map.mdp;
  const Result<const Layout*> found = grid_of(mdp);
  if (!found) return found.error();
  const Layout& layout = **found;
  std::vector<double> cost(std::size_t{layout.rows} * layout.columns, HUGE_VAL);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (State s = 0; s < mdp.states(); ++s) {
    if (layout.cell[s] >= cost.size() || !std::isfinite(map.cost[s])) continue;
    double& cell = cost[layout.cell[s]];
    cell = std::min(cell, map.cost[s]);
  }
  for (const double c : cost) {
    if (!std::isfinite(c)) continue;
    low = std::min(low, c);
    high = std::max(high, c);
  }
  CostImage out;
  out.pgm = "P5\n" + std::to_string(layout.columns) + " " + std::to_string(layout.rows) + "\n255\n";
  for (const double c : cost) {
    const double share = high > low ? (c - low) / (high - low) : 0.0;
    out.pgm += static_cast<char>(
        static_cast<unsigned char>(std::isfinite(c) ? std::floor(100.0 * share + 0.5) : 255.0));
  }
  const Layout::Frame frame = layout.frame.value_or(Layout::Frame());
  if (low > high) low = high = 0.0;
  out.yaml = "# cost to go: " + shortest(low + 0.0) + " at level 0, " + shortest(high + 0.0) +
             " at level 100, 255 where there is none\nimage: " + image +
             "\nmode: raw\nresolution: " + shortest(frame.side) + "\norigin: [" +
             shortest(frame.x) + ", " + shortest(frame.y) + ", " + shortest(frame.yaw) +
             "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return out;
}

}  // namespace quoll
