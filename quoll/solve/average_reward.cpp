#include "quoll/solve/average_reward.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/relative_values.hpp"
#include "quoll/solve/rounding.hpp"

// Average reward of any finite model. Puterman 1994, "Markov Decision Processes", chapters 8 and 9;
// de Alfaro 1997, "Formal verification of probabilistic systems", section 5.4, for the classes.
//
//   1  classes: the maximal end components, and all ends together
//   2  one class: its gain is that of every state; relative values over all states
//   3  more: the gain of staying in each, g(k), by relative values over the choices inside
//   4  join each class to one state, which may stay (earns g(k), and all is over) or take a choice
//      that may leave; the optimal total reward is the gain. Each of these policies ends: a set of
//      states in which one could go on for ever would have been part of a class
//   5  policy: stay, or move to the state of the class where the choice is taken by the shortest
//      way, which is met with probability 1
//
// Bounds: g is earned at most once, so that an error of w in it changes no value by more than w.

namespace quoll {

namespace {

// Whether the choices of a class, or of the model, cannot avoid some state for ever: then every
// policy has one recurrent class. Candidates are tried for a bounded time.
bool has_unavoidable_state(const Mdp& mdp, const EndComponents& parts) {
  constexpr std::uint64_t most_outcomes = 20'000'000;
  std::uint64_t looked_at = 0;
  for (State s = 0; s < mdp.states() && looked_at < most_outcomes; ++s) {
    if (parts.component[s] == no_component) continue;
    std::vector<bool> allowed = parts.inside;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) allowed[c] = false;
    if (maximal_end_components(mdp, allowed).count == 0) return true;
    looked_at += mdp.outcomes();
  }
  return false;
}

class Averaging {
 public:
  Averaging(const Mdp& mdp, const SolveSettings& settings)
      : mdp_(mdp), settings_(settings), components_(maximal_end_components(mdp)) {}

  Result<AverageSolution> run() {
    find_classes();
    const Result<void> solved = out_.classes.size() == 1 ? solve_one() : solve_many();
    if (!solved) return solved.error();
    for (State s = 0; s < mdp_.states(); ++s) {
      if (out_.lower[s] == out_.upper[s]) continue;
      out_.gap = std::max(out_.gap, add_up(out_.upper[s], -out_.lower[s]));
    }
    out_.converged = out_.completed && out_.gap <= settings_.width;
    return std::move(out_);
  }

 private:
  // Step 1.
  void find_classes() {
    out_.part = components_.component;
    out_.classes.resize(components_.count);
    for (State s = static_cast<State>(mdp_.states()); s-- > 0;) {
      if (mdp_.terminal(s)) {
        if (out_.classes.size() == components_.count) out_.classes.emplace_back().ends = true;
        out_.part[s] = components_.count;
      }
      if (out_.part[s] == no_component) continue;
      out_.classes[out_.part[s]].first = s;
      ++out_.classes[out_.part[s]].states;
    }
    out_.structure = structure();
  }

  ChainStructure structure() const {
    if (out_.classes.size() > 1) return ChainStructure::multichain;
    if (out_.classes[0].ends || has_unavoidable_state(mdp_, components_)) {
      return ChainStructure::unichain;
    }
    return out_.classes[0].states == mdp_.states() ? ChainStructure::communicating
                                                   : ChainStructure::weakly_communicating;
  }

  ClosedParts closed_parts() const {
    ClosedParts parts;
    parts.part = out_.part;
    parts.count = static_cast<std::uint32_t>(out_.classes.size());
    for (const StayingClass& one : out_.classes) parts.zero.push_back(one.first);
    return parts;
  }

  Result<PartGains> gains_of(const ClosedParts& parts) {
    Result<PartGains> gains = part_gains(mdp_, parts, settings_);
    if (!gains) return gains;
    out_.sweeps = gains->sweeps;
    out_.completed = !gains->stopped;
    for (std::uint32_t k = 0; k < parts.count; ++k) {
      out_.classes[k].lower = gains->lower[k];
      out_.classes[k].upper = gains->upper[k];
    }
    return gains;
  }

  // Step 2.
  Result<void> solve_one() {
    ClosedParts parts = closed_parts();
    parts.part.assign(mdp_.states(), 0);
    Result<PartGains> gains = gains_of(parts);
    if (!gains) return gains.error();
    StayingClass& only = out_.classes[0];
    only.stays = true;
    if (only.ends) only.lower = only.upper = 0.0;  // every policy comes to an end
    out_.lower.assign(mdp_.states(), only.lower);
    out_.upper.assign(mdp_.states(), only.upper);
    out_.bias = std::move(gains->value);
    out_.policy = std::move(gains->policy);
    return {};
  }

  // Steps 3 to 5.
  Result<void> solve_many() {
    ClosedParts parts = closed_parts();
    parts.inside = components_.inside;
    Result<PartGains> gains = gains_of(parts);
    if (!gains) return gains.error();
    out_.bias = std::move(gains->value);
    out_.policy = std::move(gains->policy);
    const Result<Mdp> joined = join();
    if (!joined) return joined.error();
    SolveSettings settings;
    settings.width = 0.1 * settings_.width;
    settings.threads = settings_.threads;
    const Result<Solution> total = solve(*joined, settings);
    if (!total) return total.error();
    read_values(*total);
    return choose(*joined, *total);
  }

  double gain(std::uint32_t k) const {
    return 0.5 * out_.classes[k].lower + 0.5 * out_.classes[k].upper;
  }

  // Largest distance of a class's gain from its bounds.
  double doubt() const {
    double largest = 0.0;
    for (std::uint32_t k = 0; k < components_.count; ++k) {
      largest = std::max(largest, add_up(gain(k), -out_.classes[k].lower));
      largest = std::max(largest, add_up(out_.classes[k].upper, -gain(k)));
    }
    return largest;
  }

  // Step 4. States of the joined model: the components, the states in no class, and one end.
  Result<Mdp> join() {
    node_.assign(mdp_.states(), 0);
    std::vector<State> states;  // by node
    for (State s = 0; s < mdp_.states(); ++s) {
      if (components_.component[s] != no_component) states.push_back(s);
    }
    std::stable_sort(states.begin(), states.end(), [&](State a, State b) {
      return components_.component[a] < components_.component[b];
    });
    State nodes = components_.count;
    for (const State s : states) node_[s] = components_.component[s];
    for (State s = 0; s < mdp_.states(); ++s) {
      if (out_.part[s] != no_component) continue;
      node_[s] = nodes++;
      states.push_back(s);
    }
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) node_[s] = nodes;
    }
    return build(states, nodes);
  }

  Result<Mdp> build(const std::vector<State>& states, State end) {
    MdpArrays to;
    to.choice_begin.push_back(0);
    to.outcome_begin.push_back(0);
    std::uint64_t most_actions = 1;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const bool first = i == 0 || node_[states[i]] != node_[states[i - 1]];
      if (first && i > 0) to.choice_begin.push_back(origin_.size());
      if (first && node_[states[i]] < components_.count) {
        to.next.push_back(end);
        to.probability.push_back(1.0);
        add_choice(to, {states[i], 0, true}, gain(node_[states[i]]));
      }
      add_leaving(to, states[i]);
      most_actions = std::max(most_actions, origin_.size() - to.choice_begin.back());
    }
    to.choice_begin.push_back(origin_.size());
    to.choice_begin.push_back(origin_.size());  // the end
    to.state_names = Names::numbered("", to.choice_begin.size() - 1);
    to.action_names = Names::numbered("", most_actions);
    return Mdp::make(std::move(to));
  }

  void add_leaving(MdpArrays& to, State s) {
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (components_.inside[c]) continue;
      for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
        to.next.push_back(node_[mdp_.next(o)]);
        to.probability.push_back(mdp_.probability(o));
      }
      add_choice(to, {s, static_cast<Action>(c - mdp_.choice_begin(s)), false}, 0.0);
    }
  }

  // What a choice of the joined model is: to stay, or an action of a state.
  struct Origin {
    State state;
    Action action;
    bool stay;
  };

  void add_choice(MdpArrays& to, Origin origin, double reward) {
    to.outcome_begin.push_back(to.next.size());
    to.action.push_back(static_cast<std::uint32_t>(origin_.size() - to.choice_begin.back()));
    to.reward.push_back(reward);
    origin_.push_back(origin);
  }

  void read_values(const Solution& total) {
    const double w = doubt();
    out_.lower.assign(mdp_.states(), 0.0);
    out_.upper.assign(mdp_.states(), 0.0);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      out_.lower[s] = add_down(total.lower[node_[s]], -w);
      out_.upper[s] = add_up(total.upper[node_[s]], w);
    }
  }

  // Step 5.
  Result<void> choose(const Mdp& joined, const Solution& total) {
    if (out_.classes.size() > components_.count) out_.classes.back().stays = true;
    std::vector<bool> leaving(mdp_.states(), false);
    for (State n = 0; n + 1 < joined.states(); ++n) {
      const Origin& chosen = origin_[joined.choice_begin(n) + total.policy[n]];
      if (chosen.stay) {
        out_.classes[n].stays = true;
      } else {
        out_.policy[chosen.state] = chosen.action;
        leaving[chosen.state] = true;
      }
    }
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::uint32_t k = out_.part[s];
      if (k != no_component && out_.classes[k].stays) {
        out_.lower[s] = std::max(out_.lower[s], out_.classes[k].lower);
        continue;
      }
      out_.bias[s] = std::numeric_limits<double>::quiet_NaN();
    }
    return move_to(leaving);
  }

  // The other states of classes that are left go the shortest way to where that happens.
  Result<void> move_to(const std::vector<bool>& leaving) {
    ClosedParts left = closed_parts();
    bool any = false;
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::uint32_t k = left.part[s];
      if (k != no_component && out_.classes[k].stays) left.part[s] = no_component;
      any = any || left.part[s] != no_component;
    }
    if (!any) return {};
    left.inside = components_.inside;
    const Result<InnerModel> inner = inner_model(mdp_, left, leaving);
    if (!inner) return inner.error();
    const std::vector<std::uint32_t> moves = moves_to_end(inner->mdp);
    const Mdp& model = inner->mdp;
    for (State s = 0; s < mdp_.states(); ++s) {
      for (std::uint64_t c = model.choice_begin(s); c < model.choice_end(s); ++c) {
        bool nearer = false;
        for (std::uint64_t o = model.outcome_begin(c); o < model.outcome_end(c); ++o) {
          nearer = nearer || moves[model.next(o)] < moves[s];
        }
        if (!nearer) continue;
        out_.policy[s] = static_cast<Action>(inner->origin[c] - mdp_.choice_begin(s));
        break;
      }
    }
    return {};
  }

  const Mdp& mdp_;
  const SolveSettings& settings_;
  EndComponents components_;
  std::vector<State> node_;     // per state of the model
  std::vector<Origin> origin_;  // per choice of the joined model
  AverageSolution out_;
};

}  // namespace

Result<AverageSolution> solve_average(const Mdp& mdp, const SolveSettings& settings) {
  if (mdp.alternating()) {
    return Error{"--average", 0, 0,
                 "two players move in turn here: their average reward is not solved", ""};
  }
  if (settings.maximise) return Averaging(mdp, settings).run();
  const Result<Mdp> negated = negated_rewards(mdp);
  if (!negated) return negated.error();
  Result<AverageSolution> result = Averaging(*negated, settings).run();
  if (!result) return result;
  turn_signs(result->lower, result->upper);
  for (double& bias : result->bias) bias = 0.0 - bias;
  for (StayingClass& one : result->classes) {
    std::swap(one.lower, one.upper);
    one.lower = 0.0 - one.lower;
    one.upper = 0.0 - one.upper;
  }
  return result;
}

}  // namespace quoll
