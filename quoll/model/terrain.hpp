#pragma once
// A robot on a map: cells that are blocked, ground or water, moves to the eight neighbours, and the
// way to one goal. Sturtevant 2012, "Benchmarks for Grid-Based Pathfinding", IEEE TCIAIG 4(2)
// 144-148.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/settings.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// What a cell is; a robot stays on the kind it stands on.
enum class Terrain : std::uint8_t { blocked, ground, water };

struct TerrainMap {
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  std::vector<Terrain> cells;          ///< row by row from the top, rows * columns of them
  std::optional<Layout::Frame> frame;  ///< without it a cell's side is the unit of length
};

/// The task on a map. Places are "x,y": column and row from the top left, or metres where the map
/// has a frame; or a state's name "r<row>c<column>".
struct RobotSettings {
  std::string goal;
  std::string start;
  double slip = 0.0;
  bool heading = false;
  double turn_cost = 0.5;

  void describe(Describer& d) {
    d("goal", goal, "where to go: x,y or a name like r3c14; the end of every episode");
    d("start", start, "where episodes begin, as goal; without it in any cell that has a way");
    d("slip", slip, 0, 1 - 1.0 / 1024,
      "probability that a move drifts to a direction beside it, half to each");
    d("heading", heading, "the robot faces one of 8 directions, and goes forward or turns");
    d("turn_cost", turn_cost, 0, 1e6, "with heading: cost of a turn by 45 degrees, in cells");
  }
  std::string_view needs(std::string_view name) const {
    return name == "turn_cost" && !heading ? "heading=true" : "";
  }
};

/// Discount 1, reward = -length of the move: the side of a cell, or sqrt(2) sides on a diagonal;
/// corners are not cut: a diagonal needs both cells beside it. States are the cells with a way to
/// the goal, in reading order, named r<row>c<column>; each has the moves that lead to a cell. A
/// move that drifts against something blocked stays, at the cost of the move it drifted to. With
/// `heading` a state is a cell and a direction, r<row>c<column>-NE, its actions are forward (where
/// a cell is ahead), left and right. Errors name the option. Cost: two passes, about 150 bytes per
/// cell, with heading 600.
Result<MdpArrays> to_arrays(const TerrainMap& map, const RobotSettings& robot);

}  // namespace quoll
