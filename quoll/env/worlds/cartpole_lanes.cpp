// Lanes of the cart and pole as columns: blocks of lanes go through vectors of 16, 32 or 64 bytes,
// whichever the processor has. Only + - * / and comparisons, lane by lane: every width gives the
// bits of the plain struct.

#include <algorithm>
#include <bit>
#include <cstring>

#include "quoll/env/worlds/cartpole.hpp"

namespace quoll {
namespace {

/// The columns of as many lanes as the widest vector holds.
constexpr std::size_t block_lanes = 16;
template <class Real>
struct alignas(64) Block {
  Real number[4][block_lanes]{};       // x, speed, angle, turning
  std::uint32_t began[block_lanes]{};  // the step count at the start of the lane's episode
};

/// What a step reads and fills, from the first lane of the first block on.
struct Filled {
  const Action* action;
  Feedback* feedback;
  float* seen;  // four per lane, or nullptr
};

struct Clock {
  std::uint32_t now, limit;  // steps made, this one included; a limit of 0 = none
};

// The upper halves of the doubles -1, 0 and 1; the lower ones are 0.
constexpr std::uint32_t upper_half(double reward) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(reward) >> 32);
}

struct Rewards {
  std::uint32_t step, end;
};

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
  constexpr auto edge = std::bit_cast<Word>(static_cast<Real>(cartpole::track_end));
  constexpr auto lean = std::bit_cast<Word>(static_cast<Real>(cartpole::angle_end));
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
  constexpr auto force_size = std::bit_cast<Word>(static_cast<Real>(cartpole::force_size));
  const Bits force = (action ^ Word{1}) << (sizeof(Word) * 8 - 1) ^ force_size;
  cartpole::move<Real>(to[0], to[1], to[2], to[3], reinterpret_cast<V>(force));
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

constexpr std::size_t group = 8;

/// The next four draws of eight streams, as start() takes them: number by number, `group` apart.
template <int bytes>
QUOLL_INLINE void draw_group(std::uint64_t* streams, double* starts) {
  using Bits = Vector<std::uint64_t, bytes>;
  using Whole = Vector<std::int64_t, bytes>;
  using Doubles = Vector<double, bytes>;
  constexpr double low = -cartpole::start_size, high = cartpole::start_size;
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

template <class Real>
struct Kernel {
  void (*step)(Block<Real>*, std::size_t count, const Filled&, const Clock&, const Rewards&);
  void (*draw)(std::uint64_t* streams, double* starts);
};

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

/// The widest that this processor has, or that `most_bytes` allows.
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

template <class Real>
class CartPoleLanes final : public Environment, private Inspector {
 public:
  CartPoleLanes(CartPole<Real> dynamics, const Lanes& lanes, int most_bytes)
      : dynamics_(dynamics),
        kernel_(kernel<Real>(most_bytes)),
        count_(lanes.count),
        clock_{0, static_cast<std::uint32_t>(lanes.episode_steps)} {
    blocks_.resize((count_ + block_lanes - 1) / block_lanes);
    chosen_.resize(count_);
    for (std::size_t lane = 0; lane < count_; ++lane) {
      streams_.push_back(stream(lanes.seed, "start", lane).state);
      Rng first{streams_[lane]};  // restart() draws it again
      put(lane, dynamics_.start(first));
    }
  }
  Spaces spaces() const override { return dynamics_.spaces(); }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    const std::size_t found = choose(restart);
    float* const seen = now.observation.empty() ? nullptr : now.observation.data();
    alignas(64) std::uint64_t streams[group];
    alignas(64) double starts[4 * group];
    for (std::size_t done = 0; done < found; done += group) {
      const std::size_t some = std::min(group, found - done);
      for (std::size_t i = 0; i < group; ++i)
        streams[i] = i < some ? streams_[chosen_[done + i]] : 0;
      kernel_.draw(streams, starts);
      for (std::size_t i = 0; i < some; ++i) {
        const std::size_t lane = chosen_[done + i], at = lane % block_lanes;
        Block<Real>& block = blocks_[lane / block_lanes];
        streams_[lane] = streams[i];
        block.began[at] = clock_.now;
        QUOLL_FOUR_TIMES
        for (std::size_t n = 0; n < 4; ++n) {
          const auto number = static_cast<Real>(starts[n * group + i]);
          block.number[n][at] = number;
          if (seen) seen[4 * lane + n] = static_cast<float>(number);
        }
      }
    }
  }
  void step(Experience& now) override {
    ++clock_.now;
    const Rewards rewards{upper_half(dynamics_.reward(false)), upper_half(dynamics_.reward(true))};
    const std::size_t whole = count_ / block_lanes, first = whole * block_lanes;
    float* const seen = now.next_observation.empty() ? nullptr : now.next_observation.data();
    kernel_.step(blocks_.data(), whole, {now.action.data(), now.feedback.data(), seen}, clock_,
                 rewards);
    const std::size_t rest = count_ - first;
    if (rest == 0) return;
    // The last lanes by way of a whole block.
    Action action[block_lanes]{};
    Feedback feedback[block_lanes];
    float row[4 * block_lanes];
    std::copy_n(now.action.data() + first, rest, action);
    kernel_.step(&blocks_[whole], 1, {action, feedback, row}, clock_, rewards);
    std::copy_n(feedback, rest, now.feedback.data() + first);
    if (seen) std::copy_n(row, 4 * rest, seen + 4 * first);
  }
  bool set(std::uint32_t, State) override { return false; }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < count_; ++lane) {
      archive("start_dice", streams_[lane]);
      std::uint32_t elapsed = clock_.now - began(lane);
      archive("elapsed", elapsed);
      began(lane) = clock_.now - elapsed;
      for (std::size_t i = 0; i < 4; ++i) archive("number", number(i, lane));
    }
  }
  Inspector* inspector() override { return this; }

 private:
  using Position = typename CartPole<Real>::Position;

  Real& number(std::size_t i, std::size_t lane) {
    return blocks_[lane / block_lanes].number[i][lane % block_lanes];
  }
  std::uint32_t& began(std::size_t lane) {
    return blocks_[lane / block_lanes].began[lane % block_lanes];
  }
  Position at(std::size_t lane) const {
    const auto& number = blocks_[lane / block_lanes].number;
    const std::size_t i = lane % block_lanes;
    return {number[0][i], number[1][i], number[2][i], number[3][i]};
  }
  void put(std::size_t lane, const Position& at) {
    for (std::size_t i = 0; i < 4; ++i) number(i, lane) = at[i];
  }
  // The lanes to restart, found by 64 flags at a time.
  std::size_t choose(std::span<const std::uint8_t> restart) {
    std::size_t found = 0, first = 0;
    for (; first + 64 <= count_; first += 64) found = choose(restart.data() + first, first, found);
    std::uint8_t rest[64]{};
    std::memcpy(rest, restart.data() + first, count_ - first);
    return choose(rest, first, found);
  }
  std::size_t choose(const std::uint8_t* flags, std::size_t first, std::size_t found) {
    std::uint64_t set = 0;
    for (std::size_t i = 0; i < 64; i += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, flags + i, 8);
      // The top bit of each byte that is not 0, gathered into one byte by a product.
      constexpr std::uint64_t tops = 0x8080808080808080ULL;
      eight = (((eight & ~tops) + ~tops) | eight) & tops;
      set |= ((eight >> 7) * 0x0102040810204080ULL >> 56) << i;
    }
    for (; set != 0; set &= set - 1) {
      chosen_[found++] = static_cast<std::uint32_t>(first + std::countr_zero(set));
    }
    return found;
  }

  Tree state(std::uint32_t lane, State) const override { return tree_of(at(lane)); }
  Result<void> set(std::uint32_t lane, const Tree& state, State&) override {
    Position position = at(lane);
    if (Result<void> done = assign(position, state); !done) return done;
    put(lane, position);
    began(lane) = clock_.now;
    return {};
  }
  Tree observation(std::uint32_t lane, State) const override {
    std::vector<float> x(4);
    dynamics_.observe(at(lane), x);
    return observation_tree(dynamics_.spaces(), x);
  }
  std::string text(std::uint32_t lane, State) const override { return dynamics_.text(at(lane)); }
  Drawing drawing(std::uint32_t lane, State) const override { return dynamics_.drawing(at(lane)); }

  CartPole<Real> dynamics_;
  const Kernel<Real>& kernel_;
  std::size_t count_;
  Clock clock_;
  std::vector<Block<Real>> blocks_;
  std::vector<std::uint64_t> streams_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace

template <class Real>
std::unique_ptr<Environment> cartpole_lanes(CartPole<Real> dynamics, const Lanes& lanes,
                                            int most_bytes) {
  return std::make_unique<CartPoleLanes<Real>>(dynamics, lanes, most_bytes);
}
template std::unique_ptr<Environment> cartpole_lanes(CartPole<double>, const Lanes&, int);
template std::unique_ptr<Environment> cartpole_lanes(CartPole<float>, const Lanes&, int);

}  // namespace quoll
