#include "quoll/solve/defined_part.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {
namespace {

std::vector<bool> gaining(const Mdp& mdp, bool maximise) {
  if (maximise) return may_gain_for_ever(mdp);
  if (mdp.reward_bounds().first >= 0.0) return std::vector<bool>(mdp.states(), false);
  const Result<Mdp> costs = negated_rewards(mdp);
  return costs ? may_gain_for_ever(*costs) : std::vector<bool>(mdp.states(), true);
}

// The choices of `outside` stay, though nobody takes them; those of others that lead there go.
MdpArrays without_choices_into(const Mdp& mdp, const std::vector<bool>& outside) {
  const MdpArrays& from = mdp.arrays();
  MdpArrays to;
  to.choice_begin.push_back(0);
  to.outcome_begin.push_back(0);
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      bool leads = false;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        leads = leads || outside[mdp.next(o)];
      }
      if (leads && !outside[s]) continue;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        to.next.push_back(mdp.next(o));
        to.probability.push_back(mdp.probability(o));
        if (!from.outcome_reward.empty()) to.outcome_reward.push_back(from.outcome_reward[o]);
      }
      to.outcome_begin.push_back(to.next.size());
      to.reward.push_back(mdp.reward(c));
      to.action.push_back(from.action[c]);
    }
    to.choice_begin.push_back(to.action.size());
  }
  to.start = from.start;
  to.start_probability = from.start_probability;
  to.terminal = from.terminal;
  to.state_names = from.state_names;
  to.action_names = from.action_names;
  to.labels = from.labels;
  to.reward_name = from.reward_name;
  to.discount = from.discount;
  to.layout = from.layout;
  return to;
}

}  // namespace

Result<DefinedPart> defined_part(const Mdp& mdp, bool maximise) {
  DefinedPart defined;
  const std::vector<bool> gains = gaining(mdp, maximise);
  const Ending ending = find_ending(mdp);
  std::vector<bool> outside(mdp.states(), false);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) continue;
    if (gains[s]) {
      defined.boundless.push_back(s);
    } else if (ending.live[s] == 0) {
      defined.endless.push_back(s);
      outside[s] = true;
    }
  }
  if (defined.boundless.empty() && defined.endless.empty()) return defined;
  const auto [low, high] = mdp.reward_bounds();
  defined.certain = maximise ? low >= 0.0 : high <= 0.0;
  MdpArrays arrays = without_choices_into(mdp, outside);
  for (const std::vector<State>* more : {&defined.boundless, &defined.endless}) {
    std::vector<State> merged;
    std::set_union(arrays.terminal.begin(), arrays.terminal.end(), more->begin(), more->end(),
                   std::back_inserter(merged));
    arrays.terminal = std::move(merged);
  }
  Result<Mdp> part = Mdp::make(std::move(arrays));
  if (!part) return part.error();
  defined.part = *std::move(part);
  return defined;
}

void DefinedPart::fill(bool maximise, Solution& solution) const {
  const double best = maximise ? infinity : -infinity;
  for (const State s : endless) solution.lower[s] = solution.upper[s] = -best;
  for (const State s : boundless) {
    solution.lower[s] = certain ? best : -infinity;
    solution.upper[s] = certain ? best : infinity;
  }
}

}  // namespace quoll
