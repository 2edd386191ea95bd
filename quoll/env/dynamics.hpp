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
//     Position position(quoll::State s) const;                        // optional: settable
//     quoll::Action actions(quoll::State s) const;                    // optional: fewer than
//     spaces
//   };

#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/env/environment.hpp"
#include "quoll/env/world.hpp"

namespace quoll {

/// What a struct must have. The assertions in batch() name the member that is missing.
template <class D>
concept HasPosition = requires { typename D::Position; } && std::copyable<typename D::Position>;
template <class D>
concept HasSpaces = requires(const D d) {
  { d.spaces() } -> std::same_as<Spaces>;
};
template <class D>
concept HasStart = requires(const D d, Rng& dice) {
  { d.start(dice) } -> std::convertible_to<typename D::Position>;
};
template <class D>
concept HasStep = requires(const D d, typename D::Position& at, Action action, Rng& dice) {
  { d.step(at, action, dice) } -> std::same_as<Feedback>;
};
template <class D>
concept HasNumber = requires(const D d, const typename D::Position& at) {
  { d.number(at) } -> std::convertible_to<State>;
};
template <class D>
concept HasObserve =
    requires(const D d, const typename D::Position& at, std::span<float> x) { d.observe(at, x); };
template <class D>
concept Dynamics =
    HasPosition<D> && HasSpaces<D> && HasStart<D> && HasStep<D> && (HasNumber<D> || HasObserve<D>);

/// Worlds whose states differ in their number of actions.
template <class D>
concept HasActions = requires(const D d, State s) {
  { d.actions(s) } -> std::convertible_to<Action>;
};

/// Worlds that can be put into any numbered state.
template <class D>
concept Settable = requires(const D d, State s) {
  { d.position(s) } -> std::convertible_to<typename D::Position>;
};

namespace detail {

// The position of a lane as bytes in an archive: persist() if the type has it, else its own bytes.
template <class Position>
void persist_position(Archive& archive, Position& position) {
  if constexpr (requires { position.persist(archive); }) {
    position.persist(archive);
  } else if constexpr (std::is_arithmetic_v<Position>) {
    archive("position", position);
  } else {
    static_assert(std::is_trivially_copyable_v<Position>,
                  "Position needs persist(Archive&), or must be trivially copyable");
    std::string bytes(reinterpret_cast<const char*>(&position), sizeof position);
    archive("position", bytes);
    if (bytes.size() != sizeof position) return archive.fail("a position of another world");
    std::memcpy(&position, bytes.data(), sizeof position);
  }
}

/// Whether nothing is missing; each assertion names one member.
template <class D>
constexpr bool complete() {
  static_assert(HasPosition<D>, "a world needs a copyable type: using Position = ...;");
  if constexpr (HasPosition<D>) {
    static_assert(HasSpaces<D>, "a world needs: quoll::Spaces spaces() const");
    static_assert(HasStart<D>, "a world needs: Position start(auto& dice) const");
    static_assert(
        HasStep<D>,
        "a world needs: quoll::Feedback step(Position&, quoll::Action, auto& dice) const");
    static_assert(HasNumber<D> || HasObserve<D>,
                  "a world needs: quoll::State number(const Position&) const, or "
                  "void observe(const Position&, std::span<float>) const");
  }
  return Dynamics<D>;
}

template <Dynamics D>
class Batch final : public Environment {
 public:
  Batch(D dynamics, std::uint32_t lanes, std::uint64_t seed) : dynamics_(std::move(dynamics)) {
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      dice_.push_back(stream(seed, "world", lane));
      start_dice_.push_back(stream(seed, "start", lane));
      Rng first = start_dice_.back();  // restart() draws it again
      positions_.push_back(dynamics_.start(first));
    }
  }
  Spaces spaces() const override { return dynamics_.spaces(); }

  void restart(std::span<const std::uint8_t> restart, Experience& now) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      if (!restart[lane]) continue;
      positions_[lane] = dynamics_.start(start_dice_[lane]);
      show(lane, now.state, now.observation);
    }
  }
  void step(Experience& now) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      now.feedback[lane] = dynamics_.step(positions_[lane], now.action[lane], dice_[lane]);
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
      return true;
    } else {
      return static_cast<void>(lane), static_cast<void>(state), false;
    }
  }
  void persist(Archive& archive) override {
    for (std::size_t lane = 0; lane < positions_.size(); ++lane) {
      archive("dice", dice_[lane]);
      archive("start_dice", start_dice_[lane]);
      persist_position(archive, positions_[lane]);
    }
  }

 private:
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

  D dynamics_;
  std::vector<Rng> dice_, start_dice_;
  std::vector<typename D::Position> positions_;
};

}  // namespace detail

/// `lanes` copies of a world stepped together; lane i depends on (seed, i) and its actions alone.
template <class D>
std::unique_ptr<Environment> batch(D dynamics, std::uint32_t lanes, std::uint64_t seed) {
  if constexpr (detail::complete<D>()) {
    return std::make_unique<detail::Batch<D>>(std::move(dynamics), lanes, seed);
  }
  return nullptr;
}

/// The World of a plain struct: what it declares, and batches of it. `traits.states` follows
/// spaces().
template <class D>
World to_world(std::string name, D dynamics, double discount, Traits traits = {}) {
  World world;
  world.name = std::move(name);
  world.discount = discount;
  world.traits = traits;
  if constexpr (detail::complete<D>()) {
    world.traits.states = dynamics.spaces().states;
    world.traits.settable = Settable<D>;
    world.make = [dynamics](std::uint32_t lanes, std::uint64_t seed) {
      return batch(dynamics, lanes, seed);
    };
  }
  return world;
}

}  // namespace quoll
