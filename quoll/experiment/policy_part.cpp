#include "quoll/experiment/policy_part.hpp"

#include <algorithm>
#include <utility>

namespace quoll {
namespace {

double least_reward(const Mdp& mdp) {
  return std::min(0.0, mdp.reward_bounds().first);
}

}  // namespace

void PolicyPart::begin(const Mdp& mdp) {
  if (round_.size() != mdp.states() || ++now_ == 0) {
    round_.assign(mdp.states(), 0);
    number_.assign(mdp.states(), 0);
    now_ = 1;
  }
  states_.clear();
  actions_.clear();
  reward_.clear();
  begin_.assign(1, 0);
  next_.clear();
  probability_.clear();
  all_known_ = true;
}

void PolicyPart::meet(const Mdp& mdp, State s) {
  if (round_[s] == now_ || mdp.terminal(s)) return;
  round_[s] = now_;
  number_[s] = static_cast<std::uint32_t>(states_.size());
  states_.push_back(s);
}

bool PolicyPart::find(const Mdp& mdp, const PolicyView& policy, std::span<const State> from,
                      std::uint64_t most) {
  begin(mdp);
  for (const State s : from) meet(mdp, s);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_.size() > most) {
      begin(mdp);
      return false;
    }
    const State s = states_[i];
    const Action action = policy(s);
    actions_.push_back(action);
    if (action == no_action) {
      all_known_ = false;
      next_.push_back(s);
      probability_.push_back(1.0);
      reward_.push_back(least_reward(mdp));
    } else {
      const std::uint64_t c = mdp.choice_begin(s) + action;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        meet(mdp, mdp.next(o));
        next_.push_back(mdp.next(o));
        probability_.push_back(mdp.probability(o));
      }
      reward_.push_back(mdp.reward(c));
    }
    begin_.push_back(next_.size());
  }
  const auto end = static_cast<std::uint32_t>(states_.size());
  for (std::uint32_t& next : next_) next = mdp.terminal(next) ? end : number_[next];
  return true;
}

Result<Mdp> PolicyPart::model(const Mdp& mdp) const {
  MdpArrays arrays;
  for (std::size_t i = 0; i <= states_.size(); ++i) arrays.choice_begin.push_back(i);
  arrays.choice_begin.push_back(states_.size());  // the end has no choices
  arrays.outcome_begin = begin_;
  arrays.next = next_;
  if (!mdp.deterministic()) arrays.probability = probability_;
  arrays.reward = reward_;
  if (!mdp.arrays().outcome_reward.empty()) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (actions_[i] == no_action) {
        arrays.outcome_reward.push_back(reward_[i]);
        continue;
      }
      const std::uint64_t c = mdp.choice_begin(states_[i]) + actions_[i];
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        arrays.outcome_reward.push_back(mdp.reward(c, o));
      }
    }
  }
  arrays.action.assign(states_.size(), 0);
  if (states_.empty()) arrays.start = {0};
  arrays.state_names = Names::numbered("", states_.size() + 1);
  arrays.action_names = Names::numbered("", 1);
  arrays.discount = mdp.discount();
  return Mdp::make(std::move(arrays));
}

}  // namespace quoll
