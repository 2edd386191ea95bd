#pragma once
// A plain struct with start and step becomes a world. The struct says what it offers (spaces),
// where an episode begins (start) and what an action does (step); batch() lifts it to an
// Environment.
//
//   struct Corridor {
//     using Position = int;                                            // any copyable type
//     quoll::Spaces spaces() const { return {.actions = 2, .states = 10}; }
//     Position start(auto& dice) const { return 0; }
//     quoll::Feedback step(Position& at, quoll::Action action, auto& dice) const { ... }
//     quoll::State number(const Position& at) const { return at; }    // if states > 0
//     void observe(const Position& at, std::span<float> x) const;     // if observation > 0
//   };
//
// It may have more:
//     Position position(quoll::State s) const;      // settable by number
//     quoll::Action actions(quoll::State s) const;  // fewer than spaces
//     std::vector<std::string> action_names() const;
//     std::string text(const Position& at) const;   // lines for people
//     quoll::Drawing drawing(const Position& at) const;
//     quoll::Tree observation(const Position& at) const;   // for people, if not what is above
//     std::vector<quoll::Measured> measured() const;       // what the observed numbers are
// What `dice` can do stands in env/dice.hpp. A Position that names its fields in a templated
// persist(auto& archive) shows and takes them by those names.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/env/dice.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/env/lane_dice.hpp"
#include "quoll/env/members.hpp"
#include "quoll/env/positions.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

namespace detail {

template <Dynamics D, class DiceOfLanes>
class Batch final : public Environment, public PositionsSource, private Inspector {
 public:
  Batch(D dynamics, const Lanes& lanes)
      : dynamics_(std::move(dynamics)),
        dice_(lanes),
        limit_(lanes.episode_steps),
        elapsed_(lanes.count) {
    for (std::uint32_t lane = 0; lane < lanes.count; ++lane) {
      auto first = dice_.of_start(lane);  // restart() draws it again
      positions_.push_back(dynamics_.start(first));
    }
  }
  Spaces spaces() const override { return dynamics_.spaces(); }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      if (!begins(restart, now, lane)) continue;
      positions_[lane] = dynamics_.start(dice_.of_start(lane));
      elapsed_[lane] = 0;
      show(lane, now.state, now.observation);
    }
  }
  void step(Experience& now) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      Feedback& feedback = now.feedback[lane];
      feedback = dynamics_.step(positions_[lane], now.action[lane], dice_.of_step(lane));
      feedback.truncated |= ++elapsed_[lane] == limit_;
      show(lane, now.next, now.next_observation);
    }
  }
  std::uint32_t actions(State state) const override {
    if constexpr (HasActions<D>) return dynamics_.actions(state);
    return dynamics_.spaces().actions;
  }
  bool set(std::uint32_t lane, State state) override {
    if constexpr (Settable<D>) {
      positions_[lane] = dynamics_.position(state);
      elapsed_[lane] = 0;
      return true;
    } else {
      return static_cast<void>(lane), static_cast<void>(state), false;
    }
  }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      dice_.persist(archive, lane);
      archive("elapsed", elapsed_[lane]);
      persist_position(archive, positions_[lane]);
    }
  }
  Inspector* inspector() override { return this; }
  std::shared_ptr<Positions> positions() const override {
    return std::make_shared<PositionsOf<D>>(dynamics_);
  }

 private:
  using Position = typename D::Position;
  static constexpr bool has_tree = ShownAsTree<Position>;

  void show(std::size_t lane, std::span<State> state, std::span<float> observation) const {
    if constexpr (HasNumber<D>) {
      if (!state.empty()) state[lane] = static_cast<State>(dynamics_.number(positions_[lane]));
    }
    if constexpr (HasObserve<D>) {
      const std::size_t size = dynamics_.spaces().observation;
      if (!observation.empty()) {
        dynamics_.observe(positions_[lane], observation.subspan(lane * size, size));
      }
    }
  }

  Tree state(std::uint32_t lane, State at) const override {
    if constexpr (has_tree) return tree_of(positions_[lane]);
    return Tree(std::int64_t{at});
  }
  Result<void> set(std::uint32_t lane, const Tree& state, State& at) override {
    if constexpr (has_tree) {
      Position position = positions_[lane];
      if (Result<void> done = assign(position, state); !done) return done;
      positions_[lane] = position;
      elapsed_[lane] = 0;
      if constexpr (HasNumber<D>) at = static_cast<State>(dynamics_.number(position));
      return {};
    } else {
      return static_cast<void>(lane), static_cast<void>(state), static_cast<void>(at),
             Error{"", 0, 0, "this world's state cannot be given as data", ""};
    }
  }
  Tree observation(std::uint32_t lane, State at) const override {
    if constexpr (requires { dynamics_.observation(positions_[lane]); }) {
      return static_cast<void>(at), dynamics_.observation(positions_[lane]);
    } else if constexpr (HasObserve<D>) {
      const Spaces spaces = dynamics_.spaces();
      std::vector<float> x(spaces.observation);
      dynamics_.observe(positions_[lane], x);
      return observation_tree(spaces, x);
    } else {
      return static_cast<void>(lane), Tree(std::int64_t{at});
    }
  }
  std::string text(std::uint32_t lane, State) const override {
    if constexpr (requires { dynamics_.text(positions_[lane]); }) {
      return dynamics_.text(positions_[lane]);
    }
    return static_cast<void>(lane), std::string();
  }
  Drawing drawing(std::uint32_t lane, State) const override {
    if constexpr (requires { dynamics_.drawing(positions_[lane]); }) {
      return dynamics_.drawing(positions_[lane]);
    }
    return static_cast<void>(lane), Drawing();
  }
  bool draws_left() const override { return dice_.good(); }

  D dynamics_;
  DiceOfLanes dice_;
  std::uint64_t limit_;
  std::vector<std::uint64_t> elapsed_;
  std::vector<Position> positions_;
};

}  // namespace detail

/// Copies of a world stepped together; lane i depends on (seed, i) and its actions alone. Without a
/// limit in `lanes` episodes are never cut off.
template <class D>
std::unique_ptr<Environment> batch(D dynamics, const Lanes& lanes,
                                   Seeding seeding = Seeding::quoll) {
  if constexpr (detail::complete<D>()) {
    return with_dice(lanes, seeding, [&](auto type) -> std::unique_ptr<Environment> {
      using DiceOfLanes = typename decltype(type)::type;
      return std::make_unique<detail::Batch<D, DiceOfLanes>>(std::move(dynamics), lanes);
    });
  }
  return nullptr;
}

/// What a world of plain dynamics declares besides what its struct says.
struct WorldFacts {
  double discount = 0.99;
  std::uint64_t episode_steps = 0;  ///< the world's own step limit; 0 = none
  Traits traits;  ///< states, settable and players as far as the struct says are set
  Seeding seeding = Seeding::quoll;
};

/// The World of a plain struct: what it declares, and batches of it.
template <class D>
World to_world(std::string name, D dynamics, const WorldFacts& facts) {
  World world;
  world.name = std::move(name);
  world.discount = facts.discount;
  world.traits = facts.traits;
  world.episode_steps = facts.episode_steps;
  if constexpr (detail::complete<D>()) {
    world.traits.states = dynamics.spaces().states;
    world.traits.settable = Settable<D>;
    if constexpr (HasActionNames<D>) world.action_names = dynamics.action_names();
    if constexpr (requires { dynamics.measured(); }) world.measured = dynamics.measured();
    world.make = [dynamics, facts](Lanes lanes) {
      if (lanes.episode_steps == 0) lanes.episode_steps = facts.episode_steps;
      return batch(dynamics, lanes, facts.seeding);
    };
  }
  return world;
}

/// The same for a struct of one's own, without a step limit.
template <class D>
World to_world(std::string name, D dynamics, double discount, Traits traits = {}) {
  return to_world(std::move(name), std::move(dynamics), WorldFacts{discount, 0, traits});
}

}  // namespace quoll
