// Blocks of lanes of the cart and pole go through vectors of 16, 32 or 64 bytes, whichever the
// processor has. Only + - * / and whole numbers, lane by lane: every width gives the bits of the
// plain struct.

#include "quoll/env/worlds/cartpole_kernel.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace quoll::cartpole {
namespace {

static_assert(sizeof(Feedback) == 16);

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

/// Two vectors as one number of move(), so that two chains of operations go side by side.
template <class V>
struct Pair {
  V half[2];
};
#define QUOLL_PAIRWISE(sign)                                               \
  template <class V>                                                       \
  QUOLL_INLINE Pair<V> operator sign(const Pair<V>& a, const Pair<V>& b) { \
    return {{a.half[0] sign b.half[0], a.half[1] sign b.half[1]}};         \
  }                                                                        \
  template <class V, class Real>                                           \
  QUOLL_INLINE Pair<V> operator sign(const Pair<V>& a, const Real & b)     \
    requires std::is_floating_point_v<Real>                                \
  {                                                                        \
    return {{a.half[0] sign b, a.half[1] sign b}};                         \
  }
QUOLL_PAIRWISE(+)
QUOLL_PAIRWISE(-)
QUOLL_PAIRWISE(*)
QUOLL_PAIRWISE(/)
template <class V, class Real>
QUOLL_INLINE Pair<V> operator-(const Real& a, const Pair<V>& b)
  requires std::is_floating_point_v<Real>
{
  return {{a - b.half[0], a - b.half[1]}};
}

/// The top bit is set where |x| > edge or |angle| > lean. Sizes are compared as whole numbers:
/// compilers take apart the comparisons of the widest vectors.
template <class Real, class Bits, class V>
QUOLL_INLINE void fall(const V& x, const V& angle, Bits& down) {
  using Word = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  constexpr auto edge = std::bit_cast<Word>(static_cast<Real>(track_end));
  constexpr auto lean = std::bit_cast<Word>(static_cast<Real>(angle_end));
  constexpr Word size = std::numeric_limits<Word>::max();
  down =
      (edge - (reinterpret_cast<Bits>(x) & size)) | (lean - (reinterpret_cast<Bits>(angle) & size));
}

/// The forces of two vectors of actions.
template <int bytes, class V>
QUOLL_INLINE void forces(const Action* action, Pair<V>& force) {
  constexpr bool twofold = sizeof(force.half[0][0]) == 8;
  using Real = std::conditional_t<twofold, double, float>;
  using Word = std::conditional_t<twofold, std::uint64_t, std::uint32_t>;
  using Bits = Vector<Word, bytes>;
  constexpr std::size_t lanes = bytes / sizeof(Word);
  constexpr auto left = std::bit_cast<Word>(static_cast<Real>(-force_size));
  QUOLL_FOUR_TIMES
  for (std::size_t half = 0; half < 2; ++half) {
    Vector<Action, lanes * sizeof(Action)> chosen;
    load(chosen, action + half * lanes);
    const Bits sign = __builtin_convertvector(chosen, Bits) << (sizeof(Word) * 8 - 1);
    force.half[half] = reinterpret_cast<V>(sign ^ left);
  }
}

/// The part of two vectors that makes one of 4-byte numbers: one of them, or both made narrower.
template <class From, class To>
QUOLL_INLINE void narrow(const From (&from)[2], std::size_t part, To& to) {
  if constexpr (sizeof(from[0][0]) == 4) {
    to = from[part];
  } else {
    using Number = std::remove_cvref_t<decltype(to[0])>;
    using Half = Vector<Number, sizeof to / 2>;
    From low = from[0], high = from[1];
    if constexpr (std::is_integral_v<Number>) {  // top bits
      low = low >> 32;
      high = high >> 32;
    }
    join(__builtin_convertvector(low, Half), __builtin_convertvector(high, Half), to,
         std::make_index_sequence<sizeof to / 4>());
  }
}

/// Lanes whose episode ended: gathered as bits, 32 vectors in one, and then read out. So there is
/// no branch for each.
template <int bytes>
struct Gathered {
  static constexpr std::size_t lanes = bytes / 4;
  using Words = Vector<std::uint32_t, bytes>;
  Words set{}, bit = Words{} + 1;  // bit i of word k: lane first + i lanes + k
  std::size_t first = 0, vectors = 0, found = 0;

  /// The next lanes, by their top bits.
  QUOLL_INLINE void add(const Vector<std::int32_t, bytes>& top, std::uint32_t* to) {
    set = set | (reinterpret_cast<Words>(top >> 31) & bit);
    bit = bit + bit;
    if (++vectors == 32) read(to);
  }
  QUOLL_INLINE void read(std::uint32_t* to) {
    std::uint64_t pairs[lanes / 2];
    std::memcpy(pairs, &set, sizeof set);
    for (std::size_t pair = 0; pair < lanes / 2; ++pair) {
      std::uint64_t left = pairs[pair];
      std::uint32_t* next = to + found;
      found += static_cast<std::size_t>(std::popcount(left));
      // Four at a time, the last of them in vain: to foresee wrongly how many are left is dearer.
      for (; left != 0; next += 4) {
        QUOLL_FOUR_TIMES
        for (int i = 0; i < 4; ++i) {
          const auto at = static_cast<std::size_t>(std::countr_zero(left | 1ULL << 63));
          next[i] = static_cast<std::uint32_t>(first + at % 32 * lanes + 2 * pair + at / 32);
          left &= left - 1;
        }
      }
    }
    first += 32 * lanes;
    vectors = 0;
    set = Words{};
    bit = Words{} + 1;
  }
};

/// As Kernel::step and Kernel::draw.
template <class Real, int bytes>
QUOLL_INLINE Ends step_blocks(Block<Real>* blocks, std::size_t count, const Stepped& stepped,
                              std::uint32_t now, const Feedback& usual) {
  using V = Vector<Real, bytes>;
  using Bits = Vector<std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>, bytes>;
  using Words = Vector<std::uint32_t, bytes>;
  using Signed = Vector<std::int32_t, bytes>;
  constexpr std::size_t lanes = bytes / sizeof(Real), told = bytes / 4;
  constexpr std::size_t feedbacks = bytes / sizeof(Feedback);
  Feedback usuals[feedbacks];
  std::fill_n(usuals, feedbacks, usual);
  Words told_feedback, some_cut{};
  load(told_feedback, usuals);
  Gathered<bytes> gathered;
  const auto [action, due, feedback, seen, ended] = stepped;
  for (std::size_t done = 0; done < count * block_lanes; done += 2 * lanes) {
    Block<Real>& block = blocks[done / block_lanes];
    const std::size_t first = done % block_lanes;
    Pair<V> at[4], force;
    QUOLL_FOUR_TIMES
    for (int i = 0; i < 4; ++i) {
      load(at[i].half[0], block.number[i] + first);
      load(at[i].half[1], block.number[i] + first + lanes);
    }
    forces<bytes>(action + done, force);
    move<Real>(at[0], at[1], at[2], at[3], force);
    Bits down[2];
    QUOLL_FOUR_TIMES
    for (int half = 0; half < 2; ++half) {
      fall<Real>(at[0].half[half], at[2].half[half], down[half]);
      QUOLL_FOUR_TIMES
      for (int i = 0; i < 4; ++i) store(at[i].half[half], block.number[i] + first + half * lanes);
    }
    // From here on vectors of 4-byte words: two of floats, one of doubles.
    QUOLL_FOUR_TIMES
    for (std::size_t part = 0; part < 2 * lanes / told; ++part) {
      const std::size_t lane = done + part * told;
      Vector<float, bytes> numbers[4];
      Signed gone;
      Words left, cut;
      QUOLL_FOUR_TIMES
      for (int i = 0; i < 4; ++i) narrow(at[i].half, part, numbers[i]);
      narrow(down, part, gone);
      load(left, due + lane);
      left = left - now;
      cut = (left - 1u) & ~left;  // the top bit: no step is left
      some_cut = some_cut | cut;
      gathered.add(gone | reinterpret_cast<Signed>(cut), ended);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < told; i += feedbacks) store(told_feedback, feedback + lane + i);
      if (seen) store_rows<bytes>(numbers[0], numbers[1], numbers[2], numbers[3], seen + 4 * lane);
    }
  }
  gathered.read(ended);
  std::uint32_t cuts[told], some = 0;
  store(some_cut, cuts);
  for (const std::uint32_t cut : cuts) some |= cut;
  return {gathered.found, some >> 31 != 0};
}

template <class Real, int bytes>
QUOLL_INLINE void draw_groups(std::uint64_t* streams, std::size_t groups, Real* starts) {
  using Bits = Vector<std::uint64_t, bytes>;
  using Whole = Vector<std::int64_t, bytes>;
  using Doubles = Vector<double, bytes>;
  using Reals = Vector<Real, bytes / 8 * sizeof(Real)>;
  constexpr double low = -start_size, high = start_size;
  constexpr std::size_t lanes = bytes / 8;
  for (std::size_t done = 0; done < groups * group; done += lanes) {
    Bits state;
    load(state, streams + done);
    Real* const to = starts + done / group * 4 * group + done % group;
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
      store(__builtin_convertvector(numbers, Reals), to + i * group);
    }
    store(state, streams + done);
  }
}

#define QUOLL_KERNEL(name, bytes, ...)                                                         \
  template <class Real>                                                                        \
  __VA_ARGS__ Ends step_##name(Block<Real>* blocks, std::size_t count, const Stepped& stepped, \
                               std::uint32_t now, const Feedback& usual) {                     \
    return step_blocks<Real, bytes>(blocks, count, stepped, now, usual);                       \
  }                                                                                            \
  template <class Real>                                                                        \
  __VA_ARGS__ void draw_##name(std::uint64_t* streams, std::size_t groups, Real* starts) {     \
    draw_groups<Real, bytes>(streams, groups, starts);                                         \
  }                                                                                            \
  template <class Real>                                                                        \
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
