#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "quoll/nn/arithmetic.hpp"
#include "tests/nn/targets.hpp"

namespace quoll::nn {
namespace {

std::vector<float> random_flags(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<float> flags(n);
  for (float& flag : flags) flag = static_cast<float>(rng.below(2));
  return flags;
}

TEST(Bits, AreWhatWasPacked) {
  on_every_target([] {
    for (std::size_t n = 0; n <= 200; ++n) {
      const std::vector<float> flags = random_flags(n, n);
      std::vector<std::uint64_t> words((n + 63) / 64 + 1, 77);
      ASSERT_TRUE(arithmetic().pack(flags.data(), n, words.data())) << n;
      EXPECT_EQ(words.back(), 77U) << n;
      std::vector<std::uint64_t> expected(words.size(), 0);
      expected.back() = 77;
      for (std::size_t i = 0; i < n; ++i) {
        if (flags[i] == 1.0F) expected[i / 64] |= std::uint64_t{1} << (i % 64);
      }
      EXPECT_EQ(words, expected) << n;
      std::vector<float> unpacked(n + 1, 0.25F);
      arithmetic().unpack(words.data(), n, unpacked.data());
      EXPECT_EQ(unpacked.back(), 0.25F) << n;
      unpacked.pop_back();
      EXPECT_EQ(unpacked, flags) << n;
    }
  });
}

TEST(Bits, EveryNumberThatIsNoFlagIsNoticed) {
  on_every_target([] {
    for (const std::size_t n : {1U, 16U, 70U, 130U}) {
      for (std::size_t at = 0; at < n; ++at) {
        for (const float other : {0.5F, -1.0F, 2.0F, 1e-45F, std::nanf(""), INFINITY}) {
          std::vector<float> numbers = random_flags(n, at);
          numbers[at] = other;
          std::vector<std::uint64_t> words((n + 63) / 64);
          EXPECT_FALSE(arithmetic().pack(numbers.data(), n, words.data())) << other << " at " << at;
        }
      }
    }
  });
}

}  // namespace
}  // namespace quoll::nn
