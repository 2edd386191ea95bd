#pragma once
// The yardstick: lanes of the cart and pole written by hand for that one case, with vectors of 64
// bytes and everything known when it is compiled. Episodes begin anew inside the loop, from a
// counter-based hash (four 16-bit numbers of two 32-bit hashes), without a branch; so the
// observation that ended an episode is lost, which an Environment must deliver. With `rows` a step
// writes for its caller rows of observations, rewards and ends as floats and bytes; without,
// nothing but the columns themselves: an upper bound. Comparisons are made on the bits: GCC takes
// those of 64-byte vectors apart.

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace yardstick {

#if defined(__x86_64__)
#define YARDSTICK_VECTORS __attribute__((noinline, target("avx512f,avx512bw,avx512dq,avx512vl")))
#define YARDSTICK_HALF_VECTORS __attribute__((noinline, target("avx2")))
#else
#define YARDSTICK_VECTORS
#define YARDSTICK_HALF_VECTORS
#endif

template <class Real, bool rows>
struct CartPoleLoop {
  static constexpr int width = 64 / sizeof(Real);
  using Whole = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  using Bits = std::make_unsigned_t<Whole>;
  typedef Real V __attribute__((vector_size(64)));
  typedef Whole M __attribute__((vector_size(64)));
  typedef Bits B __attribute__((vector_size(64)));
  typedef float F __attribute__((vector_size(4 * width)));
  typedef std::uint8_t Bytes __attribute__((vector_size(width)));

  struct alignas(64) Block {
    V x, speed, angle, turning;
    B began, number;  // number: of the lane
    B over;           // bit 0 terminated, bit 1 truncated
  };
  std::size_t lanes;
  Bits limit, clock = 0;
  std::vector<Block> blocks;
  std::vector<float> seen, reward;
  std::vector<std::uint8_t> over;

  CartPoleLoop(std::size_t lanes_, std::uint32_t limit_)
      : lanes(lanes_),
        limit(limit_),
        blocks(lanes / width),
        seen(4 * lanes),
        reward(lanes),
        over(lanes) {
    for (std::size_t i = 0; i < blocks.size() * width; ++i) {
      blocks[i / width].number[i % width] = static_cast<Bits>(i);
    }
  }

  void step(const std::uint32_t* action) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512dq")) return step_wide(action);
#endif
    step_half(action);
  }
  YARDSTICK_VECTORS void step_wide(const std::uint32_t* action) { loop(action); }
  YARDSTICK_HALF_VECTORS void step_half(const std::uint32_t* action) { loop(action); }

 private:
  static constexpr int top = sizeof(Real) * 8 - 1;
  static constexpr Real real(double x) { return static_cast<Real>(x); }

  [[gnu::always_inline]] static void draw(const B& bits, V& to) {
    const M low = reinterpret_cast<M>(bits & Bits{0xffff});
    to = __builtin_convertvector(low, V) * real(0.1 / 65536) - real(0.05);
  }
  [[gnu::always_inline]] static void choose(const B& mask, const V& yes, const V& no, V& to) {
    to = reinterpret_cast<V>((mask & reinterpret_cast<B>(yes)) | (~mask & reinterpret_cast<B>(no)));
  }
  [[gnu::always_inline]] static void series(const V& z, V& odd, V& even) {
    if constexpr (sizeof(Real) == 8) {
      odd =
          (((z * (-1.0 / 39916800) + 1.0 / 362880) * z - 1.0 / 5040) * z + 1.0 / 120) * z - 1.0 / 6;
      even = (((z * (-1.0 / 3628800) + 1.0 / 40320) * z - 1.0 / 720) * z + 1.0 / 24) * z - 0.5;
    } else {
      odd = (z * (-1.0f / 5040) + 1.0f / 120) * z - 1.0f / 6;
      even = (z * (-1.0f / 720) + 1.0f / 24) * z - 0.5f;
    }
  }

  template <std::size_t... i>
  [[gnu::always_inline]] static void store_rows(const F (&x)[4], float* to,
                                                std::index_sequence<i...>) {
    constexpr int n = width, half = width / 2;
    const F low = __builtin_shufflevector(x[0], x[1], int(i / 2 + i % 2 * n)...);
    const F high = __builtin_shufflevector(x[0], x[1], int(half + i / 2 + i % 2 * n)...);
    const F low_2 = __builtin_shufflevector(x[2], x[3], int(i / 2 + i % 2 * n)...);
    const F high_2 = __builtin_shufflevector(x[2], x[3], int(half + i / 2 + i % 2 * n)...);
    const F row[4] = {
        __builtin_shufflevector(low, low_2, int(i / 4 * 2 + i % 2 + i / 2 % 2 * n)...),
        __builtin_shufflevector(low, low_2, int(half + i / 4 * 2 + i % 2 + i / 2 % 2 * n)...),
        __builtin_shufflevector(high, high_2, int(i / 4 * 2 + i % 2 + i / 2 % 2 * n)...),
        __builtin_shufflevector(high, high_2, int(half + i / 4 * 2 + i % 2 + i / 2 % 2 * n)...)};
    std::memcpy(to, &row, sizeof row);
  }

  [[gnu::always_inline]] void loop(const std::uint32_t* action) {
    const Bits now = ++clock, cut = limit;
    float *row = seen.data(), *rewards = reward.data();
    std::uint8_t* overs = over.data();
    for (Block& block : blocks) {
      B chosen;
      if constexpr (sizeof(Real) == 8) {
        typedef std::uint32_t Half __attribute__((vector_size(32)));
        Half half;
        std::memcpy(&half, action, sizeof half);
        chosen = __builtin_convertvector(half, B);
      } else {
        std::memcpy(&chosen, action, sizeof chosen);
      }
      action += width;
      const V force =
          reinterpret_cast<V>((chosen ^ Bits{1}) << top ^ std::bit_cast<Bits>(real(10)));
      const V a = block.angle, w = block.turning, z = a * a;
      V odd, even;
      series(z, odd, even);
      const V sine = a + a * (z * odd), cosine = even * z + real(1);
      const V push = (force + w * w * sine * real(0.05)) * real(1 / 1.1);
      const V angular =
          (sine * real(9.8) - cosine * push) / (real(2.0 / 3) - cosine * cosine * real(0.05 / 1.1));
      const V linear = push - angular * cosine * real(0.05 / 1.1);
      const V x = block.x + block.speed * real(0.02), speed = block.speed + linear * real(0.02);
      const V angle = a + w * real(0.02), turning = w + angular * real(0.02);
      constexpr auto edge = std::bit_cast<Bits>(real(2.4));
      constexpr auto lean = std::bit_cast<Bits>(real(0.20943951023931953));
      constexpr Bits size = ~Bits{0} >> 1;
      const B far = edge - (reinterpret_cast<B>(x) & size);
      const B tilt = lean - (reinterpret_cast<B>(angle) & size);
      const B ended = (far | tilt) >> top;
      const B left = (now - block.began) ^ cut;
      const B late = ((left | -left) >> top) ^ Bits { 1 };
      block.over = ended | late << 1;
      const B again = -(ended | late);
      // The start of the next episode, wherever there is one.
      B h = block.number * Bits{0x9e3779b9} ^ now * Bits{0x85ebca6b};
      h = (h ^ (h >> 16)) * Bits{0x7feb352d};
      h = (h ^ (h >> 15)) * Bits{0x846ca68b};
      h = h ^ (h >> 16);
      B g = h * Bits{0x9e3779b9} + Bits{0x7f4a7c15};
      g = g ^ (g >> 15);
      V start[4];
      draw(h, start[0]);
      draw(h >> 16, start[1]);
      draw(g, start[2]);
      draw(g >> 16, start[3]);
      choose(again, start[0], x, block.x);
      choose(again, start[1], speed, block.speed);
      choose(again, start[2], angle, block.angle);
      choose(again, start[3], turning, block.turning);
      block.began = (again & now) | (~again & block.began);
      if constexpr (rows) {
        const F all[4] = {
            __builtin_convertvector(block.x, F), __builtin_convertvector(block.speed, F),
            __builtin_convertvector(block.angle, F), __builtin_convertvector(block.turning, F)};
        store_rows(all, row, std::make_index_sequence<width>());
        const F ones = F{} + 1.0f;
        std::memcpy(rewards, &ones, sizeof ones);
        const Bytes ends = __builtin_convertvector(block.over, Bytes);
        std::memcpy(overs, &ends, sizeof ends);
        row += 4 * width;
        rewards += width;
        overs += width;
      }
    }
  }
};

}  // namespace yardstick
