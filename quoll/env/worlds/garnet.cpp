// Garnet: a random model of given size. Each action of each state leads to `branching` different
// states; their probabilities are the lengths between branching - 1 uniform cuts of [0, 1]; the
// reward of each pair is drawn from the normal distribution of mean 0 and variance 1. No ends,
// discount 0.95, starts anywhere.
// Archibald, McKinnon, Thomas 1995, "On the generation of Markov decision processes"; Bhatnagar,
// Sutton, Ghavamzadeh, Lee 2009, "Natural actor-critic algorithms", section 6.
// Draws of the stream (seed, "garnet"), pair by pair: successors by Floyd's algorithm (one whole
// number each), cuts, two numbers for the reward (Box, Muller 1958). The same seed is the same
// model everywhere. State: its name, "s0", "s1", ... One draw a step.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "quoll/base/normal.hpp"
#include "quoll/env/world.hpp"

namespace quoll {
namespace {

struct Settings {
  std::uint64_t states = 20;
  std::uint64_t actions = 3;
  std::uint64_t branching = 3;
  std::uint64_t seed = 1;

  void describe(Describer& d) {
    d("states", states, 1, 100'000'000, "states");
    d("actions", actions, 1, 1000, "actions of each state");
    d("branching", branching, 1, 1000, "successors of each action");
    d("seed", seed, "which model");
  }
};

// Floyd's algorithm (Bentley, Floyd 1987): `count` different numbers below n, each set equally
// likely.
void add_successors(std::vector<State>& next, std::uint32_t count, std::uint32_t n, Rng& dice) {
  const auto begin = static_cast<std::ptrdiff_t>(next.size());
  for (std::uint32_t j = n - count; j < n; ++j) {
    const std::uint32_t drawn = dice.below(j + 1);
    const bool taken = std::find(next.begin() + begin, next.end(), drawn) != next.end();
    next.push_back(taken ? j : drawn);
  }
}

MdpArrays generate(const Settings& settings) {
  const auto states = static_cast<std::uint32_t>(settings.states);
  const auto branching = static_cast<std::uint32_t>(settings.branching);
  const std::uint64_t pairs = settings.states * settings.actions;
  MdpArrays a;
  a.discount = 0.95;
  a.state_names = Names::numbered("s", states);
  a.action_names = Names::numbered("a", settings.actions);
  a.next.reserve(pairs * branching);
  a.probability.reserve(pairs * branching);
  a.choice_begin.push_back(0);
  a.outcome_begin.push_back(0);
  Rng dice = stream(settings.seed, "garnet");
  std::vector<double> cuts(branching - 1);
  for (std::uint32_t s = 0; s < states; ++s) {
    for (std::uint32_t action = 0; action < settings.actions; ++action) {
      add_successors(a.next, branching, states, dice);
      for (double& cut : cuts) cut = dice.uniform();
      std::sort(cuts.begin(), cuts.end());
      double before = 0.0;
      for (const double cut : cuts) {
        a.probability.push_back(cut - before);
        before = cut;
      }
      a.probability.push_back(1.0 - before);
      a.reward.push_back(draw_normal(dice));
      a.action.push_back(action);
      a.outcome_begin.push_back(a.next.size());
    }
    a.choice_begin.push_back(a.action.size());
  }
  return a;
}

Result<World> make(const Parameters& given) {
  const Result<Settings> settings = read_parameters<Settings>("garnet", given);
  if (!settings) return settings.error();
  if (settings->branching > settings->states) {
    return Error{"--with branching", 0, 0,
                 "at most as many successors as states expected, " +
                     std::to_string(settings->states) + ", not " +
                     std::to_string(settings->branching),
                 ""};
  }
  Result<Mdp> mdp = Mdp::make(generate(*settings));
  if (!mdp) return mdp.error();
  return to_world("garnet", std::move(*mdp));
}

}  // namespace

extern const WorldEntry garnet_world;
const WorldEntry garnet_world{"garnet",
                              "",
                              "a random model of any number of states, actions and successors",
                              "Archibald, McKinnon, Thomas 1995; Bhatnagar et al. 2009",
                              make,
                              parameters_of<Settings>};

}  // namespace quoll
