#include "quoll/solve/ending.hpp"

#include <cstddef>
#include <utility>

#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

class Search {
 public:
  explicit Search(const Mdp& mdp) : mdp_(mdp), moves_(moves_to_end(mdp)) {
    out_.live.assign(mdp.states(), 0);
    out_.policy.assign(mdp.states(), no_action);
    for (State s = 0; s < mdp.states(); ++s) {
      if (mdp.terminal(s)) continue;
      out_.live[s] = moves_[s] != unreached ? 1 : 0;
      out_.policy[s] = 0;
    }
  }

  Ending run() {
    if (mdp_.deterministic() || closed()) {
      for (State s = 0; s < mdp_.states(); ++s) {
        if (out_.live[s] != 0) out_.policy[s] = nearing(s);
      }
    } else {
      while (drop_unsure()) {
      }
    }
    return std::move(out_);
  }

 private:
  bool good(State s) const { return out_.live[s] != 0 || mdp_.terminal(s); }

  // Whether all outcomes of a choice are live or ends.
  bool safe(std::uint64_t c) const {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (!good(mdp_.next(o))) return false;
    }
    return true;
  }

  // No choice leads out of the live states: then going nearer with positive probability suffices.
  bool closed() const {
    for (State s = 0; s < mdp_.states(); ++s) {
      if (out_.live[s] == 0) continue;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (!safe(c)) return false;
      }
    }
    return true;
  }

  // The first action that brings an end nearer by most on average, among those that may do so: one
  // that does it only by a slip can take for ever in practice.
  Action nearing(State s) const {
    Action best = 0;
    double best_moves = 0.0;
    bool found = false;
    for (Action a = 0; a < mdp_.actions(s); ++a) {
      const std::uint64_t c = mdp_.choice_begin(s) + a;
      double moves = 0.0;
      bool nearer = false;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        moves += mdp_.probability(o) * moves_[mdp_.next(o)];
        nearer = nearer || moves_[mdp_.next(o)] < moves_[s];
      }
      if (!nearer || (found && moves >= best_moves)) continue;
      best = a;
      best_moves = moves;
      found = true;
    }
    return best;
  }

  // Drops live states that cannot reach an end by safe choices; true if any was dropped.
  bool drop_unsure() {
    const std::size_t states = mdp_.states();
    std::vector<bool> reaches(states);
    for (std::size_t s = 0; s < states; ++s) reaches[s] = mdp_.terminal(static_cast<State>(s));
    bool backward = true;
    for (bool grown = true; grown; backward = !backward) {
      grown = false;
      for (std::size_t i = 0; i < states; ++i) {
        const State s = static_cast<State>(backward ? states - 1 - i : i);
        if (out_.live[s] == 0 || reaches[s] || !advance(s, reaches)) continue;
        reaches[s] = true;
        grown = true;
      }
    }
    bool dropped = false;
    for (std::size_t s = 0; s < states; ++s) {
      if (out_.live[s] == 0 || reaches[s]) continue;
      out_.live[s] = 0;
      out_.policy[s] = 0;
      dropped = true;
    }
    return dropped;
  }

  // Sets the policy of s to a safe choice that may lead to a state that reaches an end.
  bool advance(State s, const std::vector<bool>& reaches) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      bool hits = false;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        hits = hits || reaches[mdp_.next(o)];
      }
      if (!hits || !safe(c)) continue;
      out_.policy[s] = static_cast<Action>(c - mdp_.choice_begin(s));
      return true;
    }
    return false;
  }

  const Mdp& mdp_;
  std::vector<std::uint32_t> moves_;
  Ending out_;
};

}  // namespace

Ending find_ending(const Mdp& mdp) {
  return Search(mdp).run();
}

}  // namespace quoll
