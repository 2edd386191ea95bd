#pragma once
// Randomness as a value: a stream is a pure function of (seed, purpose, lane), a draw a pure
// function of (stream, counter). Nothing is hidden, nothing is shared, and a draw can be repeated
// or skipped.
//
// The mixing function is the finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable
// pseudorandom number generators", figure 14, variant 13 of David Stafford); a stream walks the
// golden-ratio Weyl sequence from its own 64-bit key.

#include <cstdint>
#include <string_view>

namespace quoll {

inline constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15ULL;

/// 64 well-mixed bits from any 64 bits; a bijection.
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// An integer in [0, n) from 32 random bits; each value's probability is within 2^-32 of 1/n.
constexpr std::uint32_t scale(std::uint32_t bits, std::uint32_t n) {
  return static_cast<std::uint32_t>((std::uint64_t{bits} * n) >> 32);
}

/// A real in [0, 1) with 53 random bits.
constexpr double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

/// One stream of random numbers: 8 bytes, copied and stored like any value. Its state is the key
/// plus the golden ratio times the number of draws made, so it can be moved to any draw at once.
struct Rng {
  std::uint64_t state = 0;

  constexpr std::uint64_t next() { return mix(state += golden_gamma); }

  /// The draw `ahead` places on (1 = what next() would give) without moving the stream.
  constexpr std::uint64_t peek(std::uint64_t ahead) const {
    return mix(state + golden_gamma * ahead);
  }
  constexpr void skip(std::uint64_t draws) { state += golden_gamma * draws; }

  /// Uniform in [0, 1).
  constexpr double uniform() { return unit(next()); }

  /// Uniform in [0, n), n > 0; each value's probability is within 2^-32 of 1/n.
  constexpr std::uint32_t below(std::uint32_t n) {
    return scale(static_cast<std::uint32_t>(next() >> 32), n);
  }

  template <class Archive>
  void persist(Archive& archive) {
    archive("state", state);
  }
};

/// The stream of one purpose ("behaviour", "world", ...) in one lane of a run with this seed.
constexpr Rng stream(std::uint64_t seed, std::string_view purpose, std::uint64_t lane = 0) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a of the purpose
  for (const char letter : purpose) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  }
  return {mix(mix(mix(seed + golden_gamma) ^ hash) + golden_gamma * lane)};
}

}  // namespace quoll
