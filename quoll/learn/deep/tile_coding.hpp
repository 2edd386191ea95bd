#pragma once
// Tile coding: observed numbers become a few features that are on, one in each of several grids
// (tilings) over the same ranges, each shifted by a part of a tile. Sutton, Barto 2018, section
// 9.5.4, with its asymmetrical offsets: tiling t is shifted by t (1, 3, 5, ...) / tilings, modulo
// 1, tiles. What is outside a range counts as its end.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/env/measured.hpp"

namespace quoll {

class TileCoder {
 public:
  /// Refused above; a file of settings cannot ask for all memory.
  static constexpr std::uint64_t most_features = std::uint64_t{1} << 26;

  /// `tiles` = one whole number from 1 up, or one for each observed number: "8,8,4,4".
  static Result<TileCoder> make(std::span<const Measured> numbers, std::uint64_t tilings,
                                std::string_view tiles);

  std::uint32_t tilings() const { return tilings_; }
  /// Number of features of all tilings.
  std::uint64_t features() const { return std::uint64_t{tilings_} * cells_; }
  /// The feature that is on in each tiling; nan counts as the low end.
  void code(std::span<const float> x, std::span<std::uint32_t> on) const;

 private:
  struct Axis {
    double low, per_unit, tiles;  // tiles per unit, tiles in the range
    std::uint32_t stride;         // cells of the axes after it
  };
  std::vector<Axis> axes_;
  std::vector<double> shift_;  // per tiling and axis, in tiles
  std::uint32_t tilings_ = 0, cells_ = 0;
};

}  // namespace quoll
