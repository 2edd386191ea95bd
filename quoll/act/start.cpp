#include "quoll/act/start.hpp"

#include <algorithm>
#include <utility>

namespace quoll {
namespace {

std::vector<State> states_with_actions(const Mdp& mdp) {
  std::vector<State> states;
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s)) states.push_back(s);
  }
  return states;
}

}  // namespace

StartStates StartStates::world(const Mdp& mdp) {
  StartStates starts;
  const bool weighted = !mdp.arrays().start_probability.empty();
  double sum = 0.0;
  for (std::uint64_t i = 0; i < mdp.start().size(); ++i) {
    if (mdp.terminal(mdp.start()[i])) continue;
    starts.states_.push_back(mdp.start()[i]);
    if (weighted) starts.cumulative_.push_back(sum += mdp.start_probability(i));
  }
  for (double& bound : starts.cumulative_) bound /= sum;
  return starts;
}

StartStates StartStates::uniform(const Mdp& mdp) {
  return among(Kind::uniform, states_with_actions(mdp));
}

StartStates StartStates::fixed(State state) {
  return among(Kind::fixed, {state});
}

StartStates StartStates::least_visited(const Mdp& mdp) {
  return among(Kind::least_visited, states_with_actions(mdp));
}

StartStates StartStates::among(Kind kind, std::vector<State> states) {
  StartStates starts;
  starts.kind_ = kind;
  starts.states_ = std::move(states);
  return starts;
}

State StartStates::sample(std::uint64_t bits) const {
  if (cumulative_.empty()) {
    const auto count = static_cast<std::uint32_t>(states_.size());
    return states_[scale(static_cast<std::uint32_t>(bits >> 32), count)];
  }
  // The last state takes what rounding leaves over, so the search cannot run off the end.
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, unit(bits));
  return states_[static_cast<std::size_t>(found - cumulative_.begin())];
}

}  // namespace quoll
