#include "quoll/solve/induced.hpp"

#include <utility>

namespace quoll {

namespace {

// Appends the one choice of state s, mixed from its choices.
void mix(const Mdp& mdp, std::span<const double> choice_probability, State s, MdpArrays& to) {
  double total = 0.0;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    total += choice_probability[c];
  }
  double reward = 0.0;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    if (choice_probability[c] == 0.0) continue;
    const double share = choice_probability[c] / total;
    reward += share * mdp.reward(c);
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      to.next.push_back(mdp.next(o));
      to.probability.push_back(share * mdp.probability(o));
    }
  }
  to.reward.push_back(reward);
}

}  // namespace

Result<Mdp> induced_model(const Mdp& mdp, std::span<const double> choice_probability,
                          std::optional<double> unknown_reward, const std::vector<bool>& ended) {
  MdpArrays to;
  to.choice_begin.push_back(0);
  to.outcome_begin.push_back(0);
  bool any_choice = false;
  for (State s = 0; s < mdp.states(); ++s) {
    bool known = false;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      known = known || choice_probability[c] > 0.0;
    }
    const bool end = mdp.terminal(s) || (!ended.empty() && ended[s]);
    if (!end && known) {
      mix(mdp, choice_probability, s, to);
    } else if (!end && unknown_reward) {
      to.next.push_back(s);
      to.probability.push_back(1.0);
      to.reward.push_back(*unknown_reward);
    }
    if (to.next.size() != to.outcome_begin.back()) {
      to.outcome_begin.push_back(to.next.size());
      to.action.push_back(0);
      any_choice = true;
    }
    to.choice_begin.push_back(to.reward.size());
  }
  to.start = any_choice ? std::vector<State>{} : std::vector<State>{0};
  to.state_names = Names::numbered("", mdp.states());
  to.action_names = Names::numbered("", 1);
  to.discount = mdp.discount();
  return Mdp::make(std::move(to));
}

std::vector<double> as_probabilities(const Mdp& mdp, std::span<const Action> policy) {
  std::vector<double> probability(mdp.choices(), 0.0);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s) || policy[s] == no_action) continue;
    probability[mdp.choice_begin(s) + policy[s]] = 1.0;
  }
  return probability;
}

}  // namespace quoll
