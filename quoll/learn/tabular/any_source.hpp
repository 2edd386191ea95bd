#pragma once
// The three sources of experience behind one type, for methods whose own work outweighs a branch
// per step.

#include <utility>
#include <variant>
#include <vector>

#include "quoll/env/world.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/learn/tabular/source.hpp"

namespace quoll {

/// What a step gave. `carry` = what the value of `next` is multiplied by: 0 after the end, the
/// discount otherwise, negative when the turn passes to the opponent.
struct Landed {
  State next = 0;
  double reward = 0.0;
  double carry = 0.0;
  bool terminated = false, truncated = false;
};

/// Rewards of tables are rounded to Value, as the table of values is.
template <class Value>
class AnySource {
 public:
  explicit AnySource(const LearnSetup& setup) : source_(make(setup)) {
    const std::shared_ptr<const Mdp>& mdp = setup.world->mdp;
    discount_ = mdp ? mdp->carry(setup.discount) : setup.discount;
  }

  Landed step(std::uint64_t pair, State state, Action action, std::uint64_t draw) {
    const auto take = [&](auto& source) {
      const auto landing = source.stepper()(pair, state, action, draw);
      Landed landed{landing.next, double{landing.reward}, 0.0, landing.terminated, false};
      landed.carry = landed.terminated ? 0.0 : discount_;
      if constexpr (requires { landing.turn_passes; }) {
        landed.truncated = landing.truncated;
        if (landing.turn_passes) landed.carry = -landed.carry;
      }
      return landed;
    };
    // What std::visit finds by a call, for the tables without one.
    if (Fixed* const fixed = std::get_if<Fixed>(&source_)) return take(*fixed);
    if (Chance* const chance = std::get_if<Chance>(&source_)) return take(*chance);
    return take(std::get<EnvironmentSource>(source_));
  }
  template <class Visits>
  State start(StartStates& starts, Rng& rng, const Visits& visits) {
    return std::visit([&](auto& source) { return source.start(starts, rng, visits); }, source_);
  }
  void persist(Archive& archive) {
    std::visit([&](auto& source) { source.persist(archive); }, source_);
  }

  /// First pair of each state of the world, and the end. An end of a world without a model has one
  /// pair too: such a world may begin in one, and the step there does nothing.
  static std::vector<std::uint64_t> rows_of(const World& world) {
    if (world.mdp) return world.mdp->arrays().choice_begin;
    const std::unique_ptr<Environment> environment = world.make({});
    const std::uint64_t states = environment->spaces().states;
    std::vector<std::uint64_t> begin(states + 1);
    for (State s = 0; s < states; ++s) {
      begin[s + 1] = begin[s] + std::max<std::uint64_t>(environment->actions(s), 1);
    }
    return begin;
  }

 private:
  using Fixed = TableSource<DeterministicTable<Value>>;
  using Chance = TableSource<StochasticTable<Value>>;
  using Source = std::variant<Fixed, Chance, EnvironmentSource>;

  static Source make(const LearnSetup& setup) {
    const World& world = *setup.world;
    if (!world.mdp) {
      return EnvironmentSource(world.make({1, setup.seed, setup.episode_steps, nullptr}));
    }
    const PairLayout layout{0, world.mdp->choices()};
    if (world.mdp->deterministic()) return Fixed{deterministic_table<Value>(*world.mdp, layout)};
    return Chance{stochastic_table<Value>(*world.mdp, layout)};
  }

  Source source_;
  double discount_ = 1.0;
};

}  // namespace quoll
