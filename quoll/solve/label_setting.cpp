#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/solve/fewest_moves.hpp"
#include "quoll/solve/functional_graph.hpp"
#include "quoll/solve/methods.hpp"

// Shortest paths for deterministic models. Dijkstra 1959; Bertsekas, Dynamic Programming and
// Optimal Control 1, section 2.3 (label correcting); the certificate is this project's own.
//
//   1  if the model has two rewards only and fewer moves win: d(s) = moves to an end (breadth
//   first);
//      pi(s) = first action with d(s') = d(s) - 1; if all can end, steps 4 and 5 once for each d
//   2  else if no move gains (r <= 0): take states by falling label V from the ends backwards;
//      V(p) <- max(V(p), r + g V(s)) for each move p -> s                      (label setting)
//   3  else sweep to and fro: V(s) <- max_a r + g V(s'), from a lower bound    (label correcting)
//   4  V_pi exactly along the graph of pi; switch every action proved better; repeat until none is
//   5  raise U from V_pi until T U <= U with outward rounding: lower = V_pi, upper = U
//
// g: discount, V: label, d: moves, pi: solution.policy, U: solution.upper.

namespace quoll {

namespace {

// Moves by their target, for going backwards.
class Predecessors {
 public:
  struct Move {
    State from;
    Action action;
  };

  explicit Predecessors(const Mdp& mdp) : begin_(mdp.states() + 1, 0), moves_(mdp.choices()) {
    for (std::uint64_t c = 0; c < mdp.choices(); ++c) ++begin_[mdp.next(c) + 1];
    for (std::size_t s = 0; s < mdp.states(); ++s) begin_[s + 1] += begin_[s];
    std::vector<std::uint64_t> at(begin_.begin(), begin_.end() - 1);
    for (State s = 0; s < mdp.states(); ++s) {
      for (Action a = 0; a < mdp.actions(s); ++a) {
        moves_[at[mdp.next(mdp.choice_begin(s) + a)]++] = {s, a};
      }
    }
  }

  std::span<const Move> to(State s) const {
    return {moves_.data() + begin_[s], moves_.data() + begin_[s + 1]};
  }

 private:
  std::vector<std::uint64_t> begin_;
  std::vector<Move> moves_;
};

// Step 2. Among equal moves the first one to a state settled earlier is kept, so that the policy
// cannot go round in a circle that earns nothing.
class LabelSetting {
 public:
  LabelSetting(const Mdp& mdp, double discount)
      : mdp_(mdp),
        discount_(discount),
        before_(mdp),
        label_(mdp.states(), -infinity),
        rank_(mdp.states(), never) {}

  void run(const std::vector<std::uint8_t>& live, Solution& solution) {
    std::uint32_t settled = 0;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s)) continue;
      label_[s] = 0.0;
      rank_[s] = settled++;
      relax(s, live);
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      const auto [label, s] = queue_.back();
      queue_.pop_back();
      if (rank_[s] != never) continue;
      rank_[s] = settled++;
      solution.policy[s] = first_best(s);
      relax(s, live);
      ++solution.backups;
    }
  }

 private:
  using Entry = std::pair<double, State>;
  static bool later(const Entry& a, const Entry& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  }

  void relax(State s, const std::vector<std::uint8_t>& live) {
    for (const auto [from, action] : before_.to(s)) {
      if (live[from] == 0 || rank_[from] != never) continue;
      const double label = mdp_.reward(mdp_.choice_begin(from) + action) + discount_ * label_[s];
      if (!(label > label_[from])) continue;
      label_[from] = label;
      queue_.push_back({label, from});
      std::push_heap(queue_.begin(), queue_.end(), later);
    }
  }

  Action first_best(State s) const {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      const State next = mdp_.next(c);
      if (rank_[next] >= rank_[s]) continue;
      if (mdp_.reward(c) + discount_ * label_[next] == label_[s]) {
        return static_cast<Action>(c - mdp_.choice_begin(s));
      }
    }
    return 0;
  }

  const Mdp& mdp_;
  double discount_;
  Predecessors before_;
  std::vector<double> label_;
  std::vector<std::uint32_t> rank_;  // order of settling; never = not yet
  std::vector<Entry> queue_;
};

// Step 3. An action is taken over only when it is strictly better than what the state had: at
// discount 1 this keeps the policy free of circles, since none gains.
void correct_labels(const Mdp& mdp, const SolveSettings& settings, double discount,
                    const std::vector<std::uint8_t>& live, Solution& solution) {
  const double worst = std::min(0.0, mdp.reward_bounds().first);
  const double low = discount < 1.0 ? worst / (1.0 - discount) : -infinity;
  std::vector<double> value(mdp.states(), low);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) value[s] = 0.0;
  }
  const std::size_t states = mdp.states();
  const std::uint64_t limit =
      std::min<std::uint64_t>(settings.max_sweeps, discount < 1.0 ? 2000 : states + 1);
  for (std::uint64_t sweep = 0; sweep < limit; ++sweep) {
    bool changed = false;
    for (std::size_t i = 0; i < states; ++i) {
      const State s = static_cast<State>(sweep % 2 == 0 ? i : states - 1 - i);
      if (live[s] == 0) continue;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        const double q = mdp.reward(c) + discount * value[mdp.next(c)];
        if (!(q > value[s]) || q - value[s] <= 1e-12 * std::fabs(q)) continue;
        value[s] = q;
        solution.policy[s] = static_cast<Action>(c - mdp.choice_begin(s));
        changed = true;
      }
    }
    ++solution.sweeps;
    solution.backups += states;
    if (!changed || !may_continue(settings, solution, infinity)) break;
  }
}

bool no_move_gains(const Mdp& mdp) {
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (mdp.reward(c) > 0.0 && !mdp.terminal(mdp.next(c))) return false;
    }
  }
  return true;
}

class LabelSettingSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (!mdp.deterministic()) {
      return Error{"--method", 0, 0, "label-setting solves deterministic models only", ""};
    }
    if (*discount == 1.0) {
      if (auto error = undiscounted_error(mdp)) return *error;
    }
    Solution solution;
    solution.method = "label-setting";
    solution.policy.assign(mdp.states(), no_action);
    const std::optional<TwoRewards> rewards = two_rewards(mdp);
    const bool by_moves = rewards && fewer_moves_win(*rewards, Discount(*discount), false);
    if (by_moves && solve_by_moves(mdp, *rewards, Discount(*discount), solution)) {  // step 1
      solution.discount = *discount;
      conclude(mdp, solution, settings.width);
      return solution;
    }
    std::vector<std::uint8_t> live = live_states(mdp, *discount);
    const std::vector<bool> unknown = *discount == 1.0 ? unknown_states(mdp) : std::vector<bool>();
    for (std::size_t s = 0; s < unknown.size(); ++s) {
      if (unknown[s]) live[s] = 0;
    }
    if (!by_moves) {
      for (State s = 0; s < mdp.states(); ++s) {
        if (!mdp.terminal(s)) solution.policy[s] = 0;
      }
      if (no_move_gains(mdp)) {
        LabelSetting(mdp, *discount).run(live, solution);
      } else {
        correct_labels(mdp, settings, *discount, live, solution);
      }
    }
    improve_to_optimum(mdp, settings, *discount, live, solution);
    leave_unknown(mdp, unknown, settings.width, solution);
    return solution;
  }
};

}  // namespace

std::unique_ptr<Solver> make_label_setting() {
  return std::make_unique<LabelSettingSolver>();
}

}  // namespace quoll
