#pragma once
// The rows of a model that a policy uses, packed: what policy evaluation reads, one row of a state
// where a sweep over all actions reads all.

#include <cstdint>
#include <span>
#include <vector>

#include "quoll/solve/sweep.hpp"

namespace quoll {

/// One row per state; ends have none. Memory: 12 bytes for each outcome of the longest row of a
/// state, 20 bytes a state.
class PolicyRows {
 public:
  /// Room for any policy; one pass over the choices.
  explicit PolicyRows(const Mdp& mdp)
      : mdp_(mdp), place_(mdp.states()), length_(mdp.states(), 0), reward_(mdp.states(), 0.0) {
    std::uint64_t room = 0;
    for (State s = 0; s < mdp.states(); ++s) {
      place_[s] = room;
      std::uint64_t longest = 0;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        longest = std::max(longest, mdp.outcome_end(c) - mdp.outcome_begin(c));
      }
      room += mdp.terminal(s) ? 0 : longest;
    }
    next_.resize(room);
    probability_.resize(room);
  }

  /// From now on the policy takes action a in s. Best called while the row is in the cache anyway.
  void take(State s, Action a) {
    const std::uint64_t c = mdp_.choice_begin(s) + a;
    std::uint64_t i = place_[s];
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o, ++i) {
      next_[i] = mdp_.next(o);
      probability_[i] = mdp_.probability(o);
    }
    length_[s] = static_cast<std::uint32_t>(i - place_[s]);
    reward_[s] = mdp_.reward(c);
  }

  /// r_pi + discount * P_pi value; 0 for ends.
  double backup(double discount, const double* value, State s) const {
    return reward_[s] + discount * mean(value, s);
  }
  bool empty(State s) const { return length_[s] == 0; }
  /// What can follow s under the policy.
  std::span<const State> successors(State s) const {
    return {next_.data() + place_[s], length_[s]};
  }

  /// to <- r_pi + discount * P_pi from, and the least and greatest difference to - from, ends not
  /// counted. The bits do not depend on `threads`.
  Differences sweep(double discount, const std::vector<double>& from, std::vector<double>& to,
                    unsigned threads) const {
    return over_parts(reward_.size(), threads, [&](StateRange range) {
      Differences part;
      for (State s = range.begin; s < range.end; ++s) {
        to[s] = backup(discount, from.data(), s);
        if (!empty(s)) part.take(to[s] - from[s]);
      }
      return part;
    });
  }

  /// to <- from - discount * P_pi from, the operator of the linear system.
  void leave_out(double discount, const std::vector<double>& from, std::vector<double>& to,
                 unsigned threads) const {
    over_parts(reward_.size(), threads, [&](StateRange range) {
      for (State s = range.begin; s < range.end; ++s) {
        to[s] = from[s] - discount * mean(from.data(), s);
      }
      return Differences{};
    });
  }

 private:
  double mean(const double* value, State s) const {
    double sum = 0.0;
    const std::uint64_t end = place_[s] + length_[s];
    for (std::uint64_t i = place_[s]; i < end; ++i) sum += probability_[i] * value[next_[i]];
    return sum;
  }

  const Mdp& mdp_;
  std::vector<std::uint64_t> place_;  // of a state's row
  std::vector<std::uint32_t> length_;
  std::vector<State> next_;
  std::vector<double> probability_, reward_;
};

/// Packs the greedy policy's rows in the sweep that finds it.
struct PackingResidual : Residual {
  PolicyRows* rows;

  PackingResidual(const Residual& residual, PolicyRows& packed)
      : Residual(residual), rows(&packed) {}
  void operator()(State s, double best, Action action) {
    Residual::operator()(s, best, action);
    rows->take(s, action);
  }
};

}  // namespace quoll
