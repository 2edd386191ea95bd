#pragma once
// The step and the draws of cartpole_lanes.cpp, compiled for vectors of 16, 32 and 64 bytes.

#include <bit>
#include <cstdint>

#include "quoll/env/worlds/cartpole.hpp"

namespace quoll::cartpole {

/// Columns of lanes: two of the widest vectors of floats.
inline constexpr std::size_t block_lanes = 32;
template <class Real>
struct alignas(64) Block {
  Real number[4][block_lanes]{};  // x, speed, angle, turning
};

/// What a step reads and fills, from the first lane of the first block on.
struct Stepped {
  const Action* action;
  const std::uint32_t* due;  // the step count at which the lane's episode is cut off
  Feedback* feedback;        // `usual` in all lanes
  float* seen;               // four per lane, or nullptr
  std::uint32_t* ended;      // lanes, in no order; room for four more is needed
};
struct Ends {
  std::size_t count = 0;  // of `ended`
  bool cut = false;       // whether some lane was cut off
};

/// Lanes that draw() draws for at once.
inline constexpr std::size_t group = 8;

template <class Real>
struct Kernel {
  /// The step number `now` of `count` blocks; fallen lanes move on.
  Ends (*step)(Block<Real>*, std::size_t count, const Stepped&, std::uint32_t now,
               const Feedback& usual);
  /// The next four draws of `groups` times `group` streams, as start() takes them: of each group
  /// number by number.
  void (*draw)(std::uint64_t* streams, std::size_t groups, Real* starts);
};

/// The widest that this processor has and `most_bytes` allows; Real is double or float.
template <class Real>
const Kernel<Real>& kernel(int most_bytes);

}  // namespace quoll::cartpole
