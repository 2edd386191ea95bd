#include <algorithm>
#include <cmath>

#include "quoll/solve/optimality.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

namespace {

constexpr double tolerance = 1e-9;  // of |V*|: closer actions count as tied

double middle(const Solution& solution, State s) {
  const double lower = solution.lower[s];
  const double upper = solution.upper[s];
  return lower == upper ? lower : lower + 0.5 * (upper - lower);
}

}  // namespace

TiedActions::TiedActions(const Mdp& mdp, const Solution& solution)
    : mdp_(mdp), solution_(solution) {
  const auto [low, high] = mdp.reward_bounds();
  // Only circles that earn nothing keep the value, and those need rewards of 0 or of both signs.
  may_circle_ = solution.discount == 1.0 && low <= 0.0 && high >= 0.0;
}

std::vector<Action> TiedActions::of(State state) const {
  std::vector<Action> actions = tied(state);
  if (!may_circle_ || actions.size() < 2) return actions;
  if (circles_.component.empty()) {
    std::vector<bool> allowed(mdp_.choices(), false);
    for (State s = 0; s < mdp_.states(); ++s) {
      for (const Action a : tied(s)) allowed[mdp_.choice_begin(s) + a] = true;
    }
    circles_ = maximal_end_components(mdp_, allowed);
  }
  std::vector<Action> ending;
  for (const Action a : actions) {
    const std::uint64_t c = mdp_.choice_begin(state) + a;
    if (!circles_.inside[c] || leaves(state, c)) ending.push_back(a);
  }
  return ending.empty() ? actions : ending;
}

std::vector<Action> TiedActions::tied(State state) const {
  if (mdp_.terminal(state)) return {};
  std::vector<double> q;
  double best = -infinity;
  for (std::uint64_t c = mdp_.choice_begin(state); c < mdp_.choice_end(state); ++c) {
    double mean = 0.0;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      mean += mdp_.probability(o) * middle(solution_, mdp_.next(o));
    }
    q.push_back(mdp_.reward(c) + mdp_.carry(solution_.discount) * mean);
    best = std::max(best, q.back());
  }
  const double lower = solution_.lower[state];
  const double upper = solution_.upper[state];
  const double interval = upper == lower ? 0.0 : upper - lower;
  const double within = std::max(tolerance * std::fabs(middle(solution_, state)), interval);
  std::vector<Action> actions;
  for (Action a = 0; a < q.size(); ++a) {
    if (q[a] == best || q[a] >= best - within) actions.push_back(a);
  }
  return actions;
}

// Whether a circle is left by tied choices elsewhere than at `from`, where `choice` is always
// taken: a search from its outcomes that does not pass `from` again.
bool TiedActions::leaves(State from, std::uint64_t choice) const {
  std::vector<State> found;
  std::vector<bool> seen(mdp_.states(), false);
  seen[from] = true;
  const auto visit = [&](std::uint64_t c) {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (seen[mdp_.next(o)]) continue;
      seen[mdp_.next(o)] = true;
      found.push_back(mdp_.next(o));
    }
  };
  visit(choice);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const Action a : tied(found[i])) {
      const std::uint64_t c = mdp_.choice_begin(found[i]) + a;
      if (!circles_.inside[c]) return true;
      visit(c);
    }
  }
  return false;
}

}  // namespace quoll
