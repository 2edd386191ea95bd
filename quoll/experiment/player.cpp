#include "quoll/experiment/player.hpp"

#include <charconv>

#include "quoll/base/text.hpp"

namespace quoll {

Player::Player(const World& world, Lanes lanes, double discount)
    : world_(world), discount_(discount) {
  lanes.count = 1;
  environment_ = world.make(lanes);
  const std::size_t floats = environment_->spaces().observation;
  observation_.resize(floats);
  next_observation_.resize(floats);
}

Experience Player::columns() {
  return {{&state_, 1}, {&action_, 1}, {&feedback_, 1},
          {&next_, 1},  observation_,  next_observation_};
}

void Player::see() {
  now_.number = state_;
  now_.state = environment_->inspector()->state(0, state_);
  now_.observation = environment_->inspector()->observation(0, state_);
}

void Player::restart() {
  now_ = {};
  factor_ = side_ = 1.0;
  const std::uint8_t one = 1;
  Experience now = columns();
  environment_->restart({&one, 1}, now);
  see();
}

Result<void> Player::restart(const Tree& state) {
  now_ = {};
  factor_ = side_ = 1.0;
  State at = state_;
  if (Result<void> done = environment_->inspector()->set(0, state, at); !done) return done;
  state_ = at;
  see();
  now_.terminated = actions() == 0 || rests();
  return {};
}

// Where actions are not counted by state, an end is known by what it does: nothing.
bool Player::rests() const {
  if (std::holds_alternative<std::string>(now_.state.value)) return false;
  Player twin(world_, Lanes(), discount_);
  Inspector& inspector = *twin.environment_->inspector();
  if (!inspector.set(0, now_.state, twin.state_)) return false;
  twin.step(0);
  return twin.now_.terminated && twin.now_.reward == 0.0 && twin.now_.state == now_.state;
}

void Player::step(Action action) {
  action_ = action;
  now_.action_name = action_name(action);
  Experience now = columns();
  environment_->step(now);
  state_ = next_;
  observation_ = next_observation_;
  ++now_.t;
  now_.action = action;
  now_.reward = feedback_.reward;
  now_.terminated = feedback_.terminated;
  now_.truncated = feedback_.truncated;
  now_.total += side_ * feedback_.reward;
  now_.discounted += factor_ * feedback_.reward;
  factor_ *= feedback_.turn_passes ? -discount_ : discount_;
  side_ = feedback_.turn_passes ? -side_ : side_;
  see();
}

Action Player::action_of(const Policy& policy) const {
  State state = state_;
  std::vector<float> observation = observation_;
  Experience now;
  now.state = {&state, 1};
  now.observation = observation;
  Action action = no_action;
  Rng none = stream(0, "behaviour");
  policy.act(now, {&action, 1}, {&none, 1});
  return action;
}

Action Player::actions() const {
  return environment_->spaces().states > 0 ? environment_->actions(state_)
                                           : environment_->spaces().actions;
}

std::string Player::action_name(Action action) const {
  if (world_.mdp && action < world_.mdp->actions(state_)) {
    return world_.mdp->action_name(world_.mdp->choice_begin(state_) + action);
  }
  return action < world_.action_names.size() ? world_.action_names[action] : std::to_string(action);
}

Result<Action> Player::find_action(std::string_view word) const {
  const Action count = actions();
  Nearest nearest(word);
  for (Action a = 0; a < count; ++a) {
    const std::string name = action_name(a);
    if (name == word) return a;
    nearest.offer(name);
  }
  Action number = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  if (read.ec == std::errc() && read.ptr == word.data() + word.size() && number < count) {
    return number;
  }
  std::string names;
  for (Action a = 0; a < count && a < 12; ++a) names += (a ? ", " : "") + action_name(a);
  if (count > 12) names += ", ...";
  return Error{"", 0, 0,
               count == 0 ? "no action: the episode is at its end"
                          : "an action (" + names + ") or its number from 0 expected, not '" +
                                std::string(word) + "'",
               nearest.best()};
}

std::string Player::text() const {
  return environment_->inspector()->text(0, state_);
}

Drawing Player::drawing() const {
  return environment_->inspector()->drawing(0, state_);
}

}  // namespace quoll
