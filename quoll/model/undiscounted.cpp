// Is total reward without discounting defined? Two things can prevent it: a state from which no end
// can be reached, and a cycle that earns for ever.
//
// Positive cycles of a deterministic model: Bellman 1958, "On a routing problem", as longest paths,
// with sweeps in alternating order (Yen 1970); a cycle of best predecessors is a positive cycle
// (Cherkassky, Goldberg 1999, "Negative-cycle detection algorithms", section 2).
//
//   for each strongly connected component that holds a positive reward:
//     1. d(v) := 0, parent(v) := none, for all its states
//     2. scan the states whose d has grown, in ascending, next time in descending order:
//        for each move v -> w with reward r inside the component:
//          d(v) + r > d(w):  d(w) := d(v) + r, parent(w) := v
//     3. parents form a cycle: report it;  no d has grown: there is none;  else repeat 2
//
//   d -> value_, parent -> parent_, "has grown" -> grown_

#include <algorithm>
#include <cmath>

#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

constexpr double rounding = 1e-12;
constexpr State nobody = std::numeric_limits<State>::max();

class PositiveCycle {
 public:
  PositiveCycle(const Mdp& mdp, std::vector<std::uint32_t> component)
      : mdp_(mdp),
        component_(std::move(component)),
        value_(mdp.states(), 0.0),
        parent_(mdp.states(), nobody),
        walk_(mdp.states(), 0),
        grown_(mdp.states(), true) {}

  /// One positive cycle within the component of these states, in the order of its moves; or
  /// nothing.
  std::vector<State> find(std::span<const State> members) {
    largest_ = 0.0;
    for (const State s : members) {
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        largest_ = std::max(largest_, std::fabs(mdp_.reward(c)));
      }
    }
    for (bool ascending = true;; ascending = !ascending) {
      bool changed = false;
      for (std::size_t i = 0; i < members.size(); ++i) {
        const State s = members[ascending ? i : members.size() - 1 - i];
        if (grown_[s]) changed = scan(s) || changed;
      }
      if (!changed) return {};
      std::vector<State> cycle = parent_cycle(members);
      if (!cycle.empty()) return cycle;
    }
  }

 private:
  // Step 2 for one state. A gain that could be rounding is none.
  bool scan(State s) {
    grown_[s] = false;
    bool changed = false;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      const State next = mdp_.next(c);
      if (component_[next] != component_[s]) continue;
      const double value = value_[s] + mdp_.reward(c);
      const double scale = std::max({largest_, std::fabs(value), std::fabs(value_[s])});
      if (!(value - value_[next] > rounding * scale)) continue;
      value_[next] = value;
      parent_[next] = s;
      grown_[next] = true;
      changed = true;
    }
    return changed;
  }

  // Step 3: each state is walked over once, towards its ancestors.
  std::vector<State> parent_cycle(std::span<const State> members) {
    for (const State s : members) walk_[s] = 0;
    std::uint32_t walk = 0;
    for (const State first : members) {
      ++walk;
      State s = first;
      while (s != nobody && walk_[s] == 0) {
        walk_[s] = walk;
        s = parent_[s];
      }
      if (s != nobody && walk_[s] == walk) return cycle_through(s);
    }
    return {};
  }

  std::vector<State> cycle_through(State s) const {
    std::vector<State> cycle;
    State member = s;
    do {
      cycle.push_back(member);
      member = parent_[member];
    } while (member != s);
    std::reverse(cycle.begin(), cycle.end());
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    return cycle;
  }

  const Mdp& mdp_;
  std::vector<std::uint32_t> component_;
  std::vector<double> value_;
  std::vector<State> parent_;
  std::vector<std::uint32_t> walk_;  // the last walk over ancestors that passed here
  std::vector<bool> grown_;
  double largest_ = 0.0;
};

bool can_gain(const Mdp& mdp, const std::vector<bool>& reached) {
  for (State s = 0; s < mdp.states(); ++s) {
    if (!reached[s] || mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (mdp.reward(c) > 0.0) return true;
    }
  }
  return false;
}

// Calls found(members, cycle) for each strongly connected component that has a positive cycle,
// until it returns false.
template <class Found>
void for_each_gaining(const Mdp& mdp, const std::vector<bool>& reached, Found found) {
  std::vector<std::uint32_t> component = strongly_connected(mdp);
  std::vector<bool> gains(mdp.states(), false);  // per component
  for (State s = 0; s < mdp.states(); ++s) {
    if (!reached[s] || mdp.terminal(s)) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (mdp.reward(c) > 0.0 && component[mdp.next(c)] == component[s]) gains[component[s]] = true;
    }
  }
  std::vector<State> states;  // of components that gain, component after component
  for (State s = 0; s < mdp.states(); ++s) {
    if (gains[component[s]]) states.push_back(s);
  }
  std::stable_sort(states.begin(), states.end(),
                   [&](State a, State b) { return component[a] < component[b]; });
  PositiveCycle search(mdp, component);
  for (std::size_t begin = 0, end = 0; begin < states.size(); begin = end) {
    while (end < states.size() && component[states[end]] == component[states[begin]]) ++end;
    const auto members = std::span(states).subspan(begin, end - begin);
    std::vector<State> cycle = search.find(members);
    if (!cycle.empty() && !found(members, std::move(cycle))) return;
  }
}

std::vector<State> gaining_cycle(const Mdp& mdp, const std::vector<bool>& reached) {
  std::vector<State> first;
  for_each_gaining(mdp, reached, [&](std::span<const State>, std::vector<State> cycle) {
    first = std::move(cycle);
    return false;
  });
  return first;
}

EndComponents reached_components(const Mdp& mdp, const std::vector<bool>& reached) {
  std::vector<bool> allowed(mdp.choices(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) allowed[c] = reached[s];
  }
  return maximal_end_components(mdp, allowed);
}

// Marks all states that can come to a marked one.
void spread_backward(const Mdp& mdp, std::vector<bool>& marked) {
  bool backward = true;
  for (bool changed = true; changed; backward = !backward) {
    changed = false;
    for (std::size_t i = 0; i < mdp.states(); ++i) {
      const State s = static_cast<State>(backward ? mdp.states() - 1 - i : i);
      if (marked[s] || mdp.terminal(s)) continue;
      const std::uint64_t end = mdp.outcome_begin(mdp.choice_end(s));
      for (std::uint64_t o = mdp.outcome_begin(mdp.choice_begin(s)); o < end; ++o) {
        if (!marked[mdp.next(o)]) continue;
        marked[s] = changed = true;
        break;
      }
    }
  }
}

// What choices that never lose can stay in gains at once if one of them does: no sweeps needed.
std::vector<State> lossless_component(const Mdp& mdp, const std::vector<bool>& reached) {
  std::vector<bool> allowed(mdp.choices(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      allowed[c] = reached[s] && mdp.reward(c) >= 0.0;
    }
  }
  const EndComponents parts = maximal_end_components(mdp, allowed);
  std::uint32_t gaining = no_component;
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (parts.inside[c] && mdp.reward(c) > 0.0) gaining = std::min(gaining, parts.component[s]);
    }
  }
  std::vector<State> states;
  if (gaining == no_component) return states;
  for (State s = 0; s < mdp.states(); ++s) {
    if (parts.component[s] == gaining) states.push_back(s);
  }
  return states;
}

std::vector<State> gaining_states(const Mdp& mdp, const std::vector<bool>& reached) {
  if (mdp.deterministic()) return gaining_cycle(mdp, reached);
  std::vector<State> states = lossless_component(mdp, reached);
  if (states.empty()) states = gaining_class(mdp, reached_components(mdp, reached));
  return states;
}

}  // namespace

UndiscountedFault undiscounted_fault(const Mdp& mdp) {
  const std::vector<bool> reached = reachable(mdp, mdp.start());
  UndiscountedFault fault;
  const std::vector<bool> ending = can_end(mdp);
  for (State s = 0; s < mdp.states(); ++s) {
    if (reached[s] && !ending[s]) fault.states.push_back(s);
  }
  if (!fault.states.empty()) {
    fault.kind = UndiscountedFault::Kind::no_end;
    return fault;
  }
  if (mdp.alternating()) {
    for (const State s : returning_states(mdp)) {
      if (reached[s]) fault.states.push_back(s);
    }
    if (!fault.states.empty()) fault.kind = UndiscountedFault::Kind::returning;
    return fault;
  }
  if (!can_gain(mdp, reached)) return fault;
  fault.states = gaining_states(mdp, reached);
  if (!fault.states.empty()) fault.kind = UndiscountedFault::Kind::gaining_cycle;
  return fault;
}

std::vector<bool> may_gain_for_ever(const Mdp& mdp) {
  const std::vector<bool> all(mdp.states(), true);
  std::vector<bool> marked(mdp.states(), false);
  if (!can_gain(mdp, all)) return marked;
  if (mdp.deterministic()) {
    for_each_gaining(mdp, all, [&](std::span<const State> members, std::vector<State>) {
      for (const State s : members) marked[s] = true;
      return true;
    });
  } else {
    const EndComponents parts = maximal_end_components(mdp);
    const std::vector<Gain> gains = component_gains(mdp, parts);
    for (State s = 0; s < mdp.states(); ++s) {
      const std::uint32_t k = parts.component[s];
      marked[s] = k != no_component && gains[k] != Gain::none;
    }
  }
  spread_backward(mdp, marked);
  return marked;
}

}  // namespace quoll
