#pragma once
// Which instance of the loop a world gets: its source of experience and the layout of its rows.

#include <memory>
#include <utility>
#include <vector>

#include "quoll/learn/tabular/engine.hpp"

namespace quoll {

/// The learner of a rule for the source and the layout that the world has.
template <class Rule>
std::unique_ptr<Learner> tabular(const LearnSetup& setup) {
  using Value = typename Rule::Value;
  using Chance = TableSource<StochasticTable<Value>>;
  using Fixed = TableSource<DeterministicTable<Value>>;
  const World& world = *setup.world;
  if (!world.mdp) {
    std::unique_ptr<Environment> environment =
        world.make({1, setup.seed, setup.episode_steps, nullptr});
    const Spaces spaces = environment->spaces();
    std::vector<std::uint64_t> begin(std::size_t{spaces.states} + 1);
    for (State s = 0; s < spaces.states; ++s) {
      // An end has one pair too: a world may begin in one, and the step there does nothing.
      begin[s + 1] = begin[s] + std::max<std::uint64_t>(environment->actions(s), 1);
    }
    const PairLayout layout{0, begin.back()};
    Rule rule(setup, layout, begin);
    return std::make_unique<TabularLearner<Rule, EnvironmentSource, RaggedRows>>(
        setup, std::move(rule), EnvironmentSource(std::move(environment)), spaces.states, layout,
        std::move(begin));
  }
  // Padded rows for the rule whose speed counts; the others share the ragged ones.
  constexpr bool padded = sizeof(Value) == 4 && !Rule::own_step;
  const Mdp& mdp = *world.mdp;
  const PairLayout layout = padded ? pair_layout(mdp) : PairLayout{0, mdp.choices()};
  std::vector<std::uint64_t> begin = mdp.arrays().choice_begin;
  Rule rule(setup, layout, begin);
  const auto make = [&]<class Source>(Source source) -> std::unique_ptr<Learner> {
    if constexpr (padded) {
      if (layout.width == 4) {
        return std::make_unique<TabularLearner<Rule, Source, FourRows>>(
            setup, std::move(rule), std::move(source), mdp.states(), layout, std::move(begin));
      }
    }
    return std::make_unique<TabularLearner<Rule, Source, RaggedRows>>(
        setup, std::move(rule), std::move(source), mdp.states(), layout, std::move(begin));
  };
  if (mdp.deterministic()) return make(Fixed{deterministic_table<Value>(mdp, layout)});
  return make(Chance{stochastic_table<Value>(mdp, layout)});
}

}  // namespace quoll
