#include "quoll/solve/optimality.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/solve/backward.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/evaluate.hpp"
#include "quoll/solve/fewest_moves.hpp"
#include "quoll/solve/functional_graph.hpp"
#include "quoll/solve/induced.hpp"
#include "quoll/solve/solver.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"
#include "quoll/solve/total_certificate.hpp"

namespace quoll {

namespace {

constexpr double tolerance = 1e-9;  // relative loss that still counts as optimal

double middle(double lower, double upper) {
  return lower == upper ? lower : lower + 0.5 * (upper - lower);
}

double difference_up(double a, double b) {
  return a == b ? 0.0 : add_up(a, -b);
}

class Judge {
 public:
  Judge(const Mdp& mdp, const Solution& exact, std::span<const Action> policy, double discount)
      : mdp_(mdp),
        exact_lower_(exact.lower),
        policy_(policy),
        discount_(discount),
        upper_(exact.upper),
        along_graph_(exact.method == "label-setting") {}

  Optimality run(std::span<const State> from) {
    const std::vector<bool> reached = reachable(mdp_, from);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      if (reached[s]) {
        asked_.push_back(s);
      } else {
        ++out_.unreachable;
      }
    }
    Result<Evaluation> value = evaluate(mdp_, policy_, discount_, 0.0);
    if (!value) {
      out_.proof = message(value.error());
      return out_;
    }
    value_ = std::move(*value);
    decide();
    if (!out_.optimal) {
      tighten_upper();
      decide();
    }
    if (!out_.optimal && mdp_.deterministic() && !along_graph_) {
      solve_along_graph();
      decide();
    }
    measure_regret(from);
    return out_;
  }

 private:
  void decide() {
    for (const State s : asked_) {
      if (policy_[s] == no_action) return conclude(false, "no action is known in state ", s);
    }
    if (shortest_ways() || only_maximisers()) return;
    bool exact = true;
    std::optional<State> open;
    for (const State s : asked_) {
      const double loss = difference_up(upper_[s], value_.lower[s]);
      if (value_.lower[s] > upper_[s]) {
        out_.proof = "the policy earns more by never ending from " + name(s);
        return;
      }
      if (surely_lost(s)) return conclude(false, "more is earned by another action from ", s);
      exact = exact && loss == 0.0;
      if (!(loss <= tolerance * least_size(s)) && !open) open = s;
    }
    if (open) {
      out_.proof = "in state " + name(*open) + " the bounds leave a loss of up to " +
                   shortest(difference_up(upper_[*open], value_.lower[*open]));
      return;
    }
    out_.optimal = true;
    out_.proof = exact ? "exact: the policy's value equals the optimal value in every state"
                       : "certified: the loss is at most 1e-9 of |V*| in every state";
  }

  void conclude(bool optimal, std::string why, State s) {
    out_.optimal = optimal;
    out_.proof = std::move(why) + name(s);
  }

  std::string name(State s) const { return mdp_.state_name(s); }

  // Deterministic models with two rewards: an action is a maximiser exactly if it lies on a way
  // with the fewest moves. Integers decide, also where the values themselves underflow.
  bool shortest_ways() {
    if (!mdp_.deterministic()) return false;
    const std::optional<TwoRewards> rewards = two_rewards(mdp_);
    const Discount discount(discount_);
    if (!rewards || !fewer_moves_win(*rewards, discount, true)) return false;
    const std::vector<std::uint32_t> fewest = moves_to_end(mdp_);
    const std::vector<std::uint32_t> taken = evaluate_graph(mdp_, policy_, discount).steps;
    const auto longer = std::find_if(asked_.begin(), asked_.end(), [&](State s) {
      return taken[s] != (fewest[s] == unreached ? never : fewest[s]);
    });
    if (longer == asked_.end()) {
      out_.optimal = true;
      out_.proof = "exact graph: every chosen action lies on a way with the fewest moves";
      return true;
    }
    // Each needless move then costs the share 1 - discount of V*.
    if (rewards->move != 0.0 || !(1.0 - discount.upper > 2.0 * tolerance)) return false;
    conclude(false, "exact graph: there is a shorter way from ", *longer);
    return true;
  }

  // Every chosen action is better than all others of its state for certain, or the same as them:
  // then the policy is optimal however wide the intervals are. At discount 1 it must end as well.
  bool only_maximisers() {
    for (const State s : asked_) {
      const std::uint64_t chosen = mdp_.choice_begin(s) + policy_[s];
      const double own = -q_up(chosen, -1.0);
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (c != chosen && !(q_up(c, 1.0) < own) && !same_choice(c, chosen)) return false;
      }
      // Finite values of a policy that stays in a loop for nothing would not tell.
      if (discount_ == 1.0 && stays(s)) return false;
    }
    if (asked_.empty()) return false;
    out_.optimal = true;
    out_.proof = "certified: every chosen action is better than all others of its state";
    return true;
  }

  // Whether the policy may never end from s.
  bool stays(State s) {
    if (ends_.empty()) {
      const Result<Mdp> chain = induced_model(mdp_, as_probabilities(mdp_, policy_), std::nullopt);
      ends_.assign(mdp_.states(), false);
      if (chain) ends_ = can_end(*chain);
    }
    return !ends_[s];
  }

  // An upper bound on sign * Q*(choice).
  double q_up(std::uint64_t c, double sign) const {
    const auto [low, high] = mdp_.reward_bounds();
    const double reward_size = std::max(std::fabs(low), std::fabs(high));
    const double outcomes = static_cast<double>(mdp_.outcome_end(c) - mdp_.outcome_begin(c));
    double mean = 0.0;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      const State next = mdp_.next(o);
      const double value = sign > 0.0 ? upper_[next] : -best_lower(next);
      const Meant p(mdp_.probability(o));
      mean = add_up(mean, scale_up(value >= 0.0 ? std::min(1.0, p.upper) : p.lower, value));
    }
    const double q = backup_up(sign * mdp_.reward(c), Discount(discount_), mean);
    return mdp_.deterministic() ? q : add_up(q, (outcomes + 3.0) * 2.0 * half_ulp * reward_size);
  }

  bool same_choice(std::uint64_t a, std::uint64_t b) const {
    const std::uint64_t count = mdp_.outcome_end(a) - mdp_.outcome_begin(a);
    if (count != mdp_.outcome_end(b) - mdp_.outcome_begin(b)) return false;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t x = mdp_.outcome_begin(a) + i;
      const std::uint64_t y = mdp_.outcome_begin(b) + i;
      if (mdp_.next(x) != mdp_.next(y) || mdp_.probability(x) != mdp_.probability(y) ||
          mdp_.reward(a, x) != mdp_.reward(b, y)) {
        return false;
      }
    }
    return true;
  }

  double best_lower(State s) const { return std::max(exact_lower_[s], value_.lower[s]); }

  double least_size(State s) const {
    const double lower = best_lower(s);
    if (lower <= 0.0 && upper_[s] >= 0.0) return 0.0;
    return std::min(std::fabs(lower), std::fabs(upper_[s]));
  }

  bool surely_lost(State s) const {
    const double lower = exact_lower_[s];
    if (!(lower > value_.upper[s])) return false;
    if (value_.upper[s] == -infinity) return true;
    const double size = std::max(std::fabs(lower), std::fabs(upper_[s]));
    return -add_up(-lower, value_.upper[s]) > tolerance * size;
  }

  // A second upper bound, from how far the policy's own value is from being inductive.
  void tighten_upper() {
    std::vector<double> bound = value_.upper;
    const Discount discount(discount_);
    if (mdp_.deterministic()) {
      std::vector<State> order;
      for (State s = 0; s < mdp_.states(); ++s) {
        if (!mdp_.terminal(s)) order.push_back(s);
      }
      if (!raise_until_inductive(mdp_, discount, order, bound)) return;
    } else {
      std::vector<double> mean(mdp_.states());
      for (State s = 0; s < mdp_.states(); ++s) mean[s] = middle(value_.lower[s], value_.upper[s]);
      bound = discount.none() ? undiscounted_upper(mean) : discounted_upper(mean);
    }
    for (State s = 0; s < mdp_.states(); ++s) upper_[s] = std::min(upper_[s], bound[s]);
  }

  // Deterministic models have bounds as tight as rounding allows, whoever solved them before.
  void solve_along_graph() {
    SolveSettings settings;
    settings.discount = discount_;
    const Result<Solution> exact = solve(mdp_, settings, "label-setting");
    if (!exact) return;
    for (State s = 0; s < mdp_.states(); ++s) {
      exact_lower_[s] = std::max(exact_lower_[s], exact->lower[s]);
      upper_[s] = std::min(upper_[s], exact->upper[s]);
    }
  }

  std::vector<double> discounted_upper(const std::vector<double>& value) const {
    std::vector<double> bound(mdp_.states(), 0.0);
    std::vector<Action> greedy(mdp_.states(), no_action);
    const Differences change =
        sweep_all(mdp_, discount_, Residual{value.data(), bound.data(), greedy.data()}, 1);
    double size = 0.0;
    for (const double v : value) size = std::max(size, std::fabs(v));
    for (const double v : bound) size = std::max(size, std::fabs(v));
    const SpanBounds more =
        span_bounds(ModelScale(mdp_), discount_, change.least, change.greatest, size);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s)) bound[s] = add_up(bound[s], more.upper);
    }
    return bound;
  }

  std::vector<double> undiscounted_upper(const std::vector<double>& value) const {
    const Ending ending = find_ending(mdp_);
    std::vector<Action> policy(policy_.begin(), policy_.end());
    for (State s = 0; s < mdp_.states(); ++s) {
      const bool usable = std::isfinite(value[s]) && policy[s] != no_action;
      if (ending.live[s] != 0 && !usable) return std::vector<double>(mdp_.states(), infinity);
    }
    return certify_total(mdp_, ending.live, policy, value).upper;
  }

  void measure_regret(std::span<const State> from) {
    std::vector<bool> begins(mdp_.states(), false);
    for (const State s : from) begins[s] = true;
    for (const State s : asked_) {
      const double loss = std::max(0.0, difference_up(upper_[s], value_.lower[s]));
      if (loss > out_.regret || s == asked_.front()) {
        out_.regret = loss;
        out_.worst = s;
      }
      if (begins[s]) out_.start_regret = std::max(out_.start_regret, loss);
      const double best = middle(exact_lower_[s], std::max(exact_lower_[s], upper_[s]));
      const double own = middle(value_.lower[s], value_.upper[s]);
      if (best == own || !(best > own)) continue;
      out_.regret_estimate = std::max(out_.regret_estimate, std::min(best - own, out_.regret));
    }
  }

  const Mdp& mdp_;
  std::vector<double> exact_lower_;  // of V*
  std::span<const Action> policy_;
  double discount_;
  std::vector<double> upper_;  // of V*
  bool along_graph_;           // the solution given is as tight as it gets
  std::vector<State> asked_;
  std::vector<bool> ends_;  // per state: the policy may end from here
  Evaluation value_;        // of the policy
  Optimality out_;
};

}  // namespace

Optimality judge(const Mdp& mdp, const Solution& exact, std::span<const Action> policy,
                 std::span<const State> from, double discount) {
  if (mdp.alternating()) return judge_game(mdp, exact, policy, from, discount);
  return Judge(mdp, exact, policy, discount).run(from);
}

double q_star(const Mdp& mdp, std::span<const double> value, std::uint64_t choice,
              double discount) {
  return backup(mdp, discount, value.data(), choice);
}

std::vector<Action> optimal_actions(const Mdp& mdp, const Solution& solution, State state) {
  return TiedActions(mdp, solution).of(state);
}

}  // namespace quoll
