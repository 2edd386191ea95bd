#include "quoll/solve/both_sides.hpp"

#include <utility>

namespace quoll {

// B(s) = r - g E G(s') and H = -G give B(s) = r + g E H(s') and H(s) = -r + g E B(s').
Result<Mdp> both_sides(const Mdp& game, std::span<const Action> policy_of_second) {
  const MdpArrays& from = game.arrays();
  const auto states = static_cast<State>(game.states());
  MdpArrays to;
  to.discount = from.discount;
  to.action_names = from.action_names;
  to.state_names = Names::numbered("", 2 * std::uint64_t{states});
  to.choice_begin.push_back(0);
  if (!game.deterministic()) to.outcome_begin.push_back(0);
  for (const bool second : {false, true}) {
    const double sign = second ? -1.0 : 1.0;
    const State other = second ? 0 : states;
    for (State s = 0; s < states; ++s) {
      const bool fixed = second && !policy_of_second.empty() && policy_of_second[s] != no_action;
      for (std::uint64_t c = game.choice_begin(s); c < game.choice_end(s); ++c) {
        if (fixed && c != game.choice_begin(s) + policy_of_second[s]) continue;
        to.action.push_back(from.action[c]);
        to.reward.push_back(sign * game.reward(c));
        for (std::uint64_t o = game.outcome_begin(c); o < game.outcome_end(c); ++o) {
          to.next.push_back(other + game.next(o));
          if (game.deterministic()) continue;
          to.probability.push_back(game.probability(o));
          to.outcome_reward.push_back(sign * game.reward(c, o));
        }
        if (!game.deterministic()) to.outcome_begin.push_back(to.next.size());
      }
      to.choice_begin.push_back(to.action.size());
    }
    for (const State end : from.terminal) to.terminal.push_back(end + (second ? states : 0));
  }
  return Mdp::make(std::move(to));
}

}  // namespace quoll
