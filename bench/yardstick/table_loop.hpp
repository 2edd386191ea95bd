#pragma once
// The yardstick for worlds as tables: lanes of one table stepped by a loop written by hand for it,
// in structures of arrays, with uniform actions, a step limit and restarts. No virtual call, no
// columns of feedback but what a learner needs: reward, end, cut.

#include <cstdint>
#include <vector>

#include "bench/yardstick/mix.hpp"
#include "quoll/model/mdp.hpp"

namespace yardstick {

// Every choice padded to `outcomes` thresholds in 32 bits: successor, end and reward by index.
struct TableLoop {
  struct Row {
    std::uint32_t threshold[3];
    std::uint32_t next[3];  // top bit: an end
    float reward[3];
  };
  std::uint32_t actions, limit;
  std::vector<Row> rows;
  std::vector<std::uint32_t> starts;
  std::vector<std::uint64_t> dice, coin;
  std::vector<std::uint32_t> state, elapsed;
  std::vector<float> reward;
  std::vector<std::uint8_t> ended, cut;

  TableLoop(const quoll::Mdp& mdp, std::uint32_t actions_, std::uint32_t lanes,
            std::uint32_t limit_)
      : actions(actions_), limit(limit_), rows(mdp.states() * actions_) {
    for (quoll::State s = 0; s < mdp.states(); ++s) {
      for (quoll::Action a = 0; a < mdp.actions(s); ++a) {
        Row& row = rows[s * actions + a];
        const std::uint64_t c = mdp.choice_begin(s) + a;
        double sum = 0.0;
        std::uint64_t o = mdp.outcome_begin(c);
        for (int i = 0; i < 3; ++i) {
          sum += mdp.probability(o);
          const bool last = o + 1 == mdp.outcome_end(c);
          row.threshold[i] = last || sum >= 1.0 ? ~0u : static_cast<std::uint32_t>(sum * 0x1p32);
          row.next[i] = mdp.next(o) | (mdp.terminal(mdp.next(o)) ? 0x80000000u : 0u);
          row.reward[i] = static_cast<float>(mdp.reward(c, o));
          if (!last) ++o;
        }
      }
    }
    starts.assign(mdp.start().begin(), mdp.start().end());
    for (std::uint32_t i = 0; i < lanes; ++i) {
      dice.push_back(mix(i + 1));
      coin.push_back(mix(i + 1000003));
      state.push_back(starts[dice[i] % starts.size()]);
    }
    elapsed.resize(lanes);
    reward.resize(lanes);
    ended.resize(lanes);
    cut.resize(lanes);
  }

  // One step of every lane; returns how many episodes ended.
  std::uint64_t step() {
    std::uint64_t finished = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      const std::uint64_t bits = mix(coin[i] += gamma);
      const auto action = static_cast<std::uint32_t>(((bits >> 32) * actions) >> 32);
      const auto draw = static_cast<std::uint32_t>(mix(dice[i] += gamma) >> 32);
      const Row& row = rows[state[i] * actions + action];
      const int k = (draw > row.threshold[0]) + (draw > row.threshold[1]);
      const std::uint32_t next = row.next[k];
      reward[i] = row.reward[k];
      ended[i] = static_cast<std::uint8_t>(next >> 31);
      cut[i] = ++elapsed[i] == limit;
      state[i] = next & 0x7fffffffu;
      if (ended[i] | cut[i]) {
        ++finished;
        elapsed[i] = 0;
        state[i] = starts[((mix(dice[i] ^ bits) >> 32) * starts.size()) >> 32];
      }
    }
    return finished;
  }
};

}  // namespace yardstick
