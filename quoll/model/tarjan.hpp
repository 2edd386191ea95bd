#pragma once
// Tarjan 1972, "Depth-first search and linear graph algorithms", section 4: strongly connected
// components in one depth-first search, here with a stack of its own so that a path of a million
// states is no danger.
//
//   visit(v): index(v) := low(v) := next number; push v
//     for each edge v -> w:
//       1. w not numbered:         visit(w); low(v) := min(low(v), low(w))
//       2. else w without a component: low(v) := min(low(v), index(w))
//     3. low(v) = index(v):        pop down to v: one component
//
//   index -> index_, low -> low_, stack of vertices -> open_, stack of calls -> frames_

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "quoll/model/graph.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// Components of the graph whose edges are the outcomes of the choices c with use(c). Ends have
/// none.
template <class Use>
class Tarjan {
 public:
  /// Writes the number of each finished component into component[s]; states to be visited must
  /// stand at no_component.
  Tarjan(const Mdp& mdp, Use use, std::vector<std::uint32_t>& component)
      : mdp_(mdp),
        use_(std::move(use)),
        component_(component),
        index_(mdp.states(), 0),
        low_(mdp.states(), 0) {}

  /// Gives up as soon as a component is known to have more states than that.
  void stop_above(std::uint64_t states) { most_ = states; }
  bool stopped() const { return stopped_; }

  /// Finishes all components that can be reached from `root`.
  void visit(State root) {
    if (index_[root] != 0) return;
    enter(root);
    while (!frames_.empty() && !stopped_) {
      Frame& frame = frames_.back();
      State next = 0;
      if (!next_edge(frame, next)) {
        leave(frame.state);
      } else if (index_[next] == 0) {
        enter(next);  // step 1
      } else if (component_[next] == no_component && index_[next] < low_[frame.state]) {
        low_[frame.state] = index_[next];  // step 2
        stopped_ = frames_.size() > most_ && path_since(index_[next]) > most_;
      }
    }
  }

  /// Forgets a state, so that it can be visited again.
  void forget(State s) {
    index_[s] = 0;
    component_[s] = no_component;
  }
  /// Starts numbering states anew; only when all that will be met are forgotten.
  void restart() { numbered_ = 0; }

  std::uint32_t count() const { return count_; }

 private:
  struct Frame {
    State state;
    std::uint64_t choice, outcome;  // the next edge to look at
  };

  void enter(State s) {
    index_[s] = low_[s] = ++numbered_;
    open_.push_back(s);
    const std::uint64_t first = mdp_.terminal(s) ? mdp_.choice_end(s) : mdp_.choice_begin(s);
    frames_.push_back({s, first, mdp_.outcome_begin(first)});
  }

  bool next_edge(Frame& frame, State& next) const {
    const std::uint64_t end = mdp_.choice_end(frame.state);
    for (; frame.choice < end; frame.outcome = mdp_.outcome_begin(++frame.choice)) {
      if (frame.outcome == mdp_.outcome_end(frame.choice) || !use_(frame.choice)) continue;
      next = mdp_.next(frame.outcome++);
      return true;
    }
    return false;
  }

  // The number of states on the path to the newest that were met at or after that index: if one
  // of index `first` follows the newest, they form one component.
  std::uint64_t path_since(std::uint32_t first) const {
    const auto earlier = [this](const Frame& frame, std::uint32_t index) {
      return index_[frame.state] < index;
    };
    const auto at = std::lower_bound(frames_.begin(), frames_.end(), first, earlier);
    return static_cast<std::uint64_t>(frames_.end() - at);
  }

  void leave(State s) {
    frames_.pop_back();
    if (!frames_.empty()) {
      std::uint32_t& low = low_[frames_.back().state];
      low = std::min(low, low_[s]);
    }
    if (low_[s] != index_[s]) return;
    State member = s;
    std::uint64_t size = 0;
    do {  // step 3
      member = open_.back();
      open_.pop_back();
      component_[member] = count_;
      ++size;
    } while (member != s);
    ++count_;
    stopped_ = stopped_ || size > most_;
  }

  const Mdp& mdp_;
  Use use_;
  std::vector<std::uint32_t>& component_;
  std::vector<std::uint32_t> index_, low_;
  std::vector<State> open_;
  std::vector<Frame> frames_;
  std::uint32_t numbered_ = 0;
  std::uint32_t count_ = 0;
  std::uint64_t most_ = max_states;
  bool stopped_ = false;
};

}  // namespace quoll
