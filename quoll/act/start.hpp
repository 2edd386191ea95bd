#pragma once
// Choosing the state an episode begins in: a value with a switch inside.

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

inline constexpr std::string_view start_names[] = {
    "world", "uniform", "fixed", "least-visited", "each-pair", "reverse", "widest-gap"};
inline constexpr std::string_view start_summaries[] = {
    "as the world itself begins",
    "every state that has actions with equal probability",
    "always the same state: fixed:STATE",
    "a state whose actions were tried least so far",
    "each state and action in turn, one step each unless --episode-steps says more",
    "near the best end met so far, and backwards from there",
    "where upper and lower bound of the value are furthest apart; methods that have both"};

/// Draws start states. All but `world` need a world that can be put into any state.
class StartStates {
 public:
  enum class Kind : std::uint8_t {
    world,
    uniform,
    fixed,
    least_visited,
    each_pair,
    reverse,
    widest_gap
  };

  StartStates() = default;
  /// From the distribution of a model, without the ends in it: an episode has at least one step.
  static StartStates world(const Mdp& mdp);
  /// Over the states that have actions and are not ends.
  static StartStates uniform(const Mdp& mdp);
  static StartStates fixed(State state);
  /// The first state, in circular order from the last one chosen, with no more visits than the
  /// least visited; constant time on average (see least_visited()).
  static StartStates least_visited(const Mdp& mdp);
  /// One of these states: as least_visited chooses (each_pair), or as choose_next() says (reverse,
  /// widest_gap), or with equal probability.
  static StartStates among(Kind kind, std::vector<State> states);

  Kind kind() const { return kind_; }
  /// What the next draw of `reverse` or `widest_gap` gives.
  void choose_next(State state) { chosen_ = state; }
  /// Every state this can give.
  std::span<const State> states() const { return states_; }

  /// The next start state. `visits(s)` = how often the actions of s were taken. Takes one draw from
  /// `rng` whatever the kind.
  template <class Visits>
  State draw(Rng& rng, const Visits& visits) {
    const std::uint64_t bits = rng.next();
    switch (kind_) {
      case Kind::least_visited:
      case Kind::each_pair:
        return least_visited(visits);
      case Kind::reverse:
      case Kind::widest_gap:
        return chosen_;
      case Kind::fixed:
        return states_[0];
      default:
        return sample(bits);
    }
  }

  template <class Archive>
  void persist(Archive& archive) {
    archive("cursor", cursor_);
    archive("level", level_);
    archive("next_level", next_level_);
    if (cursor_ > states_.size()) {
      cursor_ = 0;
      archive.fail("a start beyond the states");
    }
  }

 private:
  State sample(std::uint64_t bits) const;

  // The cursor goes round the states; a state with at most `level_` visits is taken. A round
  // without one raises the level to the smallest count seen in it. Each round costs one look per
  // state and each raise means every state was visited once more, so the cost per episode is
  // constant on average.
  template <class Visits>
  State least_visited(const Visits& visits) {
    for (;;) {
      if (cursor_ == states_.size()) {
        cursor_ = 0;
        level_ = next_level_;
        next_level_ = ~std::uint64_t{0};
      }
      const State s = states_[cursor_++];
      const std::uint64_t count = visits(s);
      if (count <= level_) {
        next_level_ = std::min(next_level_, count + 1);
        return s;
      }
      next_level_ = std::min(next_level_, count);
    }
  }

  Kind kind_ = Kind::world;
  std::vector<State> states_;
  std::vector<double> cumulative_;  // empty = uniform
  State chosen_ = 0;
  std::uint64_t cursor_ = 0, level_ = 0, next_level_ = ~std::uint64_t{0};
};

}  // namespace quoll
