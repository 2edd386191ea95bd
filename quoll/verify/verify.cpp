#include "quoll/verify/verify.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/verify/ending.hpp"

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
//
// Each choice is first judged by a plain sum and a bound on all its rounding (Higham 2002, section
// 3.1); only where that leaves doubt, by sums rounded outward step by step.

namespace quoll {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// The next double above a finite one.
double above(double x) {
  if (x == 0.0) return std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(x > 0.0 ? bits + 1 : bits - 1);
}

double sum_up(double a, double b) {
  const double sum = a + b;
  if (!std::isfinite(sum)) {
    const bool overflow = sum == -unbounded && std::isfinite(a) && std::isfinite(b);
    return overflow ? std::numeric_limits<double>::lowest() : sum;
  }
  const double back = sum - a;
  const double error = (a - (sum - back)) + (b - back);
  return error <= 0.0 ? sum : above(sum);
}

double product_up(double a, double b) {
  const double product = a * b;
  if (!std::isfinite(product) || a == 0.0 || b == 0.0) return product;
  // What is missing up to a * b; tells the truth unless it is too small for a double itself.
  const bool enough = std::fma(a, b, -product) <= 0.0 && std::fabs(product) > 1e-280;
  return enough ? product : above(product);
}

double quotient_up(double a, double b) {
  const double quotient = a / b;
  if (!std::isfinite(quotient) || std::fma(quotient, b, -a) == 0.0) return quotient;
  return above(quotient);
}

// One of the two conditions, written as sign * (r + g E[follows]) <= sign * bound(s); where the
// turn passes, sign * (r - g E[follows]).
struct Condition {
  std::span<const double> bound, follows;
  double sign;
  const char* name;  // of the bound
};

class Checker {
 public:
  Checker(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
          std::span<const Action> policy, double discount, bool maximise)
      : mdp_(mdp),
        lower_(lower),
        upper_(upper),
        policy_(policy),
        discount_(discount),
        maximise_(maximise),
        best_{maximise ? upper : lower, maximise != mdp.alternating() ? upper : lower,
              maximise ? 1.0 : -1.0, maximise ? "upper" : "lower"},
        sure_{maximise ? lower : upper, maximise != mdp.alternating() ? lower : upper,
              maximise ? -1.0 : 1.0, maximise ? "lower" : "upper"},
        rounding_(largest_rounding()) {}

  Verdict run() {
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!sound(s)) return verdict_;
    }
    if (discount_ == 1.0 && !ends()) return verdict_;
    verdict_.accepted = true;
    return verdict_;
  }

 private:
  bool sound(State s) {
    if (!(lower_[s] <= upper_[s])) {
      return refuse(s, "lower " + shortest(lower_[s]) + " is above upper " + shortest(upper_[s]));
    }
    if (mdp_.terminal(s)) {
      if (lower_[s] <= 0.0 && upper_[s] >= 0.0) return true;
      return refuse(s, "an end is worth 0, which is not between lower " + shortest(lower_[s]) +
                           " and upper " + shortest(upper_[s]));
    }
    return bounded(s) && best_holds(s) && sure_holds(s);
  }

  // Infinite claims that no sum can contradict.
  bool bounded(State s) {
    if (-sure_.sign * sure_.bound[s] == unbounded) {
      return refuse(
          s, std::string("no policy is sure of ") + sure_.name + " " + shortest(sure_.bound[s]));
    }
    if (best_.sign * best_.bound[s] != -unbounded) return true;
    if (discount_ < 1.0 || mdp_.alternating()) {
      return refuse(s, std::string(best_.name) + " is " + shortest(best_.bound[s]) +
                           ", but values are finite");
    }
    if (can_end_.empty()) can_end_ = some_policy_ends(mdp_);
    return !can_end_[s] || refuse(s, std::string(best_.name) + " is " + shortest(best_.bound[s]) +
                                         ", but some policy is sure to end");
  }

  bool best_holds(State s) {
    const bool silent = best_.sign * best_.bound[s] == unbounded;
    for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
      if (holds(best_, s, c)) continue;
      if (!contracts(c)) {
        return refuse(s, "action " + mdp_.action_name(c) + ": the discount leaves no contraction");
      }
      if (silent) continue;
      return refuse(s, c, best_, "action " + mdp_.action_name(c) + " may ");
    }
    return true;
  }

  bool sure_holds(State s) {
    if (sure_.sign * sure_.bound[s] == unbounded) return true;
    if (policy_[s] == no_action) {
      return refuse(s, std::string(sure_.name) + " is " + shortest(sure_.bound[s]) +
                           ", but the policy has no action");
    }
    const std::uint64_t c = mdp_.choice_begin(s) + policy_[s];
    return holds(sure_, s, c) ||
           refuse(s, c, sure_, "the policy's action " + mdp_.action_name(c) + " may ");
  }

  // Whether the condition is certain for this choice, and below discount 1 that it contracts.
  bool holds(const Condition& condition, State s, std::uint64_t choice) const {
    const double carried = mdp_.alternating() ? -condition.sign : condition.sign;
    const std::uint64_t first = mdp_.outcome_begin(choice);
    const std::uint64_t end = mdp_.outcome_end(choice);
    double mean = 0.0;
    double row = 0.0;
    for (std::uint64_t o = first; o < end; ++o) {
      const double p = mdp_.probability(o);
      mean += p * condition.follows[mdp_.next(o)];
      row += p;
    }
    const double steps = static_cast<double>(end - first) + 8.0;
    const double q = condition.sign * mdp_.reward(choice) + carried * (discount_ * mean);
    const double own = condition.sign * condition.bound[s];
    const double weight = discount_ * row + steps * 0x1p-52;
    const bool fast =
        q + steps * rounding_ <= own && row <= 1.5 && (discount_ == 1.0 || weight < 1.0);
    return fast || surely_holds(condition, s, choice);
  }

  bool surely_holds(const Condition& condition, State s, std::uint64_t choice) const {
    if (!contracts(choice)) return false;
    const double own = condition.sign * condition.bound[s];
    if (backup_up(condition, choice) <= own) return true;
    if (discount_ < 1.0) return false;
    const double carried = mdp_.alternating() ? -condition.sign : condition.sign;
    double drift = condition.sign * mdp_.reward(choice);
    for (std::uint64_t o = mdp_.outcome_begin(choice); o < mdp_.outcome_end(choice); ++o) {
      const double next = carried * condition.follows[mdp_.next(o)];
      const double step = next == own ? 0.0 : sum_up(next, -own);
      drift = sum_up(drift, product_up(mdp_.probability(o), step));
    }
    return drift <= 0.0;
  }

  // At least sign * (r + g E[follows]).
  double backup_up(const Condition& condition, std::uint64_t choice) const {
    const double carried = mdp_.alternating() ? -condition.sign : condition.sign;
    double mean = -0.0;
    for (std::uint64_t o = mdp_.outcome_begin(choice); o < mdp_.outcome_end(choice); ++o) {
      const double next = carried * condition.follows[mdp_.next(o)];
      mean = sum_up(mean, product_up(mdp_.probability(o), next));
    }
    return sum_up(condition.sign * mdp_.reward(choice), product_up(discount_, mean));
  }

  // Below discount 1 whatever follows must count for less.
  bool contracts(std::uint64_t choice) const {
    if (discount_ == 1.0) return true;
    double row = 0.0;
    for (std::uint64_t o = mdp_.outcome_begin(choice); o < mdp_.outcome_end(choice); ++o) {
      row = sum_up(row, mdp_.probability(o));
    }
    return product_up(row, discount_) < 1.0;
  }

  // Per operation on numbers of this model and this certificate; infinite when they are so large
  // that a sum may overflow, and then every choice takes the careful way.
  double largest_rounding() const {
    double size = 0.0;
    for (std::uint64_t c = 0; c < mdp_.choices(); ++c) {
      size = std::max(size, std::fabs(mdp_.reward(c)));
    }
    double bound = 0.0;
    for (const std::span<const double> values : {lower_, upper_}) {
      for (const double v : values) {
        if (std::isfinite(v)) bound = std::max(bound, std::fabs(v));
      }
    }
    size += 2.0 * bound;
    return size < 1e290 ? size * 0x1p-52 + 1e-300 : unbounded;
  }

  bool ends() {
    if (mdp_.alternating()) {
      const std::optional<State> again = returning(mdp_);
      return !again || refuse(*again, "it can come again: the game may never end");
    }
    std::vector<bool> claimed(mdp_.states());
    for (State s = 0; s < mdp_.states(); ++s) {
      claimed[s] = !mdp_.terminal(s) && sure_.sign * sure_.bound[s] < unbounded;
    }
    const std::vector<bool> reached = policy_ends(mdp_, policy_, claimed);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (claimed[s] && !reached[s]) return refuse(s, "the policy may never end");
    }
    return true;
  }

  bool refuse(State s, const std::string& why) {
    verdict_.state = s;
    verdict_.reason = "state " + mdp_.state_name(s) + ": " + why;
    return false;
  }

  bool refuse(State s, std::uint64_t choice, const Condition& condition, const std::string& who) {
    const bool more = condition.sign > 0.0;
    verdict_.choice = choice;
    verdict_.claimed = condition.bound[s];
    verdict_.found = condition.sign * backup_up(condition, choice);
    return refuse(s, who + (maximise_ ? "earn " : "cost ") + (more ? "" : "only ") +
                         shortest(*verdict_.found) + (more ? ", more than " : ", less than ") +
                         condition.name + " " + shortest(*verdict_.claimed));
  }

  const Mdp& mdp_;
  std::span<const double> lower_, upper_;
  std::span<const Action> policy_;
  double discount_;
  bool maximise_;
  Condition best_;  // bounds what any choice can reach
  Condition sure_;  // what the policy's choice is sure of
  double rounding_;
  std::vector<bool> can_end_;
  Verdict verdict_;
};

}  // namespace

Result<Verdict> verify(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper,
                       std::span<const Action> policy, double discount, bool maximise) {
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
  return Checker(mdp, lower, upper, policy, discount, maximise).run();
}

Proved proved(const Mdp& mdp, std::span<const double> lower, std::span<const double> upper) {
  Proved result;
  const bool uniform = mdp.arrays().start_probability.empty();
  double least = -0.0;  // of the negated start value
  double most = -0.0;
  for (std::size_t i = 0; i < mdp.start().size(); ++i) {
    const double share = uniform ? 1.0 : mdp.start_probability(i);
    if (share == 0.0) continue;
    least = sum_up(least, product_up(share, -lower[mdp.start()[i]]));
    most = sum_up(most, product_up(share, upper[mdp.start()[i]]));
  }
  const double count = uniform ? static_cast<double>(mdp.start().size()) : 1.0;
  result.start_lower = 0.0 - quotient_up(least, count);
  result.start_upper = 0.0 + quotient_up(most, count);
  for (State s = 0; s < mdp.states(); ++s) {
    if (mdp.terminal(s) || lower[s] == upper[s]) continue;
    if (lower[s] == -unbounded && upper[s] == unbounded) {
      ++result.silent;
      continue;
    }
    const double width = sum_up(upper[s], -lower[s]);
    if (width <= result.gap) continue;
    result.gap = width;
    result.widest = s;
  }
  return result;
}

}  // namespace quoll
