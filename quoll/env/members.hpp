#pragma once
// The members of a struct that describes a world (dynamics.hpp): those it must have, those it may
// have, and how its positions are saved and shown.

#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "quoll/base/archive.hpp"
#include "quoll/base/random.hpp"
#include "quoll/base/tree.hpp"
#include "quoll/env/environment.hpp"

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

/// Worlds whose actions have names.
template <class D>
concept HasActionNames = requires(const D d) {
  { d.action_names() } -> std::same_as<std::vector<std::string>>;
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

/// Positions that can be shown as data: a number, a list, or fields with names.
template <class Position>
concept ShownAsTree = requires(Position at, TreeWriter& writer) { at.persist(writer); } ||
                      std::is_arithmetic_v<Position> || requires(Position at) { at.size(); };

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

}  // namespace detail

}  // namespace quoll
