#include "quoll/verify/verify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

// Why acceptance proves the bounds (Puterman 1994, section 6.2; at discount 1 Bertsekas and
// Tsitsiklis 1991): if T U <= U then U >= T U >= T T U >= ... bounds the value of every policy, at
// discount 1 of every policy that ends; if T_pi L >= L then L <= V_pi likewise. At discount 1 a row
// is taken to sum to 1, so that r + sum of p U(s') <= U(s) may be checked as r + sum of p (U(s') -
// U(s)) <= 0.
//
// Where two players move in turn each bound follows from the other: if U(s) >= r - g E L(s') for
// every choice and L(s) <= r - g E U(s') for the policy's, then by induction from the ends on, or
// below discount 1 by contraction, L <= V* <= U, and the policy is sure of L against any replies.
// Without discounting that needs a model in which no state comes again.

namespace quoll {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double sum_up(double a, double b) {
  const double sum = a + b;
  if (!std::isfinite(sum)) return sum;
  const double back = sum - a;
  const double error = (a - (sum - back)) + (b - back);
  return error <= 0.0 ? sum : std::nextafter(sum, unbounded);
}

double product_up(double a, double b) {
  const double product = a * b;
  if (!std::isfinite(product) || a == 0.0 || b == 0.0) return product;
  const bool exact = std::fma(a, b, -product) == 0.0 && std::fabs(product) > 1e-280;
  return exact ? product : std::nextafter(product, unbounded);
}

// Whether sign * (r + g E[follows]) <= sign * bound(s) is certain for this choice; where the turn
// passes, sign * (r - g E[follows]).
bool holds(const Mdp& mdp, std::span<const double> bound, std::span<const double> follows,
           double sign, double discount, State s, std::uint64_t choice) {
  const double next_sign = mdp.alternating() ? -sign : sign;
  const double reward = sign * mdp.reward(choice);
  const double own = sign * bound[s];
  double mean = -0.0;
  double drift = reward;
  for (std::uint64_t o = mdp.outcome_begin(choice); o < mdp.outcome_end(choice); ++o) {
    const double next = next_sign * follows[mdp.next(o)];
    const double step = next == own ? 0.0 : sum_up(next, -own);
    mean = sum_up(mean, product_up(mdp.probability(o), next));
    drift = sum_up(drift, product_up(mdp.probability(o), step));
  }
  if (sum_up(reward, product_up(discount, mean)) <= own) return true;
  return discount == 1.0 && drift <= 0.0;
}

// States from which the policy reaches an end with positive probability.
std::vector<bool> ending(const Mdp& mdp, std::span<const Action> policy,
                         std::span<const double> lower) {
  std::vector<std::pair<State, State>> back;  // to, from
  std::vector<bool> ends(mdp.states());
  std::vector<State> queue;
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s)) {
      ends[s] = true;
      queue.push_back(s);
    } else if (lower[s] > -unbounded) {
      const std::uint64_t c = mdp.choice_begin(s) + policy[s];
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        if (mdp.probability(o) > 0.0) back.push_back({mdp.next(o), s});
      }
    }
  }
  std::sort(back.begin(), back.end());
  while (!queue.empty()) {
    const State to = queue.back();
    queue.pop_back();
    auto edge = std::lower_bound(back.begin(), back.end(), std::pair<State, State>{to, 0});
    for (; edge != back.end() && edge->first == to; ++edge) {
      if (!ends[edge->second]) queue.push_back(edge->second);
      ends[edge->second] = true;
    }
  }
  return ends;
}

// A state that can come again, if there is one: what is left after taking away, again and again,
// the states all of whose successors are gone.
std::optional<State> returning(const Mdp& mdp) {
  std::vector<std::pair<State, State>> back;  // to, from
  std::vector<std::uint64_t> open(mdp.states(), 0);
  std::vector<State> queue;
  for (State s = 0; s < mdp.states(); ++s) {
    if (!mdp.terminal(s)) {
      const std::uint64_t first = mdp.outcome_begin(mdp.choice_begin(s));
      const std::uint64_t end = mdp.outcome_end(mdp.choice_end(s) - 1);
      for (std::uint64_t o = first; o < end; ++o) back.push_back({mdp.next(o), s});
      open[s] = end - first;
    }
    if (open[s] == 0) queue.push_back(s);
  }
  std::sort(back.begin(), back.end());
  for (std::size_t i = 0; i < queue.size(); ++i) {
    auto edge = std::lower_bound(back.begin(), back.end(), std::pair<State, State>{queue[i], 0});
    for (; edge != back.end() && edge->first == queue[i]; ++edge) {
      if (--open[edge->second] == 0) queue.push_back(edge->second);
    }
  }
  for (State s = 0; s < mdp.states(); ++s) {
    if (open[s] > 0) return s;
  }
  return std::nullopt;
}

std::string fault(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
                  std::span<const Action> policy, double discount, State s) {
  if (!(lower[s] <= upper[s])) return "lower is above upper";
  if (mdp.terminal(s)) {
    return lower[s] <= 0.0 && upper[s] >= 0.0 ? "" : "an end is worth 0, which is not inside";
  }
  if (discount < 1.0 && upper[s] == -unbounded) return "upper is -infinity at a discount below 1";
  if (discount < 1.0 && lower[s] == unbounded) return "lower is infinity at a discount below 1";
  for (std::uint64_t c = mdp.choice_begin(s); c < mdp.choice_end(s); ++c) {
    double row = 0.0;
    for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
      row = sum_up(row, mdp.probability(o));
    }
    if (discount < 1.0 && product_up(row, discount) >= 1.0) return "discount leaves no contraction";
    if (upper[s] < unbounded &&
        !holds(mdp, upper, mdp.alternating() ? lower : upper, 1.0, discount, s, c)) {
      return "action " + mdp.action_name(c) + " may earn more than upper";
    }
  }
  if (lower[s] == -unbounded) return "";
  if (policy[s] == no_action) return "the policy has no action";
  if (!holds(mdp, lower, mdp.alternating() ? upper : lower, -1.0, discount, s,
             mdp.choice_begin(s) + policy[s])) {
    return "the policy's action may earn less than lower";
  }
  return "";
}

}  // namespace

Result<Verdict> verify(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
                       std::span<const Action> policy, double discount) {
  const std::uint64_t states = mdp.states();
  if (lower.size() != states || upper.size() != states || policy.size() != states) {
    return Error{"", 0, 0, "a certificate for " + std::to_string(states) + " states was expected",
                 ""};
  }
  if (!(discount > 0.0 && discount <= 1.0)) {
    return Error{"--discount", 0, 0, "a number above 0 and at most 1 was expected", ""};
  }
  for (State s = 0; s < states; ++s) {
    if (mdp.terminal(s) || policy[s] == no_action || policy[s] < mdp.actions(s)) continue;
    return Error{
        "", 0, 0,
        "state " + mdp.state_name(s) + " has no action numbered " + std::to_string(policy[s]), ""};
  }
  const auto refused = [&](State s, const std::string& why) {
    return Verdict{false, "state " + mdp.state_name(s) + ": " + why, s};
  };
  for (State s = 0; s < states; ++s) {
    const std::string why = fault(mdp, lower, upper, policy, discount, s);
    if (!why.empty()) return refused(s, why);
  }
  if (discount < 1.0) return Verdict{true, "", std::nullopt};
  if (mdp.alternating()) {
    const std::optional<State> again = returning(mdp);
    if (again) return refused(*again, "it can come again: the game may never end");
    return Verdict{true, "", std::nullopt};
  }
  const std::vector<bool> ends = ending(mdp, policy, lower);
  for (State s = 0; s < states; ++s) {
    if (!ends[s] && lower[s] > -unbounded) return refused(s, "the policy may never end");
  }
  return Verdict{true, "", std::nullopt};
}

}  // namespace quoll
