#include "quoll/verify/ending.hpp"

#include <cstdint>
#include <utility>

namespace quoll {
namespace {

struct Arrival {
  State from;
  Action action;
};

/// Which actions lead to each state, one entry per outcome; of a state's choices only those in the
/// range that `range(state)` gives, none of an end.
class Arrivals {
 public:
  template <class Range>
  Arrivals(const Mdp& mdp, Range range) : begin_(mdp.states() + 1, 0) {
    each(mdp, range, [&](Arrival, std::uint64_t o) { ++begin_[mdp.next(o) + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    list_.resize(begin_.back());
    std::vector<std::uint64_t> place(begin_.begin(), begin_.end() - 1);
    each(mdp, range, [&](Arrival a, std::uint64_t o) { list_[place[mdp.next(o)]++] = a; });
  }

  std::span<const Arrival> of(State to) const {
    return std::span(list_).subspan(begin_[to], begin_[to + 1] - begin_[to]);
  }

 private:
  template <class Range, class Visit>
  static void each(const Mdp& mdp, Range range, Visit visit) {
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      const auto [first, last] = range(s);
      for (std::uint64_t c = first; c < last; ++c) {
        const Arrival arrival{s, static_cast<Action>(c - mdp.choice_begin(s))};
        for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) visit(arrival, o);
      }
    }
  }

  std::vector<std::uint64_t> begin_;
  std::vector<Arrival> list_;
};

using Choices = std::pair<std::uint64_t, std::uint64_t>;

std::vector<State> ends_of(const Mdp& mdp, std::vector<bool>& found) {
  std::vector<State> queue;
  found.assign(mdp.states(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s)) continue;
    found[s] = true;
    queue.push_back(s);
  }
  return queue;
}

bool stays_in(const Mdp& mdp, const std::vector<bool>& inside, std::uint64_t choice) {
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    if (!inside[mdp.next(o)]) return false;
  }
  return true;
}

}  // namespace

std::vector<bool> policy_ends(const Mdp& mdp, std::span<const Action> policy,
                              const std::vector<bool>& claimed) {
  const Arrivals arrivals(mdp, [&](State s) -> Choices {
    if (!claimed[s]) return {0, 0};
    const std::uint64_t c = mdp.choice_begin(s) + policy[s];
    return {c, c + 1};
  });
  std::vector<bool> found;
  std::vector<State> queue = ends_of(mdp, found);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const auto& [from, action] : arrivals.of(queue[i])) {
      if (!found[from]) queue.push_back(from);
      found[from] = true;
    }
  }
  return found;
}

// What is left after taking away, again and again, the states all of whose successors are gone.
std::optional<State> returning(const Mdp& mdp) {
  const Arrivals arrivals(
      mdp, [&](State s) -> Choices { return {mdp.choice_begin(s), mdp.choice_end(s)}; });
  std::vector<bool> gone;
  std::vector<State> queue = ends_of(mdp, gone);
  std::vector<std::uint64_t> open(mdp.states(), 0);
  for (State s = 0; s < mdp.states(); ++s) {
    for (const Arrival& arrival : arrivals.of(s)) ++open[arrival.from];
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const auto& [from, action] : arrivals.of(queue[i])) {
      if (--open[from] > 0) continue;
      gone[from] = true;
      queue.push_back(from);
    }
  }
  for (State s = 0; s < mdp.states(); ++s) {
    if (!gone[s]) return s;
  }
  return std::nullopt;
}

std::vector<bool> some_policy_ends(const Mdp& mdp) {
  const Arrivals arrivals(
      mdp, [&](State s) -> Choices { return {mdp.choice_begin(s), mdp.choice_end(s)}; });
  std::vector<bool> inside(mdp.states(), true);
  for (;;) {
    std::vector<bool> found;
    std::vector<State> queue = ends_of(mdp, found);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const auto& [from, action] : arrivals.of(queue[i])) {
        if (found[from] || !stays_in(mdp, inside, mdp.choice_begin(from) + action)) continue;
        found[from] = true;
        queue.push_back(from);
      }
    }
    if (found == inside) return inside;
    inside = std::move(found);
  }
}

}  // namespace quoll
