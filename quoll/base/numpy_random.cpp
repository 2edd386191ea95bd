#include "quoll/base/numpy_random.hpp"

#include <array>

namespace quoll {
namespace {

using Wide = unsigned __int128;

// The pool of four words that an integer seed is mixed into, and the words drawn from it.
class SeedSequence {
 public:
  explicit SeedSequence(std::uint64_t seed) {
    const std::array<std::uint32_t, 4> entropy{static_cast<std::uint32_t>(seed),
                                               static_cast<std::uint32_t>(seed >> 32), 0, 0};
    for (std::size_t i = 0; i < pool_.size(); ++i) pool_[i] = hashed(entropy[i]);
    for (std::size_t from = 0; from < pool_.size(); ++from) {
      for (std::size_t to = 0; to < pool_.size(); ++to) {
        if (from != to) pool_[to] = mixed(pool_[to], hashed(pool_[from]));
      }
    }
  }

  std::uint64_t word() {
    const std::uint64_t low = half();
    return low | std::uint64_t{half()} << 32;
  }

 private:
  std::uint32_t hashed(std::uint32_t value) {
    value ^= hash_;
    hash_ *= 0x931e8875u;
    value *= hash_;
    return value ^ value >> 16;
  }
  static std::uint32_t mixed(std::uint32_t x, std::uint32_t y) {
    const std::uint32_t value = x * 0xca01f9ddu - y * 0x4973f715u;
    return value ^ value >> 16;
  }
  std::uint32_t half() {
    std::uint32_t value = pool_[drawn_++ % pool_.size()] ^ output_hash_;
    output_hash_ *= 0x58f38dedu;
    value *= output_hash_;
    return value ^ value >> 16;
  }

  std::array<std::uint32_t, 4> pool_{};
  std::uint32_t hash_ = 0x43b0d7e5u, output_hash_ = 0x8b51f9ddu;
  std::size_t drawn_ = 0;
};

constexpr Wide multiplier = Wide{0x2360ed051fc65da4ULL} << 64 | 0x4385df649fccf645ULL;

}  // namespace

NumpyRandom::NumpyRandom(std::uint64_t seed) {
  SeedSequence words(seed);
  const std::uint64_t state_high = words.word(), state_low = words.word();
  const std::uint64_t increment_high = words.word(), increment_low = words.word();
  const Wide increment = (Wide{increment_high} << 64 | increment_low) << 1 | 1;
  const Wide start = Wide{state_high} << 64 | state_low;
  const Wide state = (increment + start) * multiplier + increment;
  state_high_ = static_cast<std::uint64_t>(state >> 64);
  state_low_ = static_cast<std::uint64_t>(state);
  increment_high_ = static_cast<std::uint64_t>(increment >> 64);
  increment_low_ = static_cast<std::uint64_t>(increment);
}

std::uint64_t NumpyRandom::next() {
  const Wide increment = Wide{increment_high_} << 64 | increment_low_;
  const Wide state = (Wide{state_high_} << 64 | state_low_) * multiplier + increment;
  state_high_ = static_cast<std::uint64_t>(state >> 64);
  state_low_ = static_cast<std::uint64_t>(state);
  const std::uint64_t folded = state_high_ ^ state_low_;
  const unsigned turn = static_cast<unsigned>(state_high_ >> 58);
  return folded >> turn | folded << (-turn & 63u);
}

std::uint32_t NumpyRandom::next32() {
  if (has_kept_) {
    has_kept_ = false;
    return kept_;
  }
  const std::uint64_t word = next();
  kept_ = static_cast<std::uint32_t>(word >> 32);
  has_kept_ = true;
  return static_cast<std::uint32_t>(word);
}

std::uint32_t NumpyRandom::integers(std::uint32_t n) {
  if (n <= 1) return 0;  // NumPy draws nothing here
  std::uint64_t product = std::uint64_t{next32()} * n;
  if (static_cast<std::uint32_t>(product) < n) {
    const std::uint32_t unfair = (~std::uint32_t{0} - (n - 1)) % n;
    while (static_cast<std::uint32_t>(product) < unfair) product = std::uint64_t{next32()} * n;
  }
  return static_cast<std::uint32_t>(product >> 32);
}

void NumpyRandom::persist(Archive& archive) {
  archive("state_high", state_high_);
  archive("state_low", state_low_);
  archive("increment_high", increment_high_);
  archive("increment_low", increment_low_);
  archive("kept", kept_);
  archive("has_kept", has_kept_);
}

}  // namespace quoll
