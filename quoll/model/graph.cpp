#include "quoll/model/graph.hpp"

#include <numeric>

#include "quoll/model/path_search.hpp"

namespace quoll {

namespace {

// The states from which one move may lead to each state, each once, ends and the state itself left
// out as origins.
struct Predecessors {
  std::vector<std::uint64_t> begin;  // states + 1, and one spare place used while filling
  std::vector<State> from;

  explicit Predecessors(const Mdp& mdp) : begin(mdp.states() + 2, 0) {
    std::vector<State> last(mdp.states());  // the last origin seen for a state
    const auto for_each = [&mdp, &last](auto&& see) {
      std::iota(last.begin(), last.end(), State{0});
      for (State s = 0; s < mdp.states(); ++s) {
        if (mdp.terminal(s)) continue;
        const std::uint64_t end = mdp.outcome_begin(mdp.choice_end(s));
        for (std::uint64_t o = mdp.outcome_begin(mdp.choice_begin(s)); o < end; ++o) {
          const State to = mdp.next(o);
          if (to != s && last[to] != s) see(s, to);
          last[to] = s;
        }
      }
    };
    for_each([this](State, State to) { ++begin[to + 2]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    from.resize(begin.back());
    for_each([this](State s, State to) { from[begin[to + 1]++] = s; });
  }
};

}  // namespace

std::vector<std::uint32_t> moves_from(const Mdp& mdp, std::span<const State> from) {
  std::vector<std::uint32_t> moves(mdp.states(), unreached);
  std::vector<State> queue;
  for (const State s : from) {
    if (moves[s] == 0) continue;
    moves[s] = 0;
    queue.push_back(s);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const State s = queue[i];
    if (mdp.terminal(s)) continue;
    const std::uint64_t end = mdp.outcome_begin(mdp.choice_end(s));
    for (std::uint64_t o = mdp.outcome_begin(mdp.choice_begin(s)); o < end; ++o) {
      const State next = mdp.next(o);
      if (moves[next] != unreached) continue;
      moves[next] = moves[s] + 1;
      queue.push_back(next);
    }
  }
  return moves;
}

std::vector<std::uint32_t> moves_to_end(const Mdp& mdp) {
  std::vector<State> ends;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) ends.push_back(s);
  }
  return moves_to(mdp, ends);
}

std::vector<std::uint32_t> moves_to(const Mdp& mdp, std::span<const State> targets) {
  std::vector<std::uint32_t> moves(mdp.states(), unreached);
  std::vector<State> queue;
  for (const State s : targets) {
    if (moves[s] == 0) continue;
    moves[s] = 0;
    queue.push_back(s);
  }
  if (queue.empty()) return moves;
  const Predecessors before(mdp);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const State s = queue[i];
    for (std::uint64_t p = before.begin[s]; p < before.begin[s + 1]; ++p) {
      const State from = before.from[p];
      if (moves[from] != unreached) continue;
      moves[from] = moves[s] + 1;
      queue.push_back(from);
    }
  }
  return moves;
}

std::vector<bool> reachable(const Mdp& mdp, std::span<const State> from) {
  const std::vector<std::uint32_t> moves = moves_from(mdp, from);
  std::vector<bool> reached(moves.size());
  for (std::size_t s = 0; s < moves.size(); ++s) reached[s] = moves[s] != unreached;
  return reached;
}

std::vector<bool> can_end(const Mdp& mdp) {
  const std::vector<std::uint32_t> moves = moves_to_end(mdp);
  std::vector<bool> can(moves.size());
  for (std::size_t s = 0; s < moves.size(); ++s) can[s] = moves[s] != unreached;
  return can;
}

std::vector<std::uint32_t> strongly_connected(const Mdp& mdp, std::uint64_t most) {
  std::vector<std::uint32_t> component(mdp.states(), no_component);
  PathSearch search(mdp, [](std::uint64_t) { return true; }, component);
  search.stop_above(most);
  for (State s = 0; s < mdp.states() && !search.stopped(); ++s) search.visit(s);
  if (search.stopped()) component.clear();
  return component;
}

std::vector<State> returning_states(const Mdp& mdp) {
  const std::vector<std::uint32_t> component = strongly_connected(mdp);
  std::vector<std::uint32_t> size(mdp.states(), 0);
  for (const std::uint32_t k : component) ++size[k];
  std::vector<State> returning;
  for (State s = 0; s < mdp.states(); ++s) {
    bool again = size[component[s]] > 1;
    for (std::uint64_t c = mdp.choice_begin(s); !again && c < mdp.choice_end(s); ++c) {
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        again = again || mdp.next(o) == s;
      }
    }
    if (again && !mdp.terminal(s)) returning.push_back(s);
  }
  return returning;
}

}  // namespace quoll
