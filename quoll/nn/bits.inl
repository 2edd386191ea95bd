// Numbers that are 0 or 1, 64 in a word, for arithmetic.cpp, once for each instruction set.

#if defined(QUOLL_NN_BITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef QUOLL_NN_BITS_INL
#undef QUOLL_NN_BITS_INL
#else
#define QUOLL_NN_BITS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "quoll/nn/arithmetic.hpp"
#include "quoll/nn/product.inl"

HWY_BEFORE_NAMESPACE();
namespace quoll::nn::HWY_NAMESPACE {

bool pack(const float* x, std::size_t n, std::uint64_t* words) {
  const Wide d;
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  bool flags = true;
  for (std::size_t begin = 0; begin < n; begin += 64) {
    const std::size_t end = std::min(begin + 64, n);
    std::uint64_t word = 0;
    std::size_t i = begin;
    auto other = hn::Ne(zero, zero);
    for (; i + lanes <= end; i += lanes) {
      const Vector now = hn::LoadU(d, x + i);
      const auto set = hn::Not(hn::Eq(now, zero));  // NaN as well
      other = hn::Or(other, hn::AndNot(hn::Eq(now, one), set));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, set, bytes);
      word |= (bytes[0] | std::uint64_t{bytes[1]} << 8) << (i - begin);
    }
    flags &= hn::AllFalse(d, other);
    for (; i < end; ++i) {
      flags &= x[i] == 0.0F || x[i] == 1.0F;
      word |= std::uint64_t{x[i] != 0.0F} << (i - begin);
    }
    words[begin / 64] = word;
  }
  return flags;
}

void unpack(const std::uint64_t* words, std::size_t n, float* x) {
  const Wide d;
  const Vector one = hn::Set(d, 1.0F);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    const std::uint64_t bits = words[i / 64] >> (i % 64);
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits),
                                   static_cast<std::uint8_t>(bits >> 8)};
    hn::StoreU(hn::IfThenElseZero(hn::LoadMaskBits(d, bytes), one), d, x + i);
  }
  for (; i < n; ++i) x[i] = static_cast<float>(words[i / 64] >> (i % 64) & 1);
}

}  // namespace quoll::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
