#include "quoll/solve/fewest_moves.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

// Bounds on the value of the states with so many fewest moves to an end.
struct ByMoves {
  std::vector<double> lower, upper;

  ByMoves(std::uint32_t most, const TwoRewards& rewards, const Discount& discount)
      : lower(most + std::size_t{1}, 0.0), upper(most + std::size_t{1}, 0.0) {
    for (std::size_t d = 1; d <= most; ++d) {
      const double reward = d == 1 ? rewards.end : rewards.move;
      lower[d] = backup_down(reward, discount, lower[d - 1]);
      upper[d] = backup_up(reward, discount, upper[d - 1]);
    }
  }

  // T upper <= upper: a move leads from d to d - 1 moves or more, and no such move promises more
  // than the one taken.
  bool inductive(const TwoRewards& rewards, const Discount& discount) const {
    double best = -infinity;  // of the moves to d - 1 moves or more, but not to an end
    for (std::size_t d = upper.size() - 1; d > 0; --d) {
      best = std::max(best, backup_up(rewards.move, discount, upper[d]));
      if (d + 1 < upper.size() && best > upper[d + 1]) return false;
    }
    return upper.size() == 1 || best <= upper[1];
  }
};

// The first action to a state with one move less.
Action nearer(const Mdp& mdp, const std::vector<std::uint32_t>& moves, State s) {
  if (moves[s] == unreached) return 0;
  std::uint64_t c = mdp.choice_begin(s);
  while (moves[mdp.next(c)] + 1 != moves[s]) ++c;
  return static_cast<Action>(c - mdp.choice_begin(s));
}

}  // namespace

std::optional<TwoRewards> two_rewards(const Mdp& mdp) {
  std::optional<double> move, end;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      std::optional<double>& kind = mdp.terminal(mdp.next(c)) ? end : move;
      if (!kind) kind = mdp.reward(c);
      if (*kind != mdp.reward(c)) return std::nullopt;
    }
  }
  const double only = move ? *move : 0.0;
  return TwoRewards{only, end ? *end : only};
}

// With d moves to the end, V(d) = m (1 - g^(d-1)) / (1 - g) + g^(d-1) e, and never ending is worth
// m / (1 - g): V falls with d if e (1 - g) > m. At discount 1, V(d) = m (d - 1) + e falls if m < 0.
bool fewer_moves_win(const TwoRewards& rewards, const Discount& discount, bool strictly) {
  const double move = Meant(rewards.move).upper;
  if (discount.none()) return strictly ? move < 0.0 : move <= 0.0;
  const double rest = 1.0 - (rewards.end >= 0.0 ? discount.upper : discount.lower);
  const double gain = rewards.end * rest;
  const double doubt = 4.0 * half_ulp * std::fabs(gain) + 1e-300;
  if (gain - doubt > move) return true;
  return !strictly && rewards.end == 0.0 && move <= 0.0;
}

bool solve_by_moves(const Mdp& mdp, const TwoRewards& rewards, const Discount& discount,
                    Solution& solution) {
  const std::vector<std::uint32_t> moves = moves_to_end(mdp);
  std::uint32_t most = 0;
  bool all_end = true;
  solution.policy.assign(mdp.states(), no_action);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    solution.policy[s] = nearer(mdp, moves, s);
    all_end = all_end && moves[s] != unreached;
    most = std::max(most, moves[s]);
  }
  if (!all_end) return false;
  const ByMoves values(most, rewards, discount);
  if (!values.inductive(rewards, discount)) return false;
  solution.lower.resize(mdp.states());
  solution.upper.resize(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) {
    solution.lower[s] = values.lower[moves[s]];
    solution.upper[s] = values.upper[moves[s]];
    solution.backups += moves[s] > 0;
  }
  ++solution.sweeps;
  return true;
}

}  // namespace quoll
