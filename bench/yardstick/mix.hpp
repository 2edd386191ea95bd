#pragma once
// The 64-bit mixing that the loops by hand draw their numbers with (SplitMix64's finaliser).

#include <cstdint>

namespace yardstick {

constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15ULL;

inline std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace yardstick
