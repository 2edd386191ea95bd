#pragma once
// A small world as a graph: states as boxes, moves as arrows with their Q.

#include <cstdint>
#include <span>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/report/svg.hpp"

namespace quoll {

inline constexpr std::uint64_t graph_states = 60;  ///< a larger graph is no picture any more

struct GraphView {
  const Mdp* mdp = nullptr;
  std::span<const double> value;          ///< per state; may be empty
  std::span<const double> q;              ///< per choice; may be empty
  std::span<const std::uint8_t> optimal;  ///< per choice, 1 = optimal: thick; may be empty
  std::string title;
  std::string world = "WORLD";  ///< what the error's advice calls it
};

/// The state graph: each direction its own curve with its label; several actions between the same
/// two states each their own; self-loops drawn; start and ends marked. Same input, same bytes.
/// Error: over graph_states states, with what to use instead.
Result<Picture> graph_svg(const GraphView& view);

}  // namespace quoll
