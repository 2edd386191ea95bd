#pragma once
// A solved map for the programs of a robot: moves as rows, and the cost to go as an image as map
// servers of ROS read it.

#include <span>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// What is written of a world whose states are cells of a grid.
struct MapExport {
  const Mdp* mdp = nullptr;
  std::span<const Action> policy;  ///< per state; no_action where it has none
  std::span<const double> cost;    ///< per state, what is still to pay; empty = not known
};

/// "x,y,state,move,cost", one row per state: the middle of its cell in metres where the map has a
/// frame, else column and row from the top left; an end has no move. Without costs no column of
/// them. Error: the world has no grid.
Result<std::string> moves_csv(const MapExport& map);

/// A PGM image with one pixel per cell, and the YAML file that belongs to it.
struct CostImage {
  std::string pgm, yaml;
};

/// Mode raw: 0 for the smallest cost, 100 for the largest, 255 (unknown) for walls, cells without a
/// state and costs that are not finite. Of several states in one cell the smallest cost counts.
/// Needs costs. `image` is the name the YAML file gives the image. Error: the world has no grid.
Result<CostImage> cost_image(const MapExport& map, const std::string& image);

}  // namespace quoll
