#include "quoll/learn/choice.hpp"

#include <cmath>

namespace quoll {
namespace {

// Few enough for the lecture's random walk; more than that, a model would not fit beside the table.
constexpr std::uint64_t few_pairs = 64, most_pairs = 50'000'000;

std::uint64_t pairs_of(const World& world) {
  if (world.mdp) return world.mdp->choices();
  return world.traits.states * world.make({})->spaces().actions;
}

bool values_bounded(const World& world, const LearnSettings& settings) {
  const auto rewards = reward_range(world, settings.reward_range);
  if (!rewards || !*rewards) return false;
  const double discount = settings.discount > 0.0 ? settings.discount : world.discount;
  return std::isfinite(value_range(**rewards, discount).second);
}

}  // namespace

MethodChoice choose_method(const World& world, const LearnSettings& settings) {
  if (world.traits.states == 0) {
    return {"pqn", "world",
            "no table can learn what cannot be listed; a network learns from what is observed"};
  }
  if (world.traits.players > 1) {
    return {"q-learning", "world", "two players learn from each other's moves"};
  }
  const std::uint64_t pairs = pairs_of(world);
  if (pairs <= few_pairs && world.traits.deterministic) {
    return {"q-learning", "world", "so few moves, and no noise: chance tries them all soon"};
  }
  if (pairs > most_pairs) {
    return {"q-learning", "world", "a model of so many moves would take too much memory"};
  }
  if (world.traits.settable) {
    return {"empirical-model", "each-pair",
            "the world can be put into any state: trying each move equally often needs the fewest "
            "steps"};
  }
  if (values_bounded(world, settings)) {
    return {"optimistic-model", "world",
            "the world can only begin anew, and its rewards are known to be bounded: going where "
            "most can be hoped for needs the fewest steps"};
  }
  const bool dear = world.traits.step_cost == Traits::StepCost::dear;
  return {dear ? "prioritised-sweeping" : "dyna-q", "world",
          "the world can only begin anew and bounds no values: a counted model makes most of each "
          "step"};
}

std::optional<MethodChoice> settle_method(const World& world, LearnSettings& settings) {
  if (settings.method != "auto") return std::nullopt;
  MethodChoice choice = choose_method(world, settings);
  settings.method = choice.method;
  if (settings.start == "world") settings.start = choice.start;
  choice.start = settings.start;
  return choice;
}

}  // namespace quoll
