#pragma once
// One lane of a world played step by step, with everything a person may want to see of each step.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/act/policy.hpp"
#include "quoll/base/tree.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

/// A moment of an episode: after `action`, or its beginning (t = 0, no action).
struct Moment {
  std::uint64_t t = 0;
  Tree state, observation;
  State number = 0;  ///< of worlds whose states are numbered
  std::optional<Action> action;
  std::string action_name;
  double reward = 0.0;
  bool terminated = false, truncated = false;
  double total = 0.0, discounted = 0.0;  ///< returns so far, of the player who moved first

  bool over() const { return terminated || truncated; }
};

class Player {
 public:
  /// `lanes.count` is taken as 1.
  Player(const World& world, Lanes lanes, double discount);

  /// Begins an episode where the world does.
  void restart();
  /// Begins an episode in a state given as data, or the name or number of a state. Error: what does
  /// not fit.
  Result<void> restart(const Tree& state);
  /// Takes an action below actions().
  void step(Action action);

  const Moment& now() const { return now_; }
  /// What a policy that draws nothing does now; no_action where it knows nothing.
  Action action_of(const Policy& policy) const;
  /// Number of actions in the present state.
  Action actions() const;
  std::string action_name(Action action) const;
  /// The action of the present state that a word names, by name or number.
  Result<Action> find_action(std::string_view word) const;
  /// Lines for people; empty when the world has no text form.
  std::string text() const;
  Drawing drawing() const;
  /// False once the draws given by `lanes` were used up or did not fit.
  bool draws_left() const { return environment_->inspector()->draws_left(); }
  const Environment& environment() const { return *environment_; }

 private:
  Experience columns();
  void see();
  bool rests() const;

  const World& world_;
  std::unique_ptr<Environment> environment_;
  double discount_, factor_ = 1.0, side_ = 1.0;  // of the next reward
  Moment now_;
  State state_ = 0, next_ = 0;
  Action action_ = 0;
  Feedback feedback_;
  std::vector<float> observation_, next_observation_;
};

}  // namespace quoll
