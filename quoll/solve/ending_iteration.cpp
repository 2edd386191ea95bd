#include "quoll/solve/ending_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "quoll/model/graph.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"
#include "quoll/solve/total_certificate.hpp"
#include "quoll/solve/wavefront.hpp"

// Total reward without discounting, for policies that end. Bertsekas and Tsitsiklis 1991
// (stochastic shortest paths); upper bound by guess and inductive proof: Hartmanns and Kaminski
// 2020 (optimistic value iteration). Rewards may have both signs.
//
//   1  pi <- a policy that ends with probability 1 from every live state; where the ends are far,
//   the
//      one to which a wave of sweeps from the ends leads, with its V, if that one ends too
//   2  evaluate pi in place, at first roughly; switch an action only if it is better by more than
//      rounding: with accurate values pi then keeps ending, because no cycle gains
//   3  repeat until nothing switches after an accurate evaluation V; if rough values led to a
//      policy that does not end, begin again with accurate ones only
//   4  stop if the values of policies that do not end keep growing: nothing is certified then
//   5  prove V - e w <= V_pi and V* <= V + e w (total_certificate.hpp)
//
// pi: solution_.policy and rows_, V: value_.

namespace quoll {

namespace {

constexpr std::uint64_t trial = 100;  // sweeps after which endlessness is looked for

std::vector<State> live_list(const Ending& ending) {
  std::vector<State> list;
  for (std::size_t s = 0; s < ending.live.size(); ++s) {
    if (ending.live[s] != 0) list.push_back(static_cast<State>(s));
  }
  return list;
}

}  // namespace

EndingIteration::EndingIteration(const Mdp& mdp, const SolveSettings& settings, Ending ending)
    : mdp_(mdp),
      settings_(settings),
      ending_(std::move(ending)),
      all_(live_list(ending_)),
      part_(all_),
      value_(mdp.states(), 0.0),
      rows_(mdp),
      place_(mdp.states(), unreached) {
  solution_.policy = ending_.policy;
  for (State s = 0; s < mdp.states(); ++s) {
    if (ending_.live[s] == 0 && !mdp.terminal(s)) value_[s] = -infinity;
  }
  restart();
  const auto [low, high] = mdp.reward_bounds();
  reward_size_ = std::max(std::fabs(low), std::fabs(high));
}

void EndingIteration::restart() {
  endless_ = 0;
  for (const State s : part_) {
    value_[s] = 0.0;
    take(s, ending_.policy[s]);
  }
}

void EndingIteration::take(State s, Action a) {
  solution_.policy[s] = a;
  rows_.take(s, a);
}

void EndingIteration::run(bool patient) {
  if (!patient) follow_wave();
  iterate(patient);
  failed_ = endless_ > 0;
}

void EndingIteration::run_part(std::span<const State> part) {
  part_ = part;
  if (part.size() == 1) return choose_alone(part.front());
  restart();
  iterate(false);
  if (endless_ > 0) {
    restart();
    iterate(true);
  }
  failed_ = failed_ || endless_ > 0;
}

void EndingIteration::iterate(bool patient) {
  std::uint64_t patience = patient ? settings_.max_sweeps : 10'000;
  while (go_on_) {
    const double change = evaluate(patience);
    if (endless_ > (patient ? 0u : 20u)) break;  // step 4
    const double improvement = improve();
    count(part_.size(), std::max(change, improvement));
    if (improvement == 0.0 && change <= rounding()) break;
    if (!patient) {
      patience = improvement > 0.0 ? 100 : std::min<std::uint64_t>(2 * patience, 10'000);
    }
  }
}

// All of step 2 and 3 for a state that returns to no other: waiting in it is averaged out.
void EndingIteration::choose_alone(State s) {
  double best = -infinity;
  for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
    double rest = mdp_.reward(c), away = 0.0;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (mdp_.next(o) == s) continue;
      away += mdp_.probability(o);
      rest += mdp_.probability(o) * value_[mdp_.next(o)];
    }
    if (away == 0.0 || !(rest / away > best)) continue;
    best = rest / away;
    take(s, static_cast<Action>(c - mdp_.choice_begin(s)));
  }
  value_[s] = best;
  count(1, 0.0);
}

void EndingIteration::count(std::uint64_t updates, double change) {
  solution_.backups += updates;
  updates_ += updates;
  if (all_.empty() || updates_ < all_.size()) return;
  solution_.sweeps += updates_ / all_.size();
  updates_ %= all_.size();
  go_on_ = go_on_ && may_continue(settings_, solution_, change);
}

double EndingIteration::rounding() const {
  double size = reward_size_;
  for (const State s : part_) size = std::max(size, std::fabs(value_[s]));
  return 8.0 * half_ulp * size;
}

// Step 1. The guess is worse than what states are worth, so that the wave does not run after it.
void EndingIteration::follow_wave() {
  constexpr std::size_t least_bands = 8;
  constexpr std::uint64_t most_sweeps = 500;
  std::vector<double> value = value_;
  std::vector<Action> policy = solution_.policy;
  Wavefront wave(mdp_, value, settings_.threads);
  if (wave.bands() < least_bands) return;
  wave.guess(2.0 * std::min(0.0, mdp_.reward_bounds().first));
  const double aim = 32.0 * half_ulp * reward_size_ * static_cast<double>(4 * wave.bands());
  std::uint64_t updates = 0;
  const bool done = wave.iterate(1.0, aim, policy, [&](std::uint64_t updated, double change) {
    updates += updated;
    solution_.backups += updated;
    solution_.sweeps = updates / mdp_.states();
    go_on_ = may_continue(settings_, solution_, change);
    return go_on_ && updates < most_sweeps * mdp_.states();
  });
  if (!done) return;
  for (const State s : part_) rows_.take(s, policy[s]);
  if (ends()) {
    value_ = std::move(value);
    solution_.policy = std::move(policy);
  } else {
    for (const State s : part_) rows_.take(s, solution_.policy[s]);
  }
}

// Step 2, first half. Returns the last change. Counts evaluations in a row that were given up
// after a trial because the policy does not end.
double EndingIteration::evaluate(std::uint64_t most_sweeps) {
  const double goal = rounding();
  bool backward = true;
  double change = infinity;
  for (std::uint64_t k = 0; go_on_ && change > goal && k < most_sweeps; ++k) {
    change = 0.0;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      const State s = part_[backward ? part_.size() - 1 - i : i];
      const double value = rows_.backup(1.0, value_.data(), s);
      change = std::max(change, std::fabs(value - value_[s]));
      value_[s] = value;
    }
    backward = !backward;
    count(part_.size(), change);
    if (k + 1 == trial && change > goal && go_on_) {
      if (!ends()) {
        ++endless_;
        return change;
      }
      endless_ = 0;
    }
  }
  if (change <= goal) endless_ = 0;
  return change;
}

// Whether the policy can come out of every state of the part: a search backward from where it
// does.
bool EndingIteration::ends() {
  const std::size_t size = part_.size();
  for (std::size_t i = 0; i < size; ++i) place_[part_[i]] = static_cast<std::uint32_t>(i);
  std::vector<std::uint64_t> begin(size + 2, 0);
  for (const State s : part_) {
    for (const State next : rows_.successors(s)) {
      if (place_[next] != unreached) ++begin[place_[next] + 2];
    }
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> from(begin.back()), queue;
  std::vector<bool> out(size, false);
  for (std::uint32_t i = 0; i < size; ++i) {
    for (const State next : rows_.successors(part_[i])) {
      if (place_[next] != unreached) {
        from[begin[place_[next] + 1]++] = i;
      } else if (!out[i]) {
        out[i] = true;
        queue.push_back(i);
      }
    }
  }
  for (std::size_t q = 0; q < queue.size(); ++q) {
    for (std::uint64_t k = begin[queue[q]]; k < begin[queue[q] + 1]; ++k) {
      if (out[from[k]]) continue;
      out[from[k]] = true;
      queue.push_back(from[k]);
    }
  }
  for (const State s : part_) place_[s] = unreached;
  return queue.size() == size;
}

// Step 2, second half: the largest gain of a switch, 0 if there was none.
double EndingIteration::improve() {
  const double doubt = 4.0 * rounding();
  double largest = 0.0;
  for (const State s : part_) {
    const double before = value_[s];
    double best = before + doubt;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      const double q = backup(mdp_, 1.0, value_.data(), c);
      if (!(q > best)) continue;
      best = q;
      value_[s] = q;
      take(s, static_cast<Action>(c - mdp_.choice_begin(s)));
    }
    largest = std::max(largest, value_[s] - before);
  }
  return largest;
}

// Step 5.
Solution EndingIteration::finish() {
  if (failed_) {
    solution_.lower.assign(mdp_.states(), 0.0);
    solution_.upper.assign(mdp_.states(), 0.0);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (mdp_.terminal(s)) continue;
      solution_.lower[s] = -infinity;
      solution_.upper[s] = ending_.live[s] != 0 ? infinity : -infinity;
    }
  } else {
    TotalCertificate certificate = certify_total(mdp_, ending_.live, solution_.policy, value_);
    solution_.lower = std::move(certificate.lower);
    solution_.upper = std::move(certificate.upper);
  }
  solution_.discount = 1.0;
  conclude(mdp_, solution_, settings_.width);
  return std::move(solution_);
}

}  // namespace quoll
