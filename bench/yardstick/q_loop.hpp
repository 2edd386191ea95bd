#pragma once
// The yardstick: Q-learning on a deterministic grid of four moves, written by hand for that one
// case. No registry, no options: constants where Quoll has settings. It does the same work (two
// draws for the behaviour and one for the world per step, ties uniform or first, episodes cut off,
// starts drawn, visits and returns counted) in the same order, so its table must be the same bit
// for bit.

#include <emmintrin.h>

#include <cstdint>
#include <vector>

#include "bench/yardstick/mix.hpp"

namespace yardstick {

inline std::uint64_t stream(std::uint64_t seed, const char* purpose) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (; *purpose; ++purpose) {
    hash = (hash ^ static_cast<unsigned char>(*purpose)) * 0x100000001b3ULL;
  }
  return mix(mix(mix(seed + gamma) ^ hash));
}

struct Move {
  std::uint32_t packed;  // successor; the top bit is set for the goal
  float reward;
};

// The grid world: 4 moves N E S W, -1 a move, start top left, goal bottom right.
struct GridLoop {
  std::uint32_t side;
  double discount, alpha, epsilon;
  std::vector<float> q;
  std::vector<Move> moves;
  std::vector<std::uint32_t> visits;
  std::uint64_t behaviour, world, start;
  std::uint32_t state = 0;
  std::uint64_t episodes = 0, episode_step = 0;
  double episode_return = 0, return_sum = 0;

  GridLoop(std::uint32_t side_, double discount_, double alpha_, double epsilon_,
           std::uint64_t seed)
      : side(side_), discount(discount_), alpha(alpha_), epsilon(epsilon_) {
    const std::uint32_t cells = side * side, goal = cells - 1;
    q.assign(std::size_t{cells} * 4, 0.0f);
    visits.assign(std::size_t{cells} * 4, 0);
    moves.resize(std::size_t{cells} * 4);
    for (std::uint32_t r = 0; r < side; ++r) {
      for (std::uint32_t c = 0; c < side; ++c) {
        const std::uint32_t to[4] = {r > 0 ? (r - 1) * side + c : r * side + c,
                                     c + 1 < side ? r * side + c + 1 : r * side + c,
                                     r + 1 < side ? (r + 1) * side + c : r * side + c,
                                     c > 0 ? r * side + c - 1 : r * side + c};
        for (int a = 0; a < 4; ++a) {
          moves[(std::size_t{r} * side + c) * 4 + a] = {to[a] | (to[a] == goal ? 0x80000000u : 0u),
                                                        -1.0f};
        }
      }
    }
    behaviour = stream(seed, "behaviour");
    world = stream(seed, "world");
    start = stream(seed, "start");
    start += gamma;  // one draw per episode, though there is one start only
  }

  template <bool first_tie>
  void run(std::uint64_t steps) {
    static constexpr std::uint8_t nth[16][4] = {
        {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1, 1}, {0, 1, 1, 1}, {2, 2, 2, 2}, {0, 2, 2, 2},
        {1, 2, 2, 2}, {0, 1, 2, 2}, {3, 3, 3, 3}, {0, 3, 3, 3}, {1, 3, 3, 3}, {0, 1, 3, 3},
        {2, 3, 3, 3}, {0, 2, 3, 3}, {1, 2, 3, 3}, {0, 1, 2, 3}};
    static constexpr std::uint8_t bits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    float* const table = q.data();
    const Move* const move_table = moves.data();
    std::uint32_t* const count = visits.data();
    std::uint64_t b = behaviour;
    std::uint32_t s = state;
    std::uint64_t in_episode = episode_step;
    double sum = episode_return;
    const auto threshold = static_cast<std::uint64_t>(epsilon * 0x1p32 + 0.999999);
    float best;
    unsigned mask;
    const auto look = [&](std::uint32_t at) {
      const __m128 row = _mm_loadu_ps(table + std::size_t{at} * 4);
      __m128 high = _mm_max_ps(row, _mm_shuffle_ps(row, row, _MM_SHUFFLE(1, 0, 3, 2)));
      high = _mm_max_ps(high, _mm_shuffle_ps(high, high, 0xb1));
      best = _mm_cvtss_f32(high);
      mask = static_cast<unsigned>(_mm_movemask_ps(_mm_cmpeq_ps(row, high)));
    };
    look(s);
    for (std::uint64_t t = 0; t < steps; ++t) {
      b += 2 * gamma;
      const std::uint64_t first = mix(b - gamma), second = mix(b);
      const bool explore = (first >> 32) < threshold;
      const std::uint64_t ties = bits[mask];
      const std::uint32_t greedy =
          first_tie ? nth[mask][0] : nth[mask][((second >> 32) * ties) >> 32];
      const auto random = static_cast<std::uint32_t>(((first & 0xffffffffu) * 4) >> 32);
      const std::size_t pair = std::size_t{s} * 4 + (explore ? random : greedy);
      const Move move = move_table[pair];
      const std::uint32_t next = move.packed & 0x7fffffffu;
      const bool end = (move.packed >> 31) != 0;
      const std::uint32_t n = count[pair];
      count[pair] = n + (n != 0xffffffffu);
      look(next);
      const double target = double{move.reward} + discount * (end ? 0.0 : double{best});
      const double old = double{table[pair]};
      table[pair] = static_cast<float>(old + alpha * (target - old));
      sum += double{move.reward};
      if (end || ++in_episode == 2000) {
        in_episode = 0;
        ++episodes;
        return_sum += sum;
        sum = 0;
        start += gamma;
        s = 0;
        look(s);
      } else {
        const bool stayed = next == s;
        s = next;
        if (stayed) look(s);
      }
    }
    behaviour = b;
    world += steps * gamma;
    state = s;
    episode_step = in_episode;
    episode_return = sum;
  }
};

}  // namespace yardstick
