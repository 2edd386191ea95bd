#pragma once
// Lanes of a world that are walked together by a learner that knows no table: what is seen, the
// episodes that end, and what continuing needs.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/learn/finished_episode.hpp"
#include "quoll/learn/learner.hpp"
#include "quoll/learn/settings.hpp"

namespace quoll {

/// One round is: write actions(), step(), learn from now(), go_on(). Nothing is allocated in a
/// round but for the list of finished episodes. Lane i depends on (seed, i) and its actions alone.
class Walkers {
 public:
  /// `count` lanes of the setup's world, each at the beginning of an episode.
  Walkers(const LearnSetup& setup, std::uint32_t count);
  Walkers(const Walkers&) = delete;
  Walkers& operator=(const Walkers&) = delete;

  const Spaces& spaces() const { return spaces_; }
  std::uint32_t count() const { return count_; }

  /// State and observation of each lane before its action; after step() also feedback, next and
  /// next_observation, of ended episodes too.
  const Experience& now() const { return now_; }
  /// Where the learner writes what each lane does: below actions_now(lane).
  std::span<Action> actions() { return now_.action; }

  /// One step of every lane; counts steps, returns and episodes.
  void step();
  /// What was next is now; lanes that are over begin anew. Once after each step().
  void go_on();

  /// Number of actions where the lane is. In an end, where an episode may begin, any action does
  /// nothing, and all are told.
  Action actions_now(std::size_t lane) const { return actions_of(now_.state[lane]); }
  /// The same for where it came to.
  Action actions_next(std::size_t lane) const { return actions_of(now_.next[lane]); }
  /// The same for any numbered state.
  Action actions_of(State state) const {
    return counts_.empty() ? spaces_.actions : counts_[state];
  }

  /// Whether an episode ends where it comes to a numbered state.
  bool ends_in(State state) const { return environment_->actions(state) == 0; }

  /// Steps of all lanes, episodes and returns since the beginning.
  const LearnProgress& progress() const { return progress_; }
  /// The episodes that ended since forget_finished(), in order of their steps.
  std::span<const FinishedEpisode> finished() const { return finished_; }
  void forget_finished() { finished_.clear(); }

  /// Between go_on() and step() only.
  void persist(Archive& archive);

 private:
  void end_episode(std::size_t lane);
  void show();

  std::unique_ptr<Environment> environment_;
  Spaces spaces_;
  std::uint32_t count_;
  std::vector<State> state_, next_;
  std::vector<Action> action_;
  std::vector<Feedback> feedback_;
  std::vector<float> observation_, next_observation_;
  Experience now_;
  std::vector<Action> counts_;  // actions per state; empty = as many everywhere
  LearnProgress progress_;
  std::vector<double> totals_;        // of the open episode of each lane
  std::vector<std::uint64_t> begun_;  // rounds before that episode
  std::uint64_t rounds_ = 0;
  std::vector<FinishedEpisode> finished_;
};

}  // namespace quoll
