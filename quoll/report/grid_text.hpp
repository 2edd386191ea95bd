#pragma once
// A grid world in the terminal: the policy as arrows, the values as heat.

#include <cstdint>
#include <span>
#include <string>

#include "quoll/base/error.hpp"
#include "quoll/report/table.hpp"

namespace quoll {

/// What a picture of a grid shows; the model must have a layout.
struct GridView {
  const Mdp* mdp = nullptr;
  std::span<const double> value;   ///< per state; empty = no heat. nan = not known
  std::span<const Action> policy;  ///< per state; empty = no arrows
  std::span<const std::uint8_t>
      optimal;  ///< per choice, 1 = optimal; empty = the policy's arrow only
  std::string title;
};

/// The arrows, one cell per letter: ^ > v < and o (stay) or Unicode arrows, '#' walls, S the start
/// if there is only one, G ends; with colour the value is the background. A grid too wide for the
/// terminal is cropped to the part around the start, and a line says so. Error: no layout.
Result<std::string> grid_policy_text(const GridView& view, const TerminalStyle& style);

/// The values as shades (colour; else blocks; else digits 0-9) with a legend line. A grid too wide
/// is sampled down, each letter the mean of a square of cells, and a line says so. Error: no
/// layout.
Result<std::string> grid_heat_text(const GridView& view, const TerminalStyle& style);

}  // namespace quoll
