// Blocks of lanes of the cart and pole go through vectors of 16, 32 or 64 bytes, whichever the
// processor has. Only + - * / and whole numbers, lane by lane: every width gives the bits of the
// plain struct.

#include "quoll/env/worlds/cartpole_kernel.hpp"

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace quoll::cartpole {
namespace {

static_assert(sizeof(Feedback) == 16 && offsetof(Feedback, terminated) == 8 &&
              offsetof(Feedback, truncated) == 9);

template <class Number, int bytes>
struct VectorOf {
  typedef Number type __attribute__((vector_size(bytes)));
};
template <class Number, int bytes>
using Vector = typename VectorOf<Number, bytes>::type;

#define QUOLL_INLINE [[gnu::always_inline]] inline
#define QUOLL_FOUR_TIMES _Pragma("GCC unroll 4")

template <class V, class From>
QUOLL_INLINE void load(V& to, const From* from) {
  static_assert(std::is_trivially_copyable_v<From>);
  std::memcpy(&to, from, sizeof to);
}
template <class V, class To>
QUOLL_INLINE void store(const V& from, To* to) {
  std::memcpy(static_cast<void*>(to), &from, sizeof from);
}

// a0 b0 a1 b1 ... : the first half into low, the second into high.
template <class V, std::size_t... i>
QUOLL_INLINE void interleave(const V& a, const V& b, V& low, V& high, std::index_sequence<i...>) {
  constexpr int n = sizeof...(i);
  low = __builtin_shufflevector(a, b, static_cast<int>(i / 2 + i % 2 * n)...);
  high = __builtin_shufflevector(a, b, static_cast<int>(n / 2 + i / 2 + i % 2 * n)...);
}
template <class Element, int bytes, class V>
QUOLL_INLINE void interleave(const V& a, const V& b, V& low, V& high) {
  using Whole = Vector<Element, bytes>;
  Whole first, second;
  interleave(reinterpret_cast<Whole>(a), reinterpret_cast<Whole>(b), first, second,
             std::make_index_sequence<bytes / sizeof(Element)>());
  low = reinterpret_cast<V>(first);
  high = reinterpret_cast<V>(second);
}

// The numbers of a, then those of b.
template <class V, class Half, std::size_t... i>
QUOLL_INLINE void join(const Half& a, const Half& b, V& both, std::index_sequence<i...>) {
  both = __builtin_shufflevector(a, b, static_cast<int>(i)...);
}

// Four columns of 4-byte words become rows of four.
template <int bytes, class V>
QUOLL_INLINE void store_rows(const V& a, const V& b, const V& c, const V& d, float* to) {
  constexpr int lanes = bytes / 4;
  V ab[2], cd[2];
  interleave<std::int32_t, bytes>(a, b, ab[0], ab[1]);
  interleave<std::int32_t, bytes>(c, d, cd[0], cd[1]);
  QUOLL_FOUR_TIMES
  for (int half = 0; half < 2; ++half) {
    V low, high;
    interleave<std::int64_t, bytes>(ab[half], cd[half], low, high);
    store(low, to + half * 2 * lanes);
    store(high, to + half * 2 * lanes + lanes);
  }
}

/// All bits set where both |x| <= edge and |angle| <= lean, else none. Sizes are compared as whole
/// numbers: compilers take apart the comparisons of the widest vectors.
template <class Real, class Bits, class V>
QUOLL_INLINE void upright(const V& x, const V& angle, Bits& up) {
  using Word = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  constexpr auto edge = std::bit_cast<Word>(static_cast<Real>(track_end));
  constexpr auto lean = std::bit_cast<Word>(static_cast<Real>(angle_end));
  constexpr Word size = ~Word{0} >> 1;
  const Bits far = edge - (reinterpret_cast<Bits>(x) & size);
  const Bits tilt = lean - (reinterpret_cast<Bits>(angle) & size);
  up = ((far | tilt) >> (sizeof(Word) * 8 - 1)) - 1;
}

/// Moves bytes / sizeof(Real) lanes to `to`; all bits set in `was` and `is` where they were and are
/// up.
template <class Real, int bytes, class V, class Bits>
QUOLL_INLINE void move_lanes(Block<Real>& block, std::size_t first, const Bits& action, V (&to)[4],
                             Bits& was, Bits& is) {
  using Word = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  V at[4];
  QUOLL_FOUR_TIMES
  for (int i = 0; i < 4; ++i) {
    load(at[i], block.number[i] + first);
    to[i] = at[i];
  }
  constexpr auto push = std::bit_cast<Word>(static_cast<Real>(force_size));
  const Bits force = (action ^ Word{1}) << (sizeof(Word) * 8 - 1) ^ push;
  move<Real>(to[0], to[1], to[2], to[3], reinterpret_cast<V>(force));
  upright<Real>(at[0], at[2], was);
  upright<Real>(to[0], to[2], is);
  is = is & was;
  QUOLL_FOUR_TIMES
  for (int i = 0; i < 4; ++i) {
    const Bits kept = ~was & reinterpret_cast<Bits>(at[i]);
    to[i] = reinterpret_cast<V>((was & reinterpret_cast<Bits>(to[i])) | kept);
    store(to[i], block.number[i] + first);
  }
}

/// The same for bytes / 4 lanes, with what is seen of them.
template <int bytes, class Floats, class Words>
QUOLL_INLINE void move_block(Block<float>& block, std::size_t first, const Action* action,
                             Floats (&seen)[4], Words& was, Words& is) {
  Words chosen;
  load(chosen, action);
  move_lanes<float, bytes>(block, first, chosen, seen, was, is);
}
template <int bytes, class Floats, class Words>
QUOLL_INLINE void move_block(Block<double>& block, std::size_t first, const Action* action,
                             Floats (&seen)[4], Words& was, Words& is) {
  using Bits = Vector<std::uint64_t, bytes>;
  using Half = Vector<std::uint32_t, bytes / 2>;
  using HalfSeen = Vector<float, bytes / 2>;
  constexpr std::size_t lanes = bytes / 8;
  constexpr std::make_index_sequence<2 * lanes> all;
  Vector<double, bytes> low[4], high[4];
  Bits was_low, was_high, is_low, is_high;
  Half chosen;
  load(chosen, action);
  move_lanes<double, bytes>(block, first, __builtin_convertvector(chosen, Bits), low, was_low,
                            is_low);
  load(chosen, action + lanes);
  move_lanes<double, bytes>(block, first + lanes, __builtin_convertvector(chosen, Bits), high,
                            was_high, is_high);
  QUOLL_FOUR_TIMES
  for (int i = 0; i < 4; ++i) {
    join(__builtin_convertvector(low[i], HalfSeen), __builtin_convertvector(high[i], HalfSeen),
         seen[i], all);
  }
  join(__builtin_convertvector(was_low, Half), __builtin_convertvector(was_high, Half), was, all);
  join(__builtin_convertvector(is_low, Half), __builtin_convertvector(is_high, Half), is, all);
}

/// One step of `count` blocks.
template <class Real, int bytes>
QUOLL_INLINE void step_blocks(Block<Real>* blocks, std::size_t count, const Filled& filled,
                              const Clock& clock, const Rewards& rewards) {
  using Words = Vector<std::uint32_t, bytes>;
  constexpr std::size_t lanes = bytes / 4;
  for (std::size_t done = 0; done < count * block_lanes; done += lanes) {
    Block<Real>& block = blocks[done / block_lanes];
    const std::size_t first = done % block_lanes;
    Vector<float, bytes> seen[4];
    Words was, is, began;
    move_block<bytes>(block, first, filled.action + done, seen, was, is);
    load(began, block.began + first);
    const Words left = (clock.now - began) ^ clock.limit;
    const Words cut = ((left | -left) >> 31) ^ 1u;
    const Words flags = (~is & 1u) | cut << 8;
    const Words reward = was & ((is & rewards.step) | (~is & rewards.end));
    const Words nothing{};
    store_rows<bytes>(nothing, reward, flags, nothing,
                      reinterpret_cast<float*>(filled.feedback + done));
    if (filled.seen) {
      store_rows<bytes>(seen[0], seen[1], seen[2], seen[3], filled.seen + 4 * done);
    }
  }
}

/// The next four draws of eight streams, as start() takes them: number by number, `group` apart.
template <int bytes>
QUOLL_INLINE void draw_group(std::uint64_t* streams, double* starts) {
  using Bits = Vector<std::uint64_t, bytes>;
  using Whole = Vector<std::int64_t, bytes>;
  using Doubles = Vector<double, bytes>;
  constexpr double low = -start_size, high = start_size;
  for (std::size_t at = 0; at < group; at += bytes / 8) {
    Bits state;
    load(state, streams + at);
    QUOLL_FOUR_TIMES
    for (std::size_t i = 0; i < 4; ++i) {
      state = state + golden_gamma;
      Bits z = state;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      z = (z ^ (z >> 31)) >> 11;
      const Doubles units =
          __builtin_convertvector(reinterpret_cast<Whole>(z), Doubles) * 0x1.0p-53;
      const Doubles numbers = low + (high - low) * units;
      store(numbers, starts + i * group + at);
    }
    store(state, streams + at);
  }
}

#define QUOLL_KERNEL(name, bytes, ...)                                                       \
  template <class Real>                                                                      \
  __VA_ARGS__ void step_##name(Block<Real>* blocks, std::size_t count, const Filled& filled, \
                               const Clock& clock, const Rewards& rewards) {                 \
    step_blocks<Real, bytes>(blocks, count, filled, clock, rewards);                         \
  }                                                                                          \
  template <class Real>                                                                      \
  __VA_ARGS__ void draw_##name(std::uint64_t* streams, double* starts) {                     \
    draw_group<bytes>(streams, starts);                                                      \
  }                                                                                          \
  template <class Real>                                                                      \
  constexpr Kernel<Real> name##_kernel{step_##name<Real>, draw_##name<Real>};

QUOLL_KERNEL(narrow, 16)
#if defined(__x86_64__)
QUOLL_KERNEL(wide, 32, __attribute__((target("avx2"))))
QUOLL_KERNEL(widest, 64, __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl"))))
#endif

}  // namespace

template <class Real>
const Kernel<Real>& kernel(int most_bytes) {
#if defined(__x86_64__)
  if (most_bytes >= 64 && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return widest_kernel<Real>;
  }
  if (most_bytes >= 32 && __builtin_cpu_supports("avx2")) return wide_kernel<Real>;
#endif
  return static_cast<void>(most_bytes), narrow_kernel<Real>;
}
template const Kernel<double>& kernel<double>(int);
template const Kernel<float>& kernel<float>(int);

}  // namespace quoll::cartpole
