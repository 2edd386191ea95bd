#include "quoll/solve/inductive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/growth.hpp"
#include "quoll/solve/induced.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

Inductive::Inductive(const Mdp& mdp, const std::vector<std::uint8_t>& live, const FreeParts& free)
    : mdp_(mdp), live_(live), free_(free) {
  const auto [low, high] = mdp.reward_bounds();
  reward_size_ = std::max(std::fabs(low), std::fabs(high));
}

std::vector<double> Inductive::constant(double unknown) const {
  std::vector<double> bound(mdp_.states(), 0.0);
  for (State s = 0; s < mdp_.states(); ++s) {
    if (!mdp_.terminal(s)) bound[s] = live_[s] != 0 ? unknown : -infinity;
  }
  return bound;
}

double Inductive::gain_up(const std::vector<double>& bound, double sign, State s,
                          std::uint64_t choice) const {
  const double reward = sign * mdp_.reward(choice);
  double sum = reward;
  if (!free_.inside(choice)) {
    const double outcomes =
        static_cast<double>(mdp_.outcome_end(choice) - mdp_.outcome_begin(choice));
    sum = add_up(reward, (outcomes + 3.0) * 2.0 * half_ulp * reward_size_);
  }
  return growth_up(mdp_, bound, sign, s, choice, sum);
}

bool Inductive::holds_below(const std::vector<double>& lower,
                            const std::vector<Action>& policy) const {
  for (State s = 0; s < mdp_.states(); ++s) {
    if (live_[s] == 0) continue;
    if (gain_up(lower, -1.0, s, mdp_.choice_begin(s) + policy[s]) > 0.0) return false;
  }
  return true;
}

bool Inductive::raise_above(std::vector<double>& upper) const {
  constexpr unsigned most_sweeps = 40;
  for (unsigned k = 0; k < most_sweeps; ++k) {
    bool raised = false;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (live_[s] == 0) continue;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        const double gain = gain_up(upper, 1.0, s, c);
        if (!(gain > 0.0)) continue;
        upper[s] = next_up(upper[s] + 2.0 * gain);
        raised = true;
      }
    }
    if (!raised) return true;
    free_.level_up(upper);
  }
  return false;
}

bool Inductive::ends(const std::vector<Action>& policy) const {
  std::vector<bool> outside(mdp_.states());
  for (State s = 0; s < mdp_.states(); ++s) outside[s] = live_[s] == 0 && !mdp_.terminal(s);
  const std::vector<double> chosen = as_probabilities(mdp_, policy);
  const Result<Mdp> chain = induced_model(mdp_, chosen, std::nullopt, outside);
  if (!chain) return false;
  const std::vector<bool> may_end = can_end(*chain);
  for (State s = 0; s < mdp_.states(); ++s) {
    if (live_[s] == 0) continue;
    if (!may_end[s]) return false;
    const std::uint64_t c = mdp_.choice_begin(s) + policy[s];
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (outside[mdp_.next(o)]) return false;
    }
  }
  return true;
}

}  // namespace quoll
