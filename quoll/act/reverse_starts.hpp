#pragma once
// Starting near the goal and moving backwards: a curriculum made from experience alone. Florensa et
// al. 2017 ("Reverse curriculum generation"); McAleer et al. 2018 for the cube.
//
//   goal <- the end that gave the largest reward so far;  near <- {}
//   seen (s, r, s'): if s' is the goal, or s' is in near: near <- near + {s};
//                    a better end was met: near <- {s}
//   draw: with probability 1/10, or while near is empty: any state; else the state of near that was
//   visited least
//
// Only one goal has to be met; from then on episodes begin where the way to it is already known to
// exist, and the set grows backwards as episodes wander out of it and back.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/random.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

class ReverseStarts {
 public:
  ReverseStarts() = default;
  /// `all` = every state an episode may begin in.
  ReverseStarts(std::uint64_t states, std::span<const State> all)
      : all_(all.begin(), all.end()), member_(states) {}

  bool active() const { return !all_.empty(); }

  void observe(State state, State next, double reward, bool terminated) {
    if (terminated && reward > goal_) {
      goal_ = reward;
      for (const State s : near_) member_[s] = 0;
      near_.clear();
      cursor_ = 0;
    }
    if (member_[state] || !(terminated ? reward == goal_ : member_[next] != 0)) return;
    member_[state] = 1;
    near_.push_back(state);
  }

  /// One draw from `rng`. `visits(s)` = how often the actions of s were taken.
  template <class Visits>
  State draw(Rng& rng, const Visits& visits) {
    const std::uint64_t bits = rng.next();
    const auto low = static_cast<std::uint32_t>(bits);
    if (near_.empty() || (bits >> 32) < (std::uint64_t{1} << 32) / 10) {
      return all_[scale(low, static_cast<std::uint32_t>(all_.size()))];
    }
    // The least visited of the next few in circular order: as good as the least, at constant cost.
    constexpr std::size_t looks = 8;
    State least = near_[cursor_ % near_.size()];
    for (std::size_t i = 1; i < looks; ++i) {
      const State s = near_[(cursor_ + i) % near_.size()];
      if (visits(s) < visits(least)) least = s;
    }
    cursor_ = (cursor_ + looks) % near_.size();
    return least;
  }

  void persist(Archive& archive) {
    archive("goal", goal_);
    archive("near", near_);
    archive("cursor", cursor_);
    if (archive.saving()) return;
    for (std::uint8_t& m : member_) m = 0;
    for (const State s : near_) {
      if (s >= member_.size()) {
        near_.clear();
        return archive.fail("a start that the world does not have");
      }
      member_[s] = 1;
    }
  }

 private:
  std::vector<State> all_, near_;
  std::vector<std::uint8_t> member_;
  double goal_ = -std::numeric_limits<double>::infinity();
  std::uint64_t cursor_ = 0;
};

}  // namespace quoll
