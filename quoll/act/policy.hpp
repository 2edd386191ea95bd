#pragma once
// The border to whatever picks actions: a table, a network, a search, a uniform coin.

#include <span>
#include <vector>

#include "quoll/base/random.hpp"
#include "quoll/model/experience.hpp"

namespace quoll {

class Policy {
 public:
  virtual ~Policy() = default;
  /// Chooses an action for each lane of `now`; lane i draws from streams[i]. Does not allocate.
  virtual void act(const Experience& now, std::span<Action> out, std::span<Rng> streams) const = 0;
};

/// One action per state. As a function object it costs one load: noexcept, no allocation, no locks.
class TablePolicy final : public Policy {
 public:
  TablePolicy() = default;
  explicit TablePolicy(std::vector<Action> actions) : actions_(std::move(actions)) {}

  /// The action for a state; no_action for an end or a state this policy knows nothing about.
  Action operator()(State state) const noexcept {
    return state < actions_.size() ? actions_[state] : no_action;
  }
  void act(const Experience& now, std::span<Action> out, std::span<Rng>) const override {
    for (std::size_t lane = 0; lane < out.size(); ++lane) out[lane] = (*this)(now.state[lane]);
  }
  std::span<const Action> actions() const { return actions_; }

 private:
  std::vector<Action> actions_;
};

/// Each action of the state with equal probability; one draw from the lane's stream.
class UniformPolicy final : public Policy {
 public:
  /// `counts` = number of actions per state; states beyond it, and worlds without numbered states,
  /// have `otherwise` actions.
  explicit UniformPolicy(std::vector<Action> counts, Action otherwise = 0)
      : counts_(std::move(counts)), otherwise_(otherwise) {}

  void act(const Experience& now, std::span<Action> out, std::span<Rng> streams) const override {
    for (std::size_t lane = 0; lane < out.size(); ++lane) {
      const State s = now.state[lane];
      const Action count = s < counts_.size() ? counts_[s] : otherwise_;
      const std::uint64_t bits = streams[lane].next();
      out[lane] = count == 0 ? no_action : scale(static_cast<std::uint32_t>(bits >> 32), count);
    }
  }

 private:
  std::vector<Action> counts_;
  Action otherwise_;
};

}  // namespace quoll
