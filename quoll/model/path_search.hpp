#pragma once
// Gabow 2000, "Path-based depth-first search for strong and biconnected components", section 2:
// strongly connected components in one depth-first search, here with a stack of its own for the
// calls so that a path of a million states is no danger. Unlike Tarjan's, it knows at any time
// which states of the path already form one component, so that a search for a large one can end
// early.
//
//   visit(v): index(v) := next number; push v on S and index(v) on B
//     for each edge v -> w:
//       1. w not numbered:                visit(w)
//       2. else w without a component:    pop B while its top > index(w)
//     3. top of B = index(v):             pop B, and S down to v: one component
//
//   index -> index_, S -> open_, B -> first_, stack of calls -> frames_

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
class PathSearch {
 public:
  /// Writes the number of each finished component into component[s]; states to be visited must
  /// stand at no_component.
  PathSearch(const Mdp& mdp, Use use, std::vector<std::uint32_t>& component)
      : mdp_(mdp), use_(std::move(use)), component_(component), index_(mdp.states(), 0) {}

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
      } else if (component_[next] == no_component) {
        join_since(index_[next]);  // step 2
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
    index_[s] = ++numbered_;
    first_.push_back({numbered_, open_.size()});
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

  // What is open since the state of that index is one component.
  void join_since(std::uint32_t index) {
    while (first_.back().index > index) first_.pop_back();
    stopped_ = open_.size() - first_.back().place > most_;
  }

  void leave(State s) {
    frames_.pop_back();
    if (first_.back().index != index_[s]) return;
    const std::size_t place = first_.back().place;  // step 3
    first_.pop_back();
    for (std::size_t i = place; i < open_.size(); ++i) component_[open_[i]] = count_;
    open_.resize(place);
    ++count_;
  }

  struct First {
    std::uint32_t index;
    std::size_t place;  // in open_
  };

  const Mdp& mdp_;
  Use use_;
  std::vector<std::uint32_t>& component_;
  std::vector<std::uint32_t> index_;
  std::vector<State> open_;
  std::vector<First> first_;  // states of each component of the path
  std::vector<Frame> frames_;
  std::uint32_t numbered_ = 0;
  std::uint32_t count_ = 0;
  std::uint64_t most_ = max_states;
  bool stopped_ = false;
};

}  // namespace quoll
