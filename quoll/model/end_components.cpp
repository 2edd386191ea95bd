// Maximal end components. de Alfaro 1997, "Formal verification of probabilistic systems",
// algorithm 3.1.
//
//   1. C := allowed choices of states that are not ends; a state without choices in C is removed,
//   and
//      with it every choice that may lead to it, until nothing changes
//   2. L := strongly connected components of the graph of C
//   3. from C remove each choice that may leave its component; remove states as in step 1
//   4. repeat 2 and 3 on the components that lost something; those that lost nothing are final
//
//   C -> inside, number of a state's choices in C -> kept, L -> component

#include <algorithm>
#include <numeric>

#include "quoll/model/path_search.hpp"

namespace quoll {

namespace {

class Splitting {
 public:
  Splitting(const Mdp& mdp, const std::vector<bool>& allowed)
      : mdp_(mdp), kept_(mdp.states(), 0), gone_(mdp.states(), false) {
    result_.component.assign(mdp.states(), no_component);
    result_.inside = allowed;
    if (allowed.empty()) result_.inside.assign(mdp.choices(), true);
    index_predecessors();
  }

  EndComponents run() {
    std::vector<State> work = first_states();  // step 1
    std::vector<bool>& inside = result_.inside;
    const auto use = [&inside](std::uint64_t c) { return inside[c]; };
    PathSearch search(mdp_, use, result_.component);
    while (!work.empty()) {
      for (const State s : work) search.forget(s);
      search.restart();
      for (const State s : work) search.visit(s);  // step 2
      changed_.assign(search.count(), false);
      for (const State s : work) {
        for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
          if (inside[c] && leaves(s, c)) drop(s, c);  // step 3
        }
      }
      remove_states();
      const auto done = [this](State s) {
        return gone_[s] || !changed_[result_.component[s]];  // step 4
      };
      work.erase(std::remove_if(work.begin(), work.end(), done), work.end());
    }
    number(search.count());
    return std::move(result_);
  }

 private:
  // Per state, the choices that may lead to it.
  void index_predecessors() {
    begin_.assign(mdp_.states() + 2, 0);
    for (std::uint64_t o = 0; o < mdp_.outcomes(); ++o) ++begin_[mdp_.next(o) + 2];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    before_.resize(mdp_.outcomes());
    for (std::uint64_t c = 0; c < mdp_.choices(); ++c) {
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        before_[begin_[mdp_.next(o) + 1]++] = c;
      }
    }
  }

  State state_of(std::uint64_t choice) const {
    const auto& begin = mdp_.arrays().choice_begin;
    return static_cast<State>(std::upper_bound(begin.begin(), begin.end(), choice) - begin.begin() -
                              1);
  }

  std::vector<State> first_states() {
    for (State s = 0; s < mdp_.states(); ++s) {
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (mdp_.terminal(s)) result_.inside[c] = false;
        kept_[s] += result_.inside[c];
      }
      if (kept_[s] == 0) going_.push_back(s);
    }
    remove_states();
    std::vector<State> states;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!gone_[s]) states.push_back(s);
    }
    return states;
  }

  bool leaves(State s, std::uint64_t c) const {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (result_.component[mdp_.next(o)] != result_.component[s]) return true;
    }
    return false;
  }

  void drop(State s, std::uint64_t c) {
    result_.inside[c] = false;
    if (--kept_[s] == 0) going_.push_back(s);
    if (result_.component[s] != no_component) changed_[result_.component[s]] = true;
  }

  void remove_states() {
    while (!going_.empty()) {
      const State s = going_.back();
      going_.pop_back();
      gone_[s] = true;
      for (std::uint64_t p = begin_[s]; p < begin_[s + 1]; ++p) {
        const std::uint64_t choice = before_[p];
        if (result_.inside[choice]) drop(state_of(choice), choice);
      }
    }
  }

  // Components get the numbers 0, 1, ... by their lowest state.
  void number(std::uint32_t labels) {
    std::vector<std::uint32_t> final(labels, no_component);
    for (State s = 0; s < mdp_.states(); ++s) {
      std::uint32_t& component = result_.component[s];
      if (gone_[s]) {
        component = no_component;
        continue;
      }
      if (final[component] == no_component) final[component] = result_.count++;
      component = final[component];
    }
  }

  const Mdp& mdp_;
  EndComponents result_;
  std::vector<std::uint64_t> begin_, before_;
  std::vector<Action> kept_;
  std::vector<bool> gone_, changed_;  // per state, per component
  std::vector<State> going_;          // states without choices, still to be removed
};

}  // namespace

EndComponents maximal_end_components(const Mdp& mdp, const std::vector<bool>& allowed_choice) {
  return Splitting(mdp, allowed_choice).run();
}

}  // namespace quoll
