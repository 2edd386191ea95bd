#pragma once
// Occupancy maps of ROS: a gray image (PGM) and a flat YAML file that says what its levels mean and
// where it lies. ROS wiki, map_server, section "Map format".

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/model/terrain.hpp"

namespace quoll {

struct GrayImage {
  std::uint32_t width = 0, height = 0;
  std::uint32_t white = 255;          ///< the largest level
  std::vector<std::uint16_t> levels;  ///< row by row from the top
};

/// Netpbm's PGM, P2 (text) or P5 (bytes; two per level above 255, high byte first); one image.
Result<GrayImage> parse_pgm(std::string_view content, const std::string& path);

/// What the YAML file says. Occupancy p = 1 - level / white (level / white if negated): blocked
/// above `occupied`, ground below `free`, else unknown. In raw mode a level up to 100 is the
/// occupancy in percent, and unknown above.
struct RosMap {
  std::string image;
  Layout::Frame frame;
  bool negate = false;
  bool raw = false;
  double occupied = 0.65;
  double free = 0.196;
};

/// The keys image, resolution (required), origin, negate, occupied_thresh, free_thresh, mode.
Result<RosMap> parse_ros_map(std::string_view content, const std::string& path);

/// The image as terrain; unknown cells are ground only if `cross_unknown`.
TerrainMap to_terrain(const GrayImage& image, const RosMap& map, bool cross_unknown);

}  // namespace quoll
