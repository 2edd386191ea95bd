#include "quoll/solve/finite_horizon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/solve/methods.hpp"
#include "quoll/solve/rounding.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"

// Backward induction. Bellman 1957; Puterman 1994, "Markov Decision Processes", section 4.5.
//
//   1  V_0 <- 0
//   2  for n = 1 .. N steps left:
//   3    V_n(s) <- max_a r(s,a) + g E V_{n-1}(s'), pi_n(s) <- a maximising a; ends keep 0
//   4    pi_n(s) <- pi_{n-1}(s) where that is as good to within rounding
//   5    the error of V_n: e_n <- g e_{n-1} + that of one sweep (and what step 4 gave away)
//   6    V_n = V_{n-1} to the last bit: so are all that follow, only e_n grows
//
// That |V_n - V*_n| <= e_n and that pi earns V_n less its own e_n follow by induction, also where
// the sign turns with the player to move. V: value_, next_; pi: policy_, greedy_; e: above_,
// below_; g: factor_, with the row sum that makes it largest.

namespace quoll {

namespace {

constexpr std::uint64_t most_changes = std::uint64_t{1} << 26;

/// Whether all sums of so many rewards are integers a double holds.
bool exact_sums(const Mdp& mdp, double discount, double reward_size, std::uint64_t steps) {
  if (reward_size == 0.0) return true;
  if (!mdp.deterministic() || discount != 1.0) return false;
  const auto& reward = mdp.arrays().reward;
  if (!(reward_size * static_cast<double>(steps) < 0x1p53)) return false;
  return std::all_of(reward.begin(), reward.end(), [](double r) { return r == std::floor(r); });
}

class Induction {
 public:
  Induction(const Mdp& mdp, const HorizonSettings& settings, double discount)
      : mdp_(mdp),
        settings_(settings),
        discount_(discount),
        scale_(mdp),
        factor_(Discount(discount).upper * scale_.greatest_row_sum),
        exact_(exact_sums(mdp, discount, scale_.reward_size, settings.steps)),
        value_(mdp.states(), 0.0),
        next_(mdp.states(), 0.0),
        policy_(mdp.states(), no_action),
        greedy_(mdp.states(), no_action) {}

  Result<HorizonSolution> run() {
    bool settled = false;
    for (std::uint64_t left = 1; left <= settings_.steps; ++left) {  // step 2
      if (!settled) {
        if (left > 1 && !may_go_on()) break;
        settled = step(left);
        if (out_.changes.size() > most_changes) {
          return Error{"--horizon", 0, 0,
                       "the policy changes too often to be kept for every step: take fewer steps, "
                       "or ask for neither --json nor -o",
                       ""};
        }
      }
      widen();
      out_.steps = left;
    }
    return finish();
  }

 private:
  // True = the values did not change.
  bool step(std::uint64_t left) {
    error_ = exact_ ? 0.0 : sweep_error(scale_, size_);
    const Residual residual{value_.data(), next_.data(), greedy_.data()};
    const Differences done =
        sweep_all(mdp_, mdp_.carry(discount_), residual, settings_.threads);  // step 3
    ++out_.sweeps;
    out_.action_changes += change_actions(left);
    value_.swap(next_);
    size_ = 0.0;
    for (const double v : value_) size_ = std::max(size_, std::fabs(v));
    return done.least >= 0.0 && done.greatest <= 0.0;  // step 6
  }

  // Step 4; the number of states whose action changed.
  std::uint64_t change_actions(std::uint64_t left) {
    std::uint64_t changed = 0;
    for (State s = 0; s < mdp_.states(); ++s) {
      const Action before = policy_[s];
      if (greedy_[s] == before) continue;
      policy_[s] = greedy_[s];
      if (before == no_action) continue;
      const double kept = backup(mdp_, discount_, value_.data(), mdp_.choice_begin(s) + before);
      if (kept >= next_[s] - error_) {
        policy_[s] = before;
        continue;
      }
      ++changed;
      if (settings_.keep_policy) out_.changes.push_back({left, s, before});
    }
    if (changed > 0) {
      ++out_.changing_steps;
      out_.settled = left;
    }
    return changed;
  }

  // Step 5; the last factor is for the rounding of these sums themselves.
  void widen() {
    constexpr double room = 1.0 + 0x1p-48;
    above_ = (factor_ * above_ + error_) * room;
    below_ = (factor_ * below_ + 2.0 * error_) * room;
  }

  bool may_go_on() const {
    return !settings_.keep_going || settings_.keep_going({out_.sweeps, 0, 0.0});
  }

  // What the steps that were not worked out can add: each at most the largest |reward|.
  double rest() const {
    if (out_.steps == settings_.steps) return 0.0;
    const double left = static_cast<double>(settings_.steps - out_.steps);
    const double endless = 1.0 - factor_ > 0.0 ? 1.0 / (1.0 - factor_) : infinity;
    return 1.01 * scale_.reward_size * std::min(left, endless);
  }

  HorizonSolution finish() {
    const auto [least, greatest] = mdp_.reward_bounds();
    const bool no_loss = !mdp_.alternating() && least >= 0.0;
    const bool no_gain = !mdp_.alternating() && greatest <= 0.0;
    const double under = below_ + rest(), over = above_ + rest();
    out_.lower.assign(mdp_.states(), 0.0);
    out_.upper.assign(mdp_.states(), 0.0);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      out_.lower[s] = add_down(value_[s], -under);
      out_.upper[s] = add_up(value_[s], over);
      if (no_loss) out_.lower[s] = std::max(out_.lower[s], 0.0);
      if (no_gain) out_.upper[s] = std::min(out_.upper[s], 0.0);
      out_.gap = std::max(out_.gap, add_up(out_.upper[s], -out_.lower[s]));
    }
    out_.policy = std::move(policy_);
    out_.discount = discount_;
    std::stable_sort(out_.changes.begin(), out_.changes.end(),
                     [](const auto& a, const auto& b) { return a.step > b.step; });
    // So far `step` is n, the steps left; the other action is taken one step after step N - n.
    for (PolicyChange& change : out_.changes) change.step = out_.steps - change.step + 1;
    return std::move(out_);
  }

  const Mdp& mdp_;
  const HorizonSettings& settings_;
  double discount_;
  ModelScale scale_;
  double factor_;
  bool exact_;
  std::vector<double> value_, next_;
  std::vector<Action> policy_, greedy_;
  double size_ = 0.0;  // largest |value_|
  double error_ = 0.0, above_ = 0.0, below_ = 0.0;
  HorizonSolution out_;
};

}  // namespace

Result<HorizonSolution> solve_horizon(const Mdp& mdp, const HorizonSettings& settings) {
  SolveSettings shared;
  shared.discount = settings.discount;
  const Result<double> discount = discount_in_use(mdp, shared);
  if (!discount) return discount.error();
  if (settings.steps == 0) return Error{"--horizon", 0, 0, "at least one step was expected", ""};
  if (settings.maximise) return Induction(mdp, settings, *discount).run();
  const Result<Mdp> negated = negated_rewards(mdp);
  if (!negated) return negated.error();
  Result<HorizonSolution> result = Induction(*negated, settings, *discount).run();
  if (result) turn_signs(result->lower, result->upper);
  return result;
}

}  // namespace quoll
