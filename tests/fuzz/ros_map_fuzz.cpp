#include <cstdlib>
#include <string_view>

#include "quoll/model/formats/ros_map.hpp"

// The text alone, on an image that stands for the one it names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto map = quoll::parse_ros_map(text, "fuzz.yaml");
  if (!map) {
    if (map.error().expected.empty()) std::abort();
    return 0;
  }
  const auto image = quoll::parse_pgm("P2 2 2 255 254 205 0 254", "fuzz.pgm");
  quoll::RobotSettings robot;
  robot.goal = "0.1,0.1";
  const auto arrays = quoll::to_arrays(quoll::to_terrain(*image, *map, true), robot);
  if (arrays && !quoll::Mdp::make(*arrays)) std::abort();
  return 0;
}
