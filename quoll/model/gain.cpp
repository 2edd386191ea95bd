// What an end component earns per move when one never leaves it: relative value iteration, made
// aperiodic, with span bounds. Puterman 1994, "Markov Decision Processes", sections 8.5.4
// and 8.5.5.
//
//   for each maximal end component with a positive reward, over its choices that stay inside:
//     1. x := 0
//     2. d(s) := max_a r(s,a) + sum of p(s'|s,a) (x(s') - x(s)), pi(s) := a maximising a
//     3. min d > 0: every state gains for ever;  max d <= 0: none does
//     4. x := x + d / 2 (half of T x: no period), less x(first); back to 2, a fixed number of times
//     5. a set of states that pi does not leave and where d > 0 gains for ever; else undecided
//
//   x -> value_, d -> growth_, pi -> choice_; 0 is replaced by what rounding can amount to

#include <algorithm>
#include <cmath>

#include "quoll/model/graph.hpp"

namespace quoll {

namespace {

constexpr double rounding = 1e-12;

class RelativeValues {
 public:
  RelativeValues(const Mdp& mdp, const std::vector<bool>& inside)
      : mdp_(mdp),
        inside_(inside),
        value_(mdp.states(), 0.0),
        growth_(mdp.states(), 0.0),
        choice_(mdp.states(), 0),
        kept_(mdp.states(), false) {}

  Gain of(std::span<const State> members) {
    constexpr std::uint64_t most_sweeps = 10'000;
    constexpr std::uint64_t most_terms = 1'000'000'000;
    const std::uint64_t terms = measure(members);
    const std::uint64_t sweeps = std::clamp<std::uint64_t>(most_terms / terms, 50, most_sweeps);
    for (std::uint64_t k = 0; k < sweeps; ++k) {
      if (k > 0) advance(members);
      const auto [least, greatest] = grow(members);
      if (least > doubt_) break;
      if (greatest <= doubt_) return Gain::none;  // step 3
    }
    return keep_gaining(members) ? Gain::certain : Gain::undecided;
  }

  double value(State s) const { return value_[s]; }

  /// After Gain::certain: the choices of pi in the states found.
  std::vector<bool> gaining_choices() const {
    std::vector<bool> chosen(mdp_.choices(), false);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (kept_[s]) chosen[choice_[s]] = true;
    }
    return chosen;
  }

 private:
  // Number of outcomes inside; notes the sizes that rounding depends on.
  std::uint64_t measure(std::span<const State> members) {
    std::uint64_t terms = 0;
    std::uint64_t widest = 0;
    reward_size_ = 0.0;
    for (const State s : members) {
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (!inside_[c]) continue;
        const std::uint64_t width = mdp_.outcome_end(c) - mdp_.outcome_begin(c);
        terms += width;
        widest = std::max(widest, width);
        reward_size_ = std::max(reward_size_, std::fabs(mdp_.reward(c)));
      }
    }
    relative_doubt_ = rounding + 0x1p-50 * static_cast<double>(widest);
    return terms;
  }

  // Step 2: least and greatest d.
  std::pair<double, double> grow(std::span<const State> members) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double least = infinity;
    double greatest = -infinity;
    double low = infinity;
    double high = -infinity;
    for (const State s : members) {
      growth_[s] = -infinity;
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (!inside_[c]) continue;
        double growth = mdp_.reward(c);
        for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
          growth += mdp_.probability(o) * (value_[mdp_.next(o)] - value_[s]);
        }
        if (!(growth > growth_[s])) continue;
        growth_[s] = growth;
        choice_[s] = c;
      }
      least = std::min(least, growth_[s]);
      greatest = std::max(greatest, growth_[s]);
      low = std::min(low, value_[s]);
      high = std::max(high, value_[s]);
    }
    doubt_ = relative_doubt_ * (reward_size_ + (high - low));
    return {least, greatest};
  }

  // Step 4.
  void advance(std::span<const State> members) {
    const double base = 0.5 * growth_[members.front()];
    for (const State s : members) value_[s] += 0.5 * growth_[s] - base;
  }

  // Step 5: the largest set of members that pi keeps to and that grow; false if it is empty.
  bool keep_gaining(std::span<const State> members) {
    std::size_t left = 0;
    for (const State s : members) {
      kept_[s] = growth_[s] > doubt_;
      left += kept_[s];
    }
    bool forward = true;
    for (bool changed = true; changed && left > 0; forward = !forward) {
      changed = false;
      for (std::size_t i = 0; i < members.size(); ++i) {
        const State s = members[forward ? i : members.size() - 1 - i];
        if (!kept_[s] || stays(s)) continue;
        kept_[s] = false;
        --left;
        changed = true;
      }
    }
    return left > 0;
  }

  bool stays(State s) const {
    for (std::uint64_t o = mdp_.outcome_begin(choice_[s]); o < mdp_.outcome_end(choice_[s]); ++o) {
      if (!kept_[mdp_.next(o)]) return false;
    }
    return true;
  }

  const Mdp& mdp_;
  const std::vector<bool>& inside_;
  std::vector<double> value_, growth_;
  std::vector<std::uint64_t> choice_;
  std::vector<bool> kept_;
  double reward_size_ = 0.0, relative_doubt_ = 0.0, doubt_ = 0.0;
};

// The states of each component that holds a positive reward, component after component.
std::vector<State> hopeful_states(const Mdp& mdp, const EndComponents& parts) {
  std::vector<bool> hopeful(parts.count, false);
  for (State s = 0; s < mdp.states(); ++s) {
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      if (parts.inside[c] && mdp.reward(c) > 0.0) hopeful[parts.component[s]] = true;
    }
  }
  std::vector<State> states;
  for (State s = 0; s < mdp.states(); ++s) {
    if (parts.component[s] != no_component && hopeful[parts.component[s]]) states.push_back(s);
  }
  std::stable_sort(states.begin(), states.end(),
                   [&](State a, State b) { return parts.component[a] < parts.component[b]; });
  return states;
}

// Calls found(members, gain, values) for each such component until it returns false.
template <class Found>
void for_each_gain(const Mdp& mdp, const EndComponents& parts, Found found) {
  const std::vector<State> states = hopeful_states(mdp, parts);
  RelativeValues values(mdp, parts.inside);
  for (std::size_t begin = 0, end = 0; begin < states.size(); begin = end) {
    const std::uint32_t component = parts.component[states[begin]];
    while (end < states.size() && parts.component[states[end]] == component) ++end;
    const auto members = std::span(states).subspan(begin, end - begin);
    if (!found(members, values.of(members), values)) return;
  }
}

}  // namespace

std::vector<Gain> component_gains(const Mdp& mdp, const EndComponents& parts) {
  std::vector<Gain> gains(parts.count, Gain::none);
  for_each_gain(mdp, parts, [&](std::span<const State> members, Gain gain, const RelativeValues&) {
    gains[parts.component[members.front()]] = gain;
    return true;
  });
  return gains;
}

std::vector<double> component_heights(const Mdp& mdp, const EndComponents& parts) {
  std::vector<double> height(mdp.states(), 0.0);
  for_each_gain(mdp, parts,
                [&](std::span<const State> members, Gain, const RelativeValues& values) {
                  for (const State s : members) height[s] = values.value(s);
                  return true;
                });
  return height;
}

std::vector<State> gaining_class(const Mdp& mdp, const EndComponents& parts) {
  std::vector<bool> chosen;
  for_each_gain(mdp, parts, [&](std::span<const State>, Gain gain, const RelativeValues& values) {
    if (gain == Gain::certain) chosen = values.gaining_choices();
    return gain != Gain::certain;
  });
  std::vector<State> states;
  if (chosen.empty()) return states;
  const EndComponents classes = maximal_end_components(mdp, chosen);
  for (State s = 0; s < mdp.states(); ++s) {
    if (classes.component[s] == 0) states.push_back(s);
  }
  return states;
}

}  // namespace quoll
