#pragma once
// The positions of a world described by code, for going through all of them (explore.hpp): one is
// looked at, others are kept and have numbers.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/json_tree.hpp"
#include "quoll/env/branches.hpp"
#include "quoll/env/members.hpp"

namespace quoll {

class Positions {
 public:
  virtual ~Positions() = default;
  virtual Spaces spaces() const = 0;
  /// Looks at where an episode begins.
  virtual void start(Branches& dice) = 0;
  /// Looks at what an action makes of a kept position.
  virtual Feedback step(State kept, Action action, Branches& dice) = 0;
  /// Bytes that tell the position looked at from every other one; valid until another is.
  virtual std::string_view key() = 0;
  /// Those of a kept position; valid until the next such call.
  virtual std::string_view key(State kept) = 0;
  /// Number of actions of the position looked at; 0 = an end.
  virtual Action actions() const = 0;
  /// Keeps it, under the next number from 0; of a world that can be put into its numbered states,
  /// the position that its number stands for.
  virtual void keep() = 0;
  /// What people call a kept position: its number by `name_of_number` (empty = in digits) where the
  /// world can be put into its numbered states, else its data, else its number, which need not be
  /// its alone; empty = it cannot be shown.
  virtual std::string name(State kept,
                           const std::function<std::string(State)>& name_of_number) const = 0;
};

/// An environment of which all positions can be gone through.
class PositionsSource {
 public:
  virtual ~PositionsSource() = default;
  virtual std::shared_ptr<Positions> positions() const = 0;
};

/// Data on one line: the fields of an object as "y=9 cars=[1,2]", an only field without its name,
/// anything else as JSON.
std::string short_text(const Tree& tree);

namespace detail {

template <Dynamics D>
class PositionsOf final : public Positions {
 public:
  explicit PositionsOf(D dynamics) : dynamics_(std::move(dynamics)) {}

  Spaces spaces() const override { return dynamics_.spaces(); }
  void start(Branches& dice) override { look_at(dynamics_.start(dice)); }
  Feedback step(State kept, Action action, Branches& dice) override {
    Position at = kept_[kept];
    const Feedback feedback = dynamics_.step(at, action, dice);
    look_at(std::move(at));
    return feedback;
  }
  std::string_view key() override { return key_of(at_.front(), key_); }
  std::string_view key(State kept) override { return key_of(kept_[kept], kept_key_); }
  Action actions() const override {
    if constexpr (HasActions<D> && HasNumber<D>) {
      return dynamics_.actions(static_cast<State>(dynamics_.number(at_.front())));
    }
    return dynamics_.spaces().actions;
  }
  void keep() override {
    if constexpr (by_number) {  // what the number does not say is still open
      kept_.push_back(dynamics_.position(static_cast<State>(dynamics_.number(at_.front()))));
    } else {
      kept_.push_back(at_.front());
    }
  }
  std::string name(State kept,
                   const std::function<std::string(State)>& name_of_number) const override {
    if constexpr (by_number) {
      const auto number = static_cast<State>(dynamics_.number(kept_[kept]));
      return name_of_number ? name_of_number(number) : std::to_string(number);
    } else if constexpr (ShownAsTree<Position>) {
      return short_text(tree_of(kept_[kept]));
    } else if constexpr (HasNumber<D>) {
      return std::to_string(static_cast<State>(dynamics_.number(kept_[kept])));
    } else {
      return {};
    }
  }

 private:
  using Position = typename D::Position;
  // A number that leads back to a position says all of it; that of a bin does not.
  static constexpr bool by_number = HasNumber<D> && Settable<D>;

  void look_at(Position at) { at_.assign(1, std::move(at)); }

  std::string_view key_of(const Position& at, Archive& key) const {
    key = Archive();
    if constexpr (by_number) {
      auto number = static_cast<State>(dynamics_.number(at));
      key("number", number);
    } else {
      Position copy = at;
#if __has_builtin(__builtin_clear_padding)
      if constexpr (std::is_trivially_copyable_v<Position>) __builtin_clear_padding(&copy);
#endif
      persist_position(key, copy);
    }
    return {reinterpret_cast<const char*>(key.bytes().data()), key.bytes().size()};
  }

  D dynamics_;
  std::vector<Position> at_;  // one, once something is looked at: a Position has no default value
  std::vector<Position> kept_;
  Archive key_, kept_key_;
};

}  // namespace detail

}  // namespace quoll
