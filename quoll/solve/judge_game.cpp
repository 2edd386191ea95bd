#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/solve/backward.hpp"
#include "quoll/solve/both_sides.hpp"
#include "quoll/solve/solver.hpp"

// What a policy is sure to get in a game of two: its player keeps to it, the other replies best.
//
//   G(s) = r(s, pi(s)) - g E B(s')             the player of the policy to move
//   B(s) = max_a  r(s,a) - g E G(s')           the other one to move
//
// From the ends on where no state comes again; else, below discount 1, as the other one's own
// decision problem (both_sides.hpp).
//
// pi is optimal where G = V*: exactly if it takes a maximiser in every state.

namespace quoll {

namespace {

constexpr double tolerance = 1e-9;  // relative loss that still counts as optimal

double middle(double lower, double upper) {
  return lower == upper ? lower : lower + 0.5 * (upper - lower);
}

// G of the policy; where it knows no action, any may be taken.
Bounds sure_value(const Mdp& mdp, const std::vector<State>& order, std::span<const Action> policy,
                  double discount) {
  const Discount factor(discount);
  Bounds sure(mdp), reply(mdp);
  for (const State s : order) {
    reply.lower[s] = reply.upper[s] = -infinity;
    sure.lower[s] = infinity;
    sure.upper[s] = -infinity;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      reply.lower[s] = std::max(reply.lower[s], q_lower(mdp, c, factor, sure));
      reply.upper[s] = std::max(reply.upper[s], q_upper(mdp, c, factor, sure));
      if (policy[s] != no_action && c != mdp.choice_begin(s) + policy[s]) continue;
      sure.lower[s] = std::min(sure.lower[s], q_lower(mdp, c, factor, reply));
      sure.upper[s] = std::max(sure.upper[s], q_upper(mdp, c, factor, reply));
    }
  }
  return sure;
}

// The same where states come again.
Result<Bounds> sure_value(const Mdp& mdp, std::span<const Action> policy, double discount) {
  const Result<Mdp> sides = both_sides(mdp, policy);
  if (!sides) return sides.error();
  SolveSettings settings;
  settings.width = 1e-12;
  settings.discount = discount;
  const Result<Solution> replies = solve(*sides, settings);
  if (!replies) return replies.error();
  Bounds sure(mdp);
  for (State s = 0; s < mdp.states(); ++s) {
    sure.lower[s] = -replies->upper[mdp.states() + s] + 0.0;
    sure.upper[s] = -replies->lower[mdp.states() + s] + 0.0;
  }
  return sure;
}

// Both measured in one state.
struct Compared {
  double lower, upper;  // of V*
  double sure_lower, sure_upper;

  double loss() const { return upper == sure_lower ? 0.0 : add_up(upper, -sure_lower); }
  double allowed() const {
    if (lower <= 0.0 && upper >= 0.0) return 0.0;
    return tolerance * std::min(std::fabs(lower), std::fabs(upper));
  }
  bool surely_lost() const {
    const double size = std::max(std::fabs(lower), std::fabs(upper));
    return -add_up(-lower, sure_upper) > tolerance * size;
  }
};

void decide(const Mdp& mdp, std::span<const Action> policy, const std::vector<State>& asked,
            const std::vector<Compared>& compared, Optimality& out) {
  for (const State s : asked) {
    if (policy[s] != no_action) continue;
    out.optimal = false;
    out.proof = "no action is known in state " + mdp.state_name(s);
    return;
  }
  bool exact = true, open = false;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Compared& one = compared[i];
    if (one.surely_lost()) {
      out.optimal = false;
      out.proof = "more is sure by another action from " + mdp.state_name(asked[i]);
      return;
    }
    exact = exact && one.loss() == 0.0;
    if (one.loss() <= one.allowed() || open) continue;
    open = true;
    out.proof = "in state " + mdp.state_name(asked[i]) + " the bounds leave a loss of up to " +
                shortest(one.loss());
  }
  if (open) return;
  out.optimal = true;
  out.proof = exact ? "exact: against best replies the policy gets the optimal value in every state"
                    : "certified: the loss against best replies is at most 1e-9 of |V*| in every "
                      "state";
}

}  // namespace

Optimality judge_game(const Mdp& mdp, const Solution& exact, std::span<const Action> policy,
                      std::span<const State> from, double discount) {
  Optimality out;
  const std::vector<bool> reached = reachable(mdp, from);
  std::vector<State> asked;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    if (reached[s]) {
      asked.push_back(s);
    } else {
      ++out.unreachable;
    }
  }
  const Result<std::vector<State>> order = backward_order(mdp);
  const Result<Bounds> sure = order            ? sure_value(mdp, *order, policy, discount)
                              : discount < 1.0 ? sure_value(mdp, policy, discount)
                                               : Result<Bounds>(order.error());
  if (!sure) {
    out.proof = message(sure.error());
    out.regret = out.start_regret = infinity;
    return out;
  }
  std::vector<bool> begins(mdp.states(), false);
  for (const State s : from) begins[s] = true;
  std::vector<Compared> compared;
  for (const State s : asked) {
    const Compared one{exact.lower[s], exact.upper[s], sure->lower[s], sure->upper[s]};
    compared.push_back(one);
    const double loss = std::max(0.0, one.loss());
    if (loss > out.regret || s == asked.front()) {
      out.regret = loss;
      out.worst = s;
    }
    if (begins[s]) out.start_regret = std::max(out.start_regret, loss);
    const double estimate = middle(one.lower, one.upper) - middle(one.sure_lower, one.sure_upper);
    out.regret_estimate = std::max(out.regret_estimate, std::min(estimate, loss));
  }
  decide(mdp, policy, asked, compared, out);
  return out;
}

}  // namespace quoll
