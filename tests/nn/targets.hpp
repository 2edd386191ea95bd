#pragma once
// Runs something on every instruction set this processor has.

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/nn/arithmetic.hpp"

namespace quoll::nn {

/// Calls work() with each of arithmetics() in use; the one before is in use afterwards.
inline void on_every_target(const std::function<void()>& work) {
  const std::string_view before = arithmetic().target;
  for (const std::string_view target : arithmetics()) {
    SCOPED_TRACE(std::string(target));
    ASSERT_TRUE(use_arithmetic(target));
    work();
  }
  use_arithmetic(before);
}

/// The same, and all targets that multiply and add with one rounding give the same bits.
inline void same_bits_where_fused(const std::function<std::vector<float>()>& work) {
  std::vector<float> first;
  on_every_target([&] {
    const std::vector<float> found = work();
    if (!arithmetic().fused) return;
    if (first.empty()) first = found;
    ASSERT_EQ(found.size(), first.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(found[i]), std::bit_cast<std::uint32_t>(first[i]))
          << i;
    }
  });
}

/// Uniform in [-1, 1).
inline std::vector<float> random_floats(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<float> values(n);
  for (float& value : values) value = static_cast<float>(2.0 * rng.uniform() - 1.0);
  return values;
}

}  // namespace quoll::nn
