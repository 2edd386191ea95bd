#include "quoll/solve/total_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/free_parts.hpp"
#include "quoll/solve/growth.hpp"
#include "quoll/solve/induced.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/sweep.hpp"
#include "quoll/solve/wavefront.hpp"

namespace quoll {

namespace {

class Prover {
 public:
  Prover(const Mdp& mdp, const std::vector<std::uint8_t>& live, const std::vector<Action>& policy,
         const std::vector<double>& value)
      : mdp_(mdp), live_(live), policy_(policy), value_(value), free_(mdp, live) {
    const auto [low, high] = mdp.reward_bounds();
    reward_size_ = std::max(std::fabs(low), std::fabs(high));
    size_ = reward_size_;
    for (State s = 0; s < mdp.states(); ++s) {
      if (live[s] != 0) size_ = std::max(size_, std::fabs(value[s]));
    }
    free_.level_up(value_);
    free_.balance(value_, size_);
    free_.level_up(value_);
  }

  TotalCertificate run() {
    TotalCertificate out{constant(-infinity), constant(infinity)};
    const bool ends = policy_ends();
    bool lower = !ends;  // nothing to prove about a policy that may not end
    bool upper = false;
    for (const double nearness : {1e-9, 1e-12, 1e-14}) {
      if (!(size_ < infinity) || (lower && upper)) break;
      if (!count_moves(nearness * size_)) continue;
      double excess = least_excess();
      for (int attempt = 0; attempt < 6 && !(lower && upper); ++attempt, excess *= 8.0) {
        if (!lower) lower = prove_lower(excess, out.lower);
        if (!upper) upper = prove_upper(excess, out.upper);
      }
    }
    // What the policy is sure of needs the length of its own episodes only.
    if (!lower && size_ < infinity && count_moves(-infinity)) {
      double excess = least_excess();
      for (int attempt = 0; attempt < 6 && !lower; ++attempt, excess *= 8.0) {
        lower = prove_lower(excess, out.lower);
      }
    }
    return out;
  }

 private:
  std::vector<double> constant(double unknown) const {
    std::vector<double> bound(mdp_.states(), 0.0);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s)) bound[s] = live_[s] != 0 ? unknown : -infinity;
    }
    return bound;
  }

  double least_excess() const { return std::max(4.0 * residual(), 32.0 * half_ulp * size_); }

  bool policy_ends() const {
    std::vector<bool> outside(mdp_.states());
    for (State s = 0; s < mdp_.states(); ++s) outside[s] = live_[s] == 0 && !mdp_.terminal(s);
    std::vector<double> chosen = as_probabilities(mdp_, policy_);
    const Result<Mdp> chain = induced_model(mdp_, chosen, std::nullopt, outside);
    if (!chain) return false;
    const std::vector<bool> may_end = can_end(*chain);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] == 0) continue;
      if (!may_end[s]) return false;
      const std::uint64_t c = mdp_.choice_begin(s) + policy_[s];
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        if (outside[mdp_.next(o)]) return false;
      }
    }
    return true;
  }

  // w <- 1 + max over nearly optimal choices of P w, to within half a move; false if it grows
  // without bound. Nearness -infinity: of the policy's choices alone.
  bool count_moves(double nearness) {
    std::vector<bool> near(mdp_.choices(), false);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] == 0) continue;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        const bool kept = backup(mdp_, 1.0, value_.data(), c) >= value_[s] - nearness;
        near[c] = (kept || c == mdp_.choice_begin(s) + policy_[s]) && !free_.inside(c);
      }
    }
    moves_.assign(mdp_.states(), 0.0);
    const auto raise = [&](State s) {
      double most = moves_[s];
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (near[c]) most = std::max(most, 1.0 + mean(moves_, c));
      }
      const double change = most - moves_[s];
      moves_[s] = most;
      return change;
    };
    if (free_.count() == 0 && !count_along_wave(raise)) return false;
    return count_to_and_fro(raise);
  }

  static constexpr double settled = 0.25;  // moves a sweep may still add
  static constexpr double most_moves = 1e9;

  // Nearly all of the way; bands it has left behind may still rise a little.
  template <class Raise>
  bool count_along_wave(const Raise& raise) {
    constexpr std::uint64_t most_updates_of_each = 200'000;
    for (State s = 0; s < mdp_.states(); ++s) moves_[s] = live_[s] != 0 ? 0.0 : -infinity;
    std::uint64_t updates = 0;
    Wavefront wave(mdp_, moves_);
    for (State s = 0; s < mdp_.states(); ++s) moves_[s] = 0.0;
    const auto count = [&](std::uint64_t updated, double change) {
      updates += updated;
      return change < most_moves && updates / mdp_.states() < most_updates_of_each;
    };
    return wave.follow(settled, count, raise, raise);
  }

  template <class Raise>
  bool count_to_and_fro(const Raise& raise) {
    constexpr unsigned most_sweeps = 200'000;
    bool backward = true;
    double change = 1.0;
    for (unsigned k = 0; k < most_sweeps && change > settled && change < most_moves; ++k) {
      change = 0.0;
      for (State i = 0; i < mdp_.states(); ++i) {
        const State s = backward ? static_cast<State>(mdp_.states()) - 1 - i : i;
        if (live_[s] != 0) change = std::max(change, raise(s));
      }
      free_.share(moves_);
      backward = !backward;
    }
    return change <= settled;
  }

  double mean(const std::vector<double>& of, std::uint64_t c) const {
    double sum = 0.0;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      sum += mdp_.probability(o) * of[mdp_.next(o)];
    }
    return sum;
  }

  // How far V is from V_pi, per move.
  double residual() const {
    double largest = 0.0;
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::uint64_t c = mdp_.choice_begin(s) + policy_[s];
      if (live_[s] == 0 || free_.inside(c)) continue;
      const double q = backup(mdp_, 1.0, value_.data(), c);
      largest = std::max(largest, std::fabs(q - value_[s]));
    }
    return largest;
  }

  // An upper bound on sign * (r + sum of p (B(s') - B(s))).
  double gain_up(const std::vector<double>& bound, double sign, State s, std::uint64_t c) const {
    const double reward = sign * mdp_.reward(c);
    const double outcomes = static_cast<double>(mdp_.outcome_end(c) - mdp_.outcome_begin(c));
    double sum = reward;
    if (!free_.inside(c)) {
      sum = add_up(reward, (outcomes + 3.0) * 2.0 * half_ulp * reward_size_);
    }
    return growth_up(mdp_, bound, sign, s, c, sum);
  }

  // T_pi L >= L for L = V - excess * w.
  bool prove_lower(double excess, std::vector<double>& proved) const {
    std::vector<double> bound = proved;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0) bound[s] = value_[s] - excess * moves_[s];
    }
    free_.level_down(bound);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] == 0) continue;
      if (gain_up(bound, -1.0, s, mdp_.choice_begin(s) + policy_[s]) > 0.0) return false;
    }
    proved = std::move(bound);
    return true;
  }

  // T U <= U for U = V + excess * w, raised a little where it fails.
  bool prove_upper(double excess, std::vector<double>& proved) const {
    std::vector<double> bound = proved;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0) bound[s] = value_[s] + excess * moves_[s];
    }
    free_.level_up(bound);
    constexpr unsigned most_sweeps = 40;
    for (unsigned k = 0; k < most_sweeps; ++k) {
      bool raised = false;
      for (State s = 0; s < mdp_.states(); ++s) {
        if (live_[s] == 0) continue;
        for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
          const double gain = gain_up(bound, 1.0, s, c);
          if (!(gain > 0.0)) continue;
          bound[s] = next_up(bound[s] + 2.0 * gain);
          raised = true;
        }
      }
      if (!raised) {
        proved = std::move(bound);
        return true;
      }
      free_.level_up(bound);
    }
    return false;
  }

  const Mdp& mdp_;
  const std::vector<std::uint8_t>& live_;
  const std::vector<Action>& policy_;
  std::vector<double> value_;
  std::vector<double> moves_;  // w
  FreeParts free_;
  double reward_size_ = 0.0;
  double size_ = 0.0;
};

}  // namespace

TotalCertificate certify_total(const Mdp& mdp, const std::vector<std::uint8_t>& live,
                               const std::vector<Action>& policy,
                               const std::vector<double>& value) {
  return Prover(mdp, live, policy, value).run();
}

}  // namespace quoll
