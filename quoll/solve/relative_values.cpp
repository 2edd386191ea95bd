#include "quoll/solve/relative_values.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quoll/solve/growth.hpp"
#include "quoll/solve/span_bounds.hpp"
#include "quoll/solve/sweep.hpp"

// Relative value iteration, made aperiodic. White 1963; Odoni 1969 for the bounds; Schweitzer 1971
// for the transformation; Puterman 1994, "Markov Decision Processes", sections 8.5.4 and 8.5.5.
//
//   1  h <- 0
//   2  d <- T h - h, T h(s) = max_a r(s,a) + E h(s'); pi(s) <- a maximising a; d = 0 at ends
//   3  max d - min d small enough in each part: go to 5
//   4  h <- h + d / 2 (half of T h: no period), less its value at one state of the part; go to 2
//   5  min d <= the gain of pi <= the best gain <= max d, once more with directed rounding
//
// Step 5 holds for any h. With P the matrix of a policy and P* its limiting average, P* P = P*, so
// that its gain is P* r = P* (r + P h - h): a mean of d's, each at most max d and for pi at least
// min d. h: value_, d: next_ - value_, pi: policy_.

namespace quoll {

namespace {

class RelativeIteration {
 public:
  RelativeIteration(const Mdp& mdp, const ClosedParts& parts, const SolveSettings& settings)
      : mdp_(mdp),
        parts_(parts),
        settings_(settings),
        scale_(mdp),
        value_(mdp.states(), 0.0),
        next_(mdp.states(), 0.0),
        policy_(mdp.states(), no_action) {}

  PartGains run() {
    PartGains out;
    for (;;) {
      const Residual residual{value_.data(), next_.data(), policy_.data()};
      sweep_all(mdp_, 1.0, residual, settings_.threads);  // step 2
      ++out.sweeps;
      const double span = largest_span();
      if (span <= std::max(0.9 * settings_.width, noise())) break;  // step 3
      out.stopped = out.sweeps >= settings_.max_sweeps ||
                    (settings_.keep_going && !settings_.keep_going({out.sweeps, 0, span}));
      if (out.stopped) break;
      advance();
    }
    out.value = std::move(value_);
    out.policy = std::move(policy_);
    return out;
  }

 private:
  double largest_span() {
    least_.assign(parts_.count, infinity);
    greatest_.assign(parts_.count, -infinity);
    size_ = 0.0;
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::uint32_t k = parts_.part[s];
      if (k == no_component) continue;
      const double growth = next_[s] - value_[s];
      least_[k] = std::min(least_[k], growth);
      greatest_[k] = std::max(greatest_[k], growth);
      size_ = std::max(size_, std::fabs(next_[s]));
    }
    double span = 0.0;
    for (std::uint32_t k = 0; k < parts_.count; ++k) {
      span = std::max(span, greatest_[k] - least_[k]);
    }
    return span;
  }

  double noise() const { return 2.0 * sweep_error(scale_, size_); }

  // Step 4. Values at ends stay 0, and with them whatever else their part has as zero.
  void advance() {
    base_.assign(parts_.count, 0.0);
    for (std::uint32_t k = 0; k < parts_.count; ++k) {
      const State zero = parts_.zero[k];
      base_[k] = 0.5 * (next_[zero] - value_[zero]);
    }
    for (State s = 0; s < mdp_.states(); ++s) {
      const std::uint32_t k = parts_.part[s];
      if (k == no_component || mdp_.terminal(s)) continue;
      value_[s] += 0.5 * (next_[s] - value_[s]) - base_[k];
    }
  }

  const Mdp& mdp_;
  const ClosedParts& parts_;
  const SolveSettings& settings_;
  ModelScale scale_;
  std::vector<double> value_, next_;
  std::vector<Action> policy_;
  std::vector<double> least_, greatest_, base_;  // per part
  double size_ = 0.0;
};

// Of a choice's reward as a rounded expectation over its outcomes.
double expectation_error(const Mdp& mdp, std::uint64_t c) {
  double size = 0.0;
  for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
    size = std::max(size, std::fabs(mdp.reward(c, o)));
  }
  const double outcomes = static_cast<double>(mdp.outcome_end(c) - mdp.outcome_begin(c));
  return (outcomes + 3.0) * 2.0 * half_ulp * size;
}

// Step 5, on the model as it was given.
void bound_gains(const Mdp& mdp, const ClosedParts& parts, PartGains& gains) {
  gains.lower.assign(parts.count, infinity);
  gains.upper.assign(parts.count, -infinity);
  const bool varied = !mdp.arrays().outcome_reward.empty();
  const auto growth = [&](double sign, State s, std::uint64_t c) {
    double reward = Meant(sign * mdp.reward(c)).upper;
    if (varied) reward = add_up(reward, expectation_error(mdp, c));
    return growth_up(mdp, gains.value, sign, s, c, reward);
  };
  for (State s = 0; s < mdp.states(); ++s) {
    const std::uint32_t k = parts.part[s];
    if (k == no_component) continue;
    double least = 0.0, greatest = 0.0;
    if (!mdp.terminal(s)) {
      least = -growth(-1.0, s, mdp.choice_begin(s) + gains.policy[s]);
      greatest = -infinity;
      for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
        if (!parts.inside.empty() && !parts.inside[c]) continue;
        greatest = std::max(greatest, growth(1.0, s, c));
      }
    }
    gains.lower[k] = std::min(gains.lower[k], least + 0.0);
    gains.upper[k] = std::max(gains.upper[k], greatest + 0.0);
  }
}

}  // namespace

Result<InnerModel> inner_model(const Mdp& mdp, const ClosedParts& parts,
                               const std::vector<bool>& ended) {
  MdpArrays to;
  std::vector<std::uint64_t> origin;
  std::uint64_t most_actions = 1;
  to.choice_begin.push_back(0);
  to.outcome_begin.push_back(0);
  for (State s = 0; s < mdp.states(); ++s) {
    const bool end = mdp.terminal(s) || (!ended.empty() && ended[s]);
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s) && !end; ++c) {
      if (parts.part[s] == no_component || (!parts.inside.empty() && !parts.inside[c])) continue;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        to.next.push_back(mdp.next(o));
        to.probability.push_back(mdp.probability(o));
      }
      to.outcome_begin.push_back(to.next.size());
      to.reward.push_back(mdp.reward(c));
      to.action.push_back(static_cast<std::uint32_t>(origin.size() - to.choice_begin.back()));
      origin.push_back(c);
    }
    most_actions = std::max(most_actions, origin.size() - to.choice_begin.back());
    to.choice_begin.push_back(origin.size());
  }
  to.start = {0};
  to.state_names = Names::numbered("", mdp.states());
  to.action_names = Names::numbered("", most_actions);
  Result<Mdp> made = Mdp::make(std::move(to));
  if (!made) return made.error();
  return InnerModel{std::move(*made), std::move(origin)};
}

Result<PartGains> part_gains(const Mdp& mdp, const ClosedParts& parts,
                             const SolveSettings& settings) {
  PartGains gains;
  if (parts.inside.empty()) {
    gains = RelativeIteration(mdp, parts, settings).run();
  } else {
    const Result<InnerModel> inner = inner_model(mdp, parts);
    if (!inner) return inner.error();
    gains = RelativeIteration(inner->mdp, parts, settings).run();
    for (State s = 0; s < mdp.states(); ++s) {
      Action& action = gains.policy[s];
      if (action == no_action) continue;
      const std::uint64_t c = inner->origin[inner->mdp.choice_begin(s) + action];
      action = static_cast<Action>(c - mdp.choice_begin(s));
    }
  }
  bound_gains(mdp, parts, gains);
  return gains;
}

}  // namespace quoll
