#include "quoll/solve/total_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "quoll/solve/free_parts.hpp"
#include "quoll/solve/inductive.hpp"
#include "quoll/solve/moves_left.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/sweep.hpp"

namespace quoll {

namespace {

class Prover {
 public:
  Prover(const Mdp& mdp, const std::vector<std::uint8_t>& live, const std::vector<Action>& policy,
         const std::vector<double>& value)
      : mdp_(mdp),
        live_(live),
        policy_(policy),
        value_(value),
        free_(mdp, live),
        inductive_(mdp, live, free_) {
    const auto [low, high] = mdp.reward_bounds();
    size_ = std::max(std::fabs(low), std::fabs(high));
    for (State s = 0; s < mdp.states(); ++s) {
      if (live[s] != 0) size_ = std::max(size_, std::fabs(value[s]));
    }
    free_.level_up(value_);
    free_.balance(value_, size_);
    free_.level_up(value_);
  }

  TotalCertificate run() {
    TotalCertificate out{inductive_.constant(-infinity), inductive_.constant(infinity)};
    const bool ends = inductive_.ends(policy_);
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
  double least_excess() const { return std::max(4.0 * residual(), 32.0 * half_ulp * size_); }

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
    std::optional<std::vector<double>> moves = moves_left(mdp_, live_, near, free_.parts());
    if (!moves) return false;
    moves_ = *std::move(moves);
    return true;
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

  // T_pi L >= L for L = V - excess * w.
  bool prove_lower(double excess, std::vector<double>& proved) const {
    std::vector<double> bound = proved;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0) bound[s] = value_[s] - excess * moves_[s];
    }
    free_.level_down(bound);
    if (!inductive_.holds_below(bound, policy_)) return false;
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
    if (!inductive_.raise_above(bound)) return false;
    proved = std::move(bound);
    return true;
  }

  const Mdp& mdp_;
  const std::vector<std::uint8_t>& live_;
  const std::vector<Action>& policy_;
  std::vector<double> value_;
  std::vector<double> moves_;  // w
  FreeParts free_;
  Inductive inductive_;
  double size_ = 0.0;
};

}  // namespace

TotalCertificate certify_total(const Mdp& mdp, const std::vector<std::uint8_t>& live,
                               const std::vector<Action>& policy,
                               const std::vector<double>& value) {
  return Prover(mdp, live, policy, value).run();
}

}  // namespace quoll
