#include "quoll/solve/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/backward.hpp"
#include "quoll/solve/both_sides.hpp"
#include "quoll/solve/chain_elimination.hpp"
#include "quoll/solve/functional_graph.hpp"
#include "quoll/solve/induced.hpp"
#include "quoll/solve/methods.hpp"

namespace quoll {

namespace {

void conclude(const Mdp& mdp, double width, Evaluation& evaluation) {
  Solution bounds;  // what counts as close is the same for solutions
  bounds.lower.swap(evaluation.lower);
  bounds.upper.swap(evaluation.upper);
  evaluation.gap = largest_gap(mdp, bounds);
  evaluation.converged = evaluation.gap <= width;
  evaluation.lower.swap(bounds.lower);
  evaluation.upper.swap(bounds.upper);
}

Error policy_error(std::string expected) {
  return Error{"--policy", 0, 0, std::move(expected), ""};
}

bool any_unknown(const Mdp& mdp, std::span<const double> choice_probability) {
  for (State s = 0; s < mdp.states(); ++s) {
    bool known = mdp.terminal(s);
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      known = known || choice_probability[c] > 0.0;
    }
    if (!known) return true;
  }
  return false;
}

// Discounted: the unknown states are tried at their worst and at their best.
Result<Evaluation> evaluate_discounted(const Mdp& mdp, std::span<const double> choice_probability,
                                       const SolveSettings& settings) {
  const auto [low, high] = mdp.reward_bounds();
  const bool unknown = any_unknown(mdp, choice_probability);
  Evaluation out;
  for (const bool best : {false, true}) {
    if (best && !unknown) break;
    const double reward = best ? std::max(0.0, high) : std::min(0.0, low);
    const Result<Mdp> chain = induced_model(mdp, choice_probability, reward);
    if (!chain) return chain.error();
    Result<Solution> solution = solve(*chain, settings, "value-iteration");
    if (!solution) return solution.error();
    if (!best) out.lower = std::move(solution->lower);
    if (best || !unknown) out.upper = std::move(solution->upper);
  }
  return out;
}

// A game in which states come again: both players draw by the same probabilities.
Result<Evaluation> evaluate_both_sides(const Mdp& mdp, std::span<const double> choice_probability,
                                       const SolveSettings& settings) {
  const Result<Mdp> sides = both_sides(mdp);
  if (!sides) return sides.error();
  std::vector<double> twice(choice_probability.begin(), choice_probability.end());
  twice.insert(twice.end(), choice_probability.begin(), choice_probability.end());
  Result<Evaluation> out = evaluate_discounted(*sides, twice, settings);
  if (!out) return out;
  out->lower.resize(mdp.states());
  out->upper.resize(mdp.states());
  return out;
}

// What can follow a state of a chain that never ends.
enum Fate : std::uint8_t { losing = 1, gaining = 2, undecided = 4 };

// Marks each recurrent class without an end by what it earns; classes that earn nothing become
// `ended`.
std::vector<std::uint8_t> fates(const Mdp& mdp, std::span<const double> choice_probability,
                                const Mdp& chain, std::vector<bool>& ended) {
  const EndComponents classes = maximal_end_components(chain);
  std::vector<double> least(classes.count, infinity), greatest(classes.count, -infinity);
  for (State s = 0; s < chain.states(); ++s) {
    const std::uint32_t k = classes.component[s];
    if (k == no_component) continue;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (choice_probability[c] == 0.0) continue;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        least[k] = std::min(least[k], mdp.reward(c, o));
        greatest[k] = std::max(greatest[k], mdp.reward(c, o));
      }
    }
  }
  std::vector<std::uint8_t> fate(chain.states(), 0);
  for (State s = 0; s < chain.states(); ++s) {
    const std::uint32_t k = classes.component[s];
    if (k == no_component) continue;
    ended[s] = least[k] == 0.0 && greatest[k] == 0.0;
    if (ended[s]) continue;
    fate[s] = greatest[k] <= 0.0 ? losing : least[k] >= 0.0 ? gaining : undecided;
  }
  return fate;
}

// Passes fates on to all states they can follow from.
void spread(const Mdp& chain, std::vector<std::uint8_t>& fate) {
  const std::size_t states = chain.states();
  bool backward = true;
  for (bool changed = true; changed; backward = !backward) {
    changed = false;
    for (std::size_t i = 0; i < states; ++i) {
      const State s = static_cast<State>(backward ? states - 1 - i : i);
      if (chain.terminal(s)) continue;
      std::uint8_t all = fate[s];
      const std::uint64_t c = chain.choice_begin(s);
      for (std::uint64_t o = chain.outcome_begin(c); o < chain.outcome_end(c); ++o) {
        all = static_cast<std::uint8_t>(all | fate[chain.next(o)]);
      }
      changed = changed || all != fate[s];
      fate[s] = all;
    }
  }
}

// Values of the states without a fate: they all end. By elimination; by sweeps where that is too
// much work.
Evaluation evaluate_ending(const Mdp& chain, const std::vector<std::uint8_t>& fate,
                           const SolveSettings& settings) {
  std::vector<std::uint8_t> live(chain.states(), 0);
  for (State s = 0; s < chain.states(); ++s) live[s] = fate[s] == 0 && !chain.terminal(s) ? 1 : 0;
  bool stopped = false;
  const auto keep_going = [&](std::uint64_t eliminated) {
    stopped = settings.keep_going && !settings.keep_going({0, eliminated, infinity});
    return !stopped;
  };
  std::optional<ChainValues> values = eliminate_chain(chain, live, keep_going);
  if (!values && !stopped) {
    Solution solution = solve_ending(chain, settings, "policy-iteration");
    return {std::move(solution.lower), std::move(solution.upper)};
  }
  if (!values) values = unbounded_values(live);
  return {std::move(values->lower), std::move(values->upper)};
}

Result<Evaluation> evaluate_undiscounted(const Mdp& mdp, std::span<const double> choice_probability,
                                         const SolveSettings& settings) {
  const Result<Mdp> chain = induced_model(mdp, choice_probability, std::nullopt);
  if (!chain) return chain.error();
  std::vector<bool> ended(mdp.states(), false);
  std::vector<std::uint8_t> fate = fates(mdp, choice_probability, *chain, ended);
  for (State s = 0; s < mdp.states(); ++s) {
    if (chain->terminal(s) && !mdp.terminal(s)) fate[s] = undecided;  // no action known
  }
  spread(*chain, fate);
  const Result<Mdp> ending = induced_model(mdp, choice_probability, std::nullopt, ended);
  if (!ending) return ending.error();
  Evaluation out = evaluate_ending(*ending, fate, settings);
  for (State s = 0; s < mdp.states(); ++s) {
    if (fate[s] == 0) continue;
    out.lower[s] = fate[s] == gaining ? infinity : -infinity;
    out.upper[s] = fate[s] == losing ? -infinity : infinity;
  }
  return out;
}

}  // namespace

Result<Evaluation> evaluate(const Mdp& mdp, std::span<const double> choice_probability,
                            double discount, double width, const KeepGoing& keep_going) {
  if (choice_probability.size() != mdp.choices()) {
    return policy_error("one probability per state and action was expected");
  }
  for (State s = 0; s < mdp.states(); ++s) {
    double sum = 0.0;
    bool negative = false;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      sum += choice_probability[c];
      negative = negative || !(choice_probability[c] >= 0.0);
    }
    if (mdp.terminal(s) || (sum == 0.0 && !negative)) continue;
    if (negative || !(std::fabs(sum - 1.0) <= 1e-9)) {
      return policy_error("probabilities that sum to 1 were expected in state " +
                          mdp.state_name(s));
    }
  }
  SolveSettings settings;
  settings.width = width;
  settings.discount = discount;
  settings.keep_going = keep_going;
  const Result<double> valid = discount_in_use(mdp, settings);
  if (!valid) return valid.error();
  const bool returning = mdp.alternating() && discount < 1.0 && !returning_states(mdp).empty();
  Result<Evaluation> out = returning ? evaluate_both_sides(mdp, choice_probability, settings)
                           : mdp.alternating() ? evaluate_game(mdp, choice_probability, discount)
                           : discount == 1.0
                               ? evaluate_undiscounted(mdp, choice_probability, settings)
                               : evaluate_discounted(mdp, choice_probability, settings);
  if (out) conclude(mdp, width, *out);
  return out;
}

Result<Evaluation> evaluate(const Mdp& mdp, std::span<const Action> policy, double discount,
                            double width, const KeepGoing& keep_going) {
  if (policy.size() != mdp.states()) return policy_error("one action per state was expected");
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s) || policy[s] == no_action || policy[s] < mdp.actions(s)) continue;
    return policy_error("state " + mdp.state_name(s) + " has " + std::to_string(mdp.actions(s)) +
                        " actions, not one numbered " + std::to_string(policy[s]));
  }
  if (!mdp.deterministic() || mdp.alternating()) {
    return evaluate(mdp, as_probabilities(mdp, policy), discount, width, keep_going);
  }
  SolveSettings settings;
  settings.discount = discount;
  const Result<double> valid = discount_in_use(mdp, settings);
  if (!valid) return valid.error();
  GraphValues values = evaluate_graph(mdp, policy, Discount(discount));
  Evaluation out{std::move(values.lower), std::move(values.upper)};
  conclude(mdp, width, out);
  return out;
}

std::vector<double> uniform_policy(const Mdp& mdp) {
  std::vector<double> probability(mdp.choices(), 0.0);
  for (State s = 0; s < mdp.states(); ++s) {
    const std::uint64_t begin = mdp.choice_begin(s);
    const std::uint64_t end = mdp.choice_end(s);
    for (std::uint64_t c = begin; c < end; ++c) {
      probability[c] = 1.0 / static_cast<double>(end - begin);
    }
  }
  return probability;
}

}  // namespace quoll
