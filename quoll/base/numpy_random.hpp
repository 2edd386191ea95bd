#pragma once
// NumPy's default generator, number for number: SeedSequence (O'Neill 2015, "Developing a seed_seq
// alternative") feeding PCG64 (O'Neill 2014, "PCG", XSL-RR 128/64). Checked against NumPy in
// tests/base/numpy_random_test.

#include <cstdint>

#include "quoll/base/archive.hpp"

namespace quoll {

class NumpyRandom {
 public:
  /// numpy.random.default_rng(seed).
  explicit NumpyRandom(std::uint64_t seed);

  /// The next 64 bits.
  std::uint64_t next();
  /// Generator.random(): a real in [0, 1) with 53 random bits.
  double random() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// Generator.integers(n) for 1 <= n < 2^32 (as int64): 32-bit Lemire; the low half of a word is
  /// used first and the high half kept for the next call.
  std::uint32_t integers(std::uint32_t n);

  void persist(Archive& archive);

 private:
  std::uint32_t next32();

  std::uint64_t state_high_ = 0, state_low_ = 0, increment_high_ = 0, increment_low_ = 0;
  std::uint32_t kept_ = 0;
  bool has_kept_ = false;
};

}  // namespace quoll
