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
  if (circles_.component.empty()) find_circles();
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

void TiedActions::find_circles() const {
  const State states = static_cast<State>(mdp_.states());
  tied_choice_.assign(mdp_.choices(), false);
  for (State s = 0; s < states; ++s) {
    for (const Action a : tied(s)) tied_choice_[mdp_.choice_begin(s) + a] = true;
  }
  circles_ = maximal_end_components(mdp_, tied_choice_);

  std::vector<std::uint64_t> begin(std::size_t{states} + 1);  // of the states before each
  std::vector<State> found;
  const auto each_move = [&](auto&& visit) {
    for (State s = 0; s < states; ++s) {
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (!circles_.inside[c]) continue;
        for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
          visit(s, mdp_.next(o));
        }
      }
    }
  };
  each_move([&](State, State next) { ++begin[next]; });
  std::uint64_t sum = 0;
  for (std::uint64_t& count : begin) count = sum += count;
  std::vector<State> before(sum);
  each_move([&](State s, State next) { before[--begin[next]] = s; });

  way_out_.assign(states, unreached);
  for (State s = 0; s < states; ++s) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (tied_choice_[c] && !circles_.inside[c]) way_out_[s] = 0;
    }
    if (way_out_[s] == 0) found.push_back(s);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::uint64_t j = begin[found[i]]; j < begin[std::size_t{found[i]} + 1]; ++j) {
      if (way_out_[before[j]] != unreached) continue;
      way_out_[before[j]] = way_out_[found[i]] + 1;
      found.push_back(before[j]);
    }
  }
  seen_in_.assign(states, 0);
}

// Whether a circle is left by tied choices elsewhere than at `from`, where `choice` is always
// taken: a search from its outcomes, the nearest to the way out first, that does not pass `from`
// again. From a state that is no farther from the way out than `from` is, the shortest way out does
// not pass `from`.
bool TiedActions::leaves(State from, std::uint64_t choice) const {
  std::vector<State> found;
  ++search_;
  seen_in_[from] = search_;
  const auto visit = [&](std::uint64_t c) {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      const State next = mdp_.next(o);
      if (seen_in_[next] == search_) continue;
      seen_in_[next] = search_;
      if (way_out_[next] != unreached && way_out_[next] <= way_out_[from]) return true;
      found.push_back(next);
    }
    return false;
  };
  const auto nearest_last = [&](std::size_t first) {
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
              [&](State a, State b) { return way_out_[a] > way_out_[b]; });
  };
  if (visit(choice)) return true;
  nearest_last(0);
  while (!found.empty()) {
    const State at = found.back();
    found.pop_back();
    const std::size_t first = found.size();
    for (std::uint64_t c = mdp_.choice_begin(at); c < mdp_.choice_end(at); ++c) {
      if (tied_choice_[c] && visit(c)) return true;
    }
    nearest_last(first);
  }
  return false;
}

}  // namespace quoll
