#pragma once
// The step and the draws of cartpole_lanes.cpp, compiled for vectors of 16, 32 and 64 bytes.

#include <bit>
#include <cstdint>

#include "quoll/env/worlds/cartpole.hpp"

namespace quoll::cartpole {

/// The columns of as many lanes as the widest vector holds.
inline constexpr std::size_t block_lanes = 16;
template <class Real>
struct alignas(64) Block {
  Real number[4][block_lanes]{};       // x, speed, angle, turning
  std::uint32_t began[block_lanes]{};  // the step count at the start of the lane's episode
};

/// What a step reads and fills, from the first lane of the first block on.
struct Filled {
  const Action* action;
  Feedback* feedback;
  float* seen;  // four per lane, or nullptr
};

struct Clock {
  std::uint32_t now, limit;  // steps made, this one included; a limit of 0 = none
};

// The upper halves of the doubles -1, 0 and 1; the lower ones are 0.
constexpr std::uint32_t upper_half(double reward) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(reward) >> 32);
}

struct Rewards {
  std::uint32_t step, end;
};

/// Lanes that draw() draws for at once.
inline constexpr std::size_t group = 8;

template <class Real>
struct Kernel {
  /// One step of `count` blocks.
  void (*step)(Block<Real>*, std::size_t count, const Filled&, const Clock&, const Rewards&);
  /// The next four draws of eight streams, as start() takes them: number by number, `group` apart.
  void (*draw)(std::uint64_t* streams, double* starts);
};

/// The widest that this processor has and `most_bytes` allows; Real is double or float.
template <class Real>
const Kernel<Real>& kernel(int most_bytes);

}  // namespace quoll::cartpole
