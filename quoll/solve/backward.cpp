#include "quoll/solve/backward.hpp"

#include <algorithm>
#include <cmath>

#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

// An upper bound on sign * Q(choice).
double signed_q_upper(const Mdp& mdp, std::uint64_t choice, const Discount& discount,
                      const Bounds& follows, double sign) {
  const bool from_above = (sign > 0.0) != mdp.alternating();
  const bool varied = !mdp.arrays().outcome_reward.empty();
  double mean = 0.0, reward = 0.0;
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    const Meant p(mdp.probability(o));
    const auto weigh = [&](double x) {
      return scale_up(x >= 0.0 ? std::min(1.0, p.upper) : p.lower, x);
    };
    const State next = mdp.next(o);
    mean = add_up(mean, weigh(from_above ? follows.upper[next] : -follows.lower[next]));
    if (varied) reward = add_up(reward, weigh(Meant(sign * mdp.reward(choice, o)).upper));
  }
  if (!varied) reward = Meant(sign * mdp.reward(choice)).upper;
  return add_up(reward, scale_up(mean >= 0.0 ? discount.upper : discount.lower, mean));
}

}  // namespace

Result<std::vector<State>> backward_order(const Mdp& mdp) {
  if (const std::vector<State> again = returning_states(mdp); !again.empty()) {
    return Error{"--method", 0, 0,
                 "backward-induction needs a model in which no state comes again, but " +
                     mdp.state_name(again.front()) + " can",
                 mdp.alternating() ? "game-iteration" : ""};
  }
  const std::vector<std::uint32_t> component = strongly_connected(mdp);
  std::vector<State> order(mdp.states());
  for (State s = 0; s < mdp.states(); ++s) order[component[s]] = s;
  std::erase_if(order, [&](State s) { return mdp.terminal(s); });
  return order;
}

double q_lower(const Mdp& mdp, std::uint64_t choice, const Discount& discount,
               const Bounds& follows) {
  return -signed_q_upper(mdp, choice, discount, follows, -1.0) + 0.0;
}

double q_upper(const Mdp& mdp, std::uint64_t choice, const Discount& discount,
               const Bounds& follows) {
  return signed_q_upper(mdp, choice, discount, follows, 1.0) + 0.0;
}

Result<Evaluation> evaluate_game(const Mdp& mdp, std::span<const double> choice_probability,
                                 double discount) {
  const Result<std::vector<State>> order = backward_order(mdp);
  if (!order) return order.error();
  const Discount factor(discount);
  Bounds value(mdp);
  for (const State s : *order) {
    double sum = 0.0, lower = 0.0, upper = 0.0, least = infinity, greatest = -infinity;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const double low = q_lower(mdp, c, factor, value), high = q_upper(mdp, c, factor, value);
      least = std::min(least, low);
      greatest = std::max(greatest, high);
      if (choice_probability[c] == 0.0) continue;
      const Meant p(choice_probability[c]);
      const double most = std::min(1.0, p.upper);
      sum += choice_probability[c];
      lower = add_down(lower, scale_down(low >= 0.0 ? p.lower : most, low));
      upper = add_up(upper, scale_up(high >= 0.0 ? most : p.lower, high));
    }
    value.lower[s] = sum == 0.0 ? least : lower;
    value.upper[s] = sum == 0.0 ? greatest : upper;
  }
  Evaluation out;
  out.lower = std::move(value.lower);
  out.upper = std::move(value.upper);
  return out;
}

}  // namespace quoll
