#include "quoll/solve/functional_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoll {

namespace {

struct Interval {
  double lower;
  double upper;
};

// Bounds on numerator / denominator for a positive denominator.
double divide_down(double numerator, const Interval& denominator) {
  const double by = numerator >= 0.0 ? denominator.upper : denominator.lower;
  const double quotient = numerator / by;
  if (std::isinf(numerator) || quotient == 0.0) return numerator == 0.0 ? 0.0 : next_down(quotient);
  const double product = quotient * by;
  const bool exact = product == numerator && product_error(quotient, by, product) == 0.0;
  return exact ? quotient : next_down(quotient);
}
double divide_up(double numerator, const Interval& denominator) {
  return -divide_down(-numerator, denominator);
}

// One evaluation: follows each state's moves to something known, then unwinds.
class Evaluator {
 public:
  Evaluator(const Mdp& mdp, std::span<const Action> policy, const Discount& discount,
            std::span<const std::uint8_t> live)
      : mdp_(mdp), policy_(policy), discount_(discount), live_(live) {}

  GraphValues run() {
    const std::size_t states = mdp_.states();
    out_.lower.assign(states, 0.0);
    out_.upper.assign(states, 0.0);
    out_.steps.assign(states, never);
    out_.order.reserve(states);
    seen_.assign(states, unseen);
    for (std::size_t s = 0; s < states; ++s) settle_boundary(static_cast<State>(s));
    for (std::size_t s = 0; s < states; ++s) follow(static_cast<State>(s));
    return std::move(out_);
  }

 private:
  enum : std::uint8_t { unseen, on_path, done };

  std::uint64_t choice(State s) const { return mdp_.choice_begin(s) + policy_[s]; }
  State successor(State s) const { return mdp_.next(choice(s)); }

  void settle_boundary(State s) {
    if (mdp_.terminal(s)) {
      out_.steps[s] = 0;
      seen_[s] = done;
    } else if (!live_.empty() && live_[s] == 0) {
      out_.lower[s] = out_.upper[s] = -infinity;
      seen_[s] = done;
    } else if (policy_[s] == no_action) {
      const auto [low, high] = mdp_.reward_bounds();
      const Interval rest{next_down(1.0 - discount_.upper), next_up(1.0 - discount_.lower)};
      const bool none = discount_.none();
      out_.lower[s] = none ? -infinity : std::min(0.0, divide_down(Meant(low).lower, rest));
      out_.upper[s] = none ? infinity : std::max(0.0, divide_up(Meant(high).upper, rest));
      seen_[s] = done;
    }
  }

  void follow(State s) {
    path_.clear();
    for (; seen_[s] == unseen; s = successor(s)) {
      seen_[s] = on_path;
      path_.push_back(s);
    }
    if (seen_[s] == on_path) close_cycle(s);
    for (; !path_.empty(); path_.pop_back()) back_up(path_.back());
  }

  void back_up(State s) {
    const State next = successor(s);
    const double reward = mdp_.reward(choice(s));
    out_.lower[s] = backup_down(reward, discount_, out_.lower[next]);
    out_.upper[s] = backup_up(reward, discount_, out_.upper[next]);
    out_.steps[s] = out_.steps[next] == never ? never : out_.steps[next] + 1;
    out_.order.push_back(s);
    seen_[s] = done;
  }

  // The path ends in a cycle through `first`: values `first` from one turn round it, then the rest
  // of the cycle one after the other.
  void close_cycle(State first) {
    const auto begin = std::find(path_.rbegin(), path_.rend(), first).base() - 1;
    Interval turn{0.0, 0.0};
    Interval decay{1.0, 1.0};
    bool earns = false;
    for (auto at = path_.end(); at != begin;) {
      const double reward = mdp_.reward(choice(*--at));
      turn = {backup_down(reward, discount_, turn.lower), backup_up(reward, discount_, turn.upper)};
      decay = {scale_down(discount_.lower, decay.lower), scale_up(discount_.upper, decay.upper)};
      earns = earns || reward != 0.0;
    }
    const Interval value = discount_.none() ? endless(turn, earns) : repeated(turn, decay);
    out_.lower[first] = value.lower;
    out_.upper[first] = value.upper;
    seen_[first] = done;
    for (; path_.back() != first; path_.pop_back()) back_up(path_.back());
    path_.pop_back();
    out_.order.push_back(first);
    out_.turns.push_back(first);
  }

  // V = turn + decay * V.
  static Interval repeated(const Interval& turn, const Interval& decay) {
    const Interval rest{add_down(1.0, -decay.upper), add_up(1.0, -decay.lower)};
    if (!(rest.lower > 0.0)) return {-infinity, infinity};
    return {divide_down(turn.lower, rest), divide_up(turn.upper, rest)};
  }

  static Interval endless(const Interval& turn, bool earns) {
    if (!earns) return {0.0, 0.0};
    if (turn.upper < 0.0) return {-infinity, -infinity};
    if (turn.lower > 0.0) return {infinity, infinity};
    return {-infinity, infinity};
  }

  const Mdp& mdp_;
  std::span<const Action> policy_;
  const Discount& discount_;
  std::span<const std::uint8_t> live_;
  GraphValues out_;
  std::vector<std::uint8_t> seen_;
  std::vector<State> path_;
};

// The best upper-rounded backup of a state, if it exceeds `bound`; else `bound`. Plain arithmetic
// dismisses the choices that are clearly below.
double best_up(const Mdp& mdp, const Discount& discount, const std::vector<double>& upper, State s,
               double bound) {
  double best = bound;
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    const double reward = mdp.reward(c);
    const double value = upper[mdp.next(c)];
    const double tail = discount.value * value;
    const double doubt = 2e-15 * (std::fabs(reward) + std::fabs(tail)) + 1e-300;
    if (reward + tail + doubt <= best) continue;
    best = std::max(best, backup_up(reward, discount, value));
  }
  return best;
}

// Adds to every bound what the largest violation can amount to: with T U <= U + excess, the vector
// U + k satisfies T(U + k) <= U + k if k (1 - discount) >= excess + rounding.
bool add_constant(const Mdp& mdp, const Discount& discount, std::span<const State> order,
                  std::vector<double>& upper) {
  double excess = 0.0;
  double size = 0.0;
  for (const State s : order) {
    const double best = best_up(mdp, discount, upper, s, upper[s]);
    excess = std::max(excess, next_up(best - upper[s]));
    size = std::max(size, std::fabs(upper[s]));
  }
  const double rest = next_down(1.0 - discount.upper);
  if (!(rest > 0.0) || !(size < infinity)) return false;
  double constant = next_up(excess / rest);
  constant = next_up((excess + 0x1p-50 * (size + constant)) / rest);
  for (const State s : order) upper[s] = add_up(upper[s], constant);
  for (const State s : order) {
    if (best_up(mdp, discount, upper, s, upper[s]) > upper[s]) return false;
  }
  return true;
}

// At discount 1, where every move costs at least m: gives up the same small share of all costs.
// With U <= 0 and T U <= U + excess, T((1 - share) U) <= (1 - share) U holds if share m >= excess,
// for r + (1 - share)(U' - U) <= r + (1 - share)(excess - r) <= excess - share m. What the rounding
// adds to the excess is a few ulps of U; whether it was enough is checked with outward rounding.
bool give_up_share(const Mdp& mdp, const Discount& discount, std::span<const State> order,
                   std::vector<double>& upper) {
  double excess = 0.0;
  double size = 0.0;
  double least = infinity;
  for (const State s : order) {
    if (!(upper[s] <= 0.0) || upper[s] == -infinity) return false;
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      least = std::min(least, -mdp.reward(c));
    }
    excess = std::max(excess, best_up(mdp, discount, upper, s, upper[s]) - upper[s]);
    size = std::max(size, -upper[s]);
  }
  if (!(least > 0.0)) return false;
  const double share = (2.0 * excess + 0x1p-50 * size) / least;
  if (!(share < 1.0)) return false;
  for (const State s : order) upper[s] *= 1.0 - share;
  for (const State s : order) {
    if (best_up(mdp, discount, upper, s, upper[s]) > upper[s]) return false;
  }
  return true;
}

}  // namespace

GraphValues evaluate_graph(const Mdp& mdp, std::span<const Action> policy, const Discount& discount,
                           std::span<const std::uint8_t> live) {
  return Evaluator(mdp, policy, discount, live).run();
}

std::uint64_t improve_policy(const Mdp& mdp, const GraphValues& values, const Discount& discount,
                             std::span<const std::uint8_t> live, std::vector<Action>& policy) {
  std::uint64_t switched = 0;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s) || (!live.empty() && live[s] == 0)) continue;
    double best = values.upper[s];
    for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
      const double value = values.lower[mdp.next(c)];
      if (!(mdp.reward(c) + discount.value * value > best)) continue;
      const double lower = backup_down(mdp.reward(c), discount, value);
      if (!(lower > best)) continue;
      best = lower;
      policy[s] = static_cast<Action>(c - mdp.choice_begin(s));
    }
    switched += best > values.upper[s] ? 1 : 0;
  }
  return switched;
}

bool raise_until_inductive(const Mdp& mdp, const Discount& discount, std::span<const State> order,
                           std::vector<double>& upper, unsigned sweeps) {
  for (unsigned sweep = 0; sweep < sweeps; ++sweep) {
    bool raised = false;
    for (const State s : order) {
      const double best = best_up(mdp, discount, upper, s, upper[s]);
      if (best > upper[s]) {
        upper[s] = best;
        raised = true;
      }
    }
    if (!raised) return true;
  }
  return discount.none() ? give_up_share(mdp, discount, order, upper)
                         : add_constant(mdp, discount, order, upper);
}

bool lower_until_inductive(const Mdp& mdp, const Discount& discount, std::span<const Action> policy,
                           GraphValues& values) {
  std::vector<double>& lower = values.lower;
  const auto largest_excess = [&](std::span<const State> states) {
    double largest = 0.0;
    for (const State s : states) {
      const std::uint64_t c = mdp.choice_begin(s) + policy[s];
      const double after = backup_down(mdp.reward(c), discount, lower[mdp.next(c)]);
      largest = std::max(largest, add_up(lower[s], -after));
    }
    return largest;
  };
  if (discount.none()) return true;
  const double largest = largest_excess(values.turns);
  if (!(largest > 0.0)) return true;
  double size = 0.0;
  for (const State s : values.order) size = std::max(size, std::fabs(lower[s]));
  const double rest = next_down(1.0 - discount.upper);
  if (!(rest > 0.0) || !(size < infinity)) return false;
  const double first = next_up(largest / rest);
  const double constant = next_up((largest + 0x1p-50 * (size + first)) / rest);
  for (const State s : values.order) {
    if (lower[s] < values.upper[s]) lower[s] = -add_up(-lower[s], constant);
  }
  return !(largest_excess(values.order) > 0.0);
}

}  // namespace quoll
