#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/induced.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"
#include "quoll/solve/total_certificate.hpp"
#include "quoll/solve/wavefront.hpp"

// Total reward without discounting, for policies that end. Bertsekas and Tsitsiklis 1991
// (stochastic shortest paths); upper bound by guess and inductive proof: Hartmanns and Kaminski
// 2020 (optimistic value iteration). Rewards may have both signs.
//
//   1  pi <- a policy that ends with probability 1 from every live state; where the ends are far,
//   the
//      one to which a wave of sweeps from the ends leads, with its V, if that one ends too
//   2  evaluate pi in place, at first roughly; switch an action only if it is better by more than
//      rounding: with accurate values pi then keeps ending, because no cycle gains
//   3  repeat until nothing switches after an accurate evaluation V; if rough values led to a
//      policy that does not end, begin again with accurate ones only
//   4  stop if the values of policies that do not end keep growing: nothing is certified then
//   5  prove V - e w <= V_pi and V* <= V + e w (total_certificate.hpp)
//
// pi: policy, V: value.

namespace quoll {

namespace {

class EndingIteration {
 public:
  EndingIteration(const Mdp& mdp, const SolveSettings& settings, Ending ending)
      : mdp_(mdp),
        settings_(settings),
        live_(std::move(ending.live)),
        value_(mdp.states(), 0.0),
        outside_(mdp.states(), false) {
    solution_.policy = std::move(ending.policy);
    for (State s = 0; s < mdp.states(); ++s) {
      outside_[s] = live_[s] == 0;
      if (outside_[s] && !mdp.terminal(s)) value_[s] = -infinity;
    }
    const auto [low, high] = mdp.reward_bounds();
    reward_size_ = std::max(std::fabs(low), std::fabs(high));
  }

  /// `patient`: never switches before an accurate evaluation, which is Howard's method and slow.
  Solution run(bool patient) {
    if (!patient) follow_wave();
    std::uint64_t patience = patient ? settings_.max_sweeps : 10'000;
    while (go_on_) {
      const double change = evaluate(patience);
      if (endless_ > (patient ? 0u : 20u)) break;  // step 4
      const double improvement = improve();
      go_on_ = go_on_ && may_continue(settings_, solution_, std::max(change, improvement));
      if (improvement == 0.0 && change <= rounding()) break;
      if (!patient)
        patience = improvement > 0.0 ? 100 : std::min<std::uint64_t>(2 * patience, 10'000);
    }
    return finish();
  }

  bool stopped() const { return !go_on_; }

 private:
  static constexpr std::uint64_t trial = 100;  // sweeps after which endlessness is looked for

  double rounding() const {
    double size = reward_size_;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0) size = std::max(size, std::fabs(value_[s]));
    }
    return 8.0 * half_ulp * size;
  }

  // Step 1. The guess is worse than what states are worth, so that the wave does not run after it.
  void follow_wave() {
    constexpr std::size_t least_bands = 8;
    constexpr std::uint64_t most_sweeps = 500;
    std::vector<double> value = value_;
    std::vector<Action> policy = solution_.policy;
    Wavefront wave(mdp_, value);
    if (wave.bands() < least_bands) return;
    wave.guess(2.0 * std::min(0.0, mdp_.reward_bounds().first));
    const double aim = 32.0 * half_ulp * reward_size_ * static_cast<double>(4 * wave.bands());
    std::uint64_t updates = 0;
    const bool done = wave.iterate(1.0, aim, policy, [&](std::uint64_t updated, double change) {
      updates += updated;
      solution_.backups += updated;
      solution_.sweeps = updates / mdp_.states();
      go_on_ = may_continue(settings_, solution_, change);
      return go_on_ && updates < most_sweeps * mdp_.states();
    });
    if (!done) return;
    const Result<Mdp> chain =
        induced_model(mdp_, as_probabilities(mdp_, policy), std::nullopt, outside_);
    if (!chain || !ends(*chain)) return;
    value_ = std::move(value);
    solution_.policy = std::move(policy);
  }

  // Step 2, first half. Returns the last change. Counts evaluations in a row that were given up
  // after a trial because the policy does not end.
  double evaluate(std::uint64_t most_sweeps) {
    const Result<Mdp> chain =
        induced_model(mdp_, as_probabilities(mdp_, solution_.policy), std::nullopt, outside_);
    go_on_ = go_on_ && static_cast<bool>(chain);
    const double goal = rounding();
    bool backward = true;
    double change = infinity;
    for (std::uint64_t k = 0; go_on_ && change > goal && k < most_sweeps; ++k) {
      InPlace backend{value_.data()};
      sweep(*chain, 1.0, value_.data(), {0, static_cast<State>(mdp_.states()), backward}, backend);
      change = backend.change;
      backward = !backward;
      ++solution_.sweeps;
      solution_.backups += mdp_.states();
      go_on_ = may_continue(settings_, solution_, change);
      if (k + 1 == trial && change > goal && go_on_) {
        if (!ends(*chain)) {
          ++endless_;
          return change;
        }
        endless_ = 0;
      }
    }
    if (change <= goal) endless_ = 0;
    return change;
  }

  // Whether every live state of a policy's chain can come to its end.
  bool ends(const Mdp& chain) const {
    const std::vector<bool> can = can_end(chain);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] != 0 && !can[s]) return false;
    }
    return true;
  }

  // Step 2, second half: the largest gain of a switch, 0 if there was none.
  double improve() {
    const double doubt = 4.0 * rounding();
    double largest = 0.0;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] == 0) continue;
      const double before = value_[s];
      double best = before + doubt;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        const double q = backup(mdp_, 1.0, value_.data(), c);
        if (!(q > best)) continue;
        best = q;
        value_[s] = q;
        solution_.policy[s] = static_cast<Action>(c - mdp_.choice_begin(s));
      }
      largest = std::max(largest, value_[s] - before);
    }
    ++solution_.sweeps;
    solution_.backups += mdp_.states();
    return largest;
  }

  // Step 5.
  Solution finish() {
    if (endless_ > 0) {
      solution_.lower.assign(mdp_.states(), 0.0);
      solution_.upper.assign(mdp_.states(), 0.0);
      for (State s = 0; s < mdp_.states(); ++s) {
        if (mdp_.terminal(s)) continue;
        solution_.lower[s] = -infinity;
        solution_.upper[s] = live_[s] != 0 ? infinity : -infinity;
      }
    } else {
      TotalCertificate certificate = certify_total(mdp_, live_, solution_.policy, value_);
      solution_.lower = std::move(certificate.lower);
      solution_.upper = std::move(certificate.upper);
    }
    solution_.discount = 1.0;
    conclude(mdp_, solution_, settings_.width);
    return std::move(solution_);
  }

  const Mdp& mdp_;
  const SolveSettings& settings_;
  std::vector<std::uint8_t> live_;
  std::vector<double> value_;
  std::vector<bool> outside_;
  double reward_size_ = 0.0;
  unsigned endless_ = 0;
  bool go_on_ = true;
  Solution solution_;
};

}  // namespace

Result<Solution> solve_undiscounted(const Mdp& mdp, const SolveSettings& settings,
                                    std::string_view method) {
  if (auto error = undiscounted_error(mdp)) return *error;
  return solve_ending(mdp, settings, method, unknown_states(mdp));
}

Solution solve_ending(const Mdp& mdp, const SolveSettings& settings, std::string_view method,
                      const std::vector<bool>& unknown) {
  Ending ending = find_ending(mdp);
  for (std::size_t s = 0; s < unknown.size(); ++s) {
    if (unknown[s]) ending.live[s] = 0;
  }
  Solution solution;
  if (mdp.deterministic()) {
    solution.policy = std::move(ending.policy);
    improve_to_optimum(mdp, settings, 1.0, ending.live, solution);
  } else {
    EndingIteration quick(mdp, settings, ending);
    solution = quick.run(false);
    if (!solution.converged && !quick.stopped()) {
      EndingIteration thorough(mdp, settings, std::move(ending));
      solution = thorough.run(true);
    }
  }
  leave_unknown(mdp, unknown, settings.width, solution);
  solution.method = method;
  return solution;
}

}  // namespace quoll
