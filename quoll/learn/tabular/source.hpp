#pragma once
// The three sources of experience of the tabular loop: a deterministic table, a stochastic table,
// and any Environment behind one virtual call. The tables are in env/table.hpp.

#include <cmath>
#include <cstdint>
#include <memory>

#include "quoll/act/start.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/env/table.hpp"

namespace quoll {

/// A packed table as a source: stateless, its draws are the loop's.
template <class Table>
struct TableSource {
  static constexpr bool rewards_known = true;
  Table table;

  /// What the loop holds in registers: the table's pointers.
  auto stepper() const {
    return [view = table.view()](std::uint64_t pair, State, Action, std::uint64_t draw) {
      return view.step(pair, draw);
    };
  }
  template <class Visits>
  State start(StartStates& starts, Rng& rng, const Visits& visits) {
    return starts.draw(rng, visits);
  }
  double largest_reward() const { return 0.0; }
  void persist(Archive&) {}
};

/// One lane of an Environment. Its own truncations are passed on.
class EnvironmentSource {
 public:
  static constexpr bool rewards_known = false;

  struct EnvironmentLanding {
    State next;
    double reward;
    bool terminated, truncated, turn_passes;
  };

  explicit EnvironmentSource(std::unique_ptr<Environment> environment)
      : environment_(std::move(environment)) {}

  auto stepper() {
    return [this](std::uint64_t, State state, Action action, std::uint64_t) {
      return step(state, action);
    };
  }
  EnvironmentLanding step(State state, Action action) {
    state_ = state;
    action_ = action;
    Experience now = columns();
    environment_->step(now);
    largest_ = std::fmax(largest_, std::fabs(feedback_.reward));
    return {next_, feedback_.reward, feedback_.terminated, feedback_.truncated,
            feedback_.turn_passes};
  }
  template <class Visits>
  State start(StartStates& starts, Rng& rng, const Visits& visits) {
    if (starts.kind() != StartStates::Kind::world) {
      state_ = starts.draw(rng, visits);
      environment_->set(0, state_);
      return state_;
    }
    const std::uint8_t restart = 1;
    Experience now = columns();
    environment_->restart({&restart, 1}, now);
    return state_;
  }
  double largest_reward() const { return largest_; }
  void persist(Archive& archive) {
    archive("largest_reward", largest_);
    environment_->persist(archive);
  }

 private:
  Experience columns() {
    return {{&state_, 1}, {&action_, 1}, {&feedback_, 1}, {&next_, 1}, {}, {}};
  }

  std::unique_ptr<Environment> environment_;
  State state_ = 0, next_ = 0;
  Action action_ = 0;
  Feedback feedback_;
  double largest_ = 0.0;
};

}  // namespace quoll
