#include "quoll/solve/rational_solver.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "quoll/base/text.hpp"
#include "quoll/model/graph.hpp"
#include "quoll/solve/ending.hpp"
#include "quoll/solve/meant.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/rational_system.hpp"
#include "quoll/solve/rounding.hpp"

// Policy iteration without rounding. Howard 1960; the check of a basis found in floating point:
// Dhiflaoui et al. 2003 ("Certifying and repairing solutions to large LPs").
//
//   for each strongly connected component of the model, the last ones first
//     1  solve x = r_pi + g P_pi x for its states; what leaves it is known already
//        (if pi never leaves it: take a policy that ends instead, once)
//     2  for each state: the best action by x; switch if it is better than pi's by anything
//     3  if any was switched go to 1, else x = V*
//
// Step 2 proves x >= T x. Thus no policy earns more; at discount 1 none that ends does, since what
// it has not yet earned after n moves tends to 0. At discount 1 a policy that is improved from one
// that ends can fail to end only if staying gains: then no value is defined.
//
// Where two players move in turn pi is both players' and g is negative: x = T x proves x again, but
// switches of both at once need not come to rest.
//
// pi: out.policy, x: value_, g: model.carry(), r, P: model.

namespace quoll {

#ifndef QUOLL_GMP

bool has_rationals() {
  return false;
}

Result<RationalSolution> solve_in_rationals(const Mdp&, const Solution&, const RationalSettings&) {
  return Error{"--exact", 0, 0,
               "this build counts in doubles only: install GMP (Debian, Ubuntu: apt-get install "
               "libgmp-dev) and build again",
               ""};
}

#else

bool has_rationals() {
  return true;
}

namespace {

class RationalIteration {
 public:
  RationalIteration(const Mdp& mdp, const Solution& from, const RationalSettings& settings,
                    MeantModel model)
      : mdp_(mdp), from_(from), settings_(settings), model_(std::move(model)) {
    out_.policy = from.policy;
    value_.resize(mdp.states());
    kind_.assign(mdp.states(), Kind::finite);
    if (from.discount < 1.0 || mdp.alternating()) return;
    ending_ = find_ending(mdp);
    const std::vector<bool> unknown = unknown_states(mdp);
    for (State s = 0; s < mdp.states(); ++s) {
      if (!mdp.terminal(s) && ending_.live[s] == 0) kind_[s] = Kind::endless;
      if (!unknown.empty() && unknown[s]) kind_[s] = Kind::unknown;
    }
  }

  Result<RationalSolution> run() {
    const std::vector<std::uint32_t> component = strongly_connected(mdp_);
    std::vector<State> order;
    for (State s = 0; s < mdp_.states(); ++s) {
      if (!mdp_.terminal(s) && kind_[s] == Kind::finite) order.push_back(s);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](State a, State b) { return component[a] < component[b]; });
    place_.assign(mdp_.states(), none);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      while (end < order.size() && component[order[end]] == component[order[begin]]) ++end;
      const std::span<const State> members = std::span(order).subspan(begin, end - begin);
      const Result<void> solved = solve_component(members);
      if (!solved) return solved.error();
      done_ = end;
    }
    report();
    return std::move(out_);
  }

 private:
  enum class Kind : std::uint8_t { finite, endless, unknown };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint64_t most_replies = 100;

  // Whether all that can follow has a finite value: endless states are worse than anything.
  bool usable(std::uint64_t c) const {
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      if (kind_[mdp_.next(o)] != Kind::finite) return false;
    }
    return true;
  }

  // r(s,a) + g sum p V(s') over the successors of known value; the others go into `inside`.
  Rational known_part(std::uint64_t c, std::map<std::size_t, Rational>* inside) const {
    Rational sum;
    for (std::uint64_t o = mdp_.outcome_begin(c); o < mdp_.outcome_end(c); ++o) {
      const State next = mdp_.next(o);
      if (mdp_.terminal(next)) continue;
      const Rational* p = model_.probability(o);
      if (inside != nullptr && place_[next] != none) {
        Rational share = model_.carry();
        if (p != nullptr) share *= *p;
        (*inside)[place_[next]] += share;
        continue;
      }
      Rational part = value_[next];
      if (p != nullptr) part *= *p;
      sum += part;
    }
    sum *= model_.carry();
    sum += model_.reward(c);
    return sum;
  }

  RationalSystem::Outcome evaluate(std::span<const State> members) {
    RationalSystem system(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::uint64_t c = mdp_.choice_begin(members[i]) + out_.policy[members[i]];
      if (!usable(c)) return RationalSystem::Outcome::endless;
      std::map<std::size_t, Rational> inside;
      Rational outside = known_part(c, &inside);
      system.set_row(i, inside, std::move(outside));
    }
    std::vector<Rational> x;
    const auto outcome = system.solve(x, [&](std::size_t solved) {
      return !settings_.keep_going || settings_.keep_going(done_ + solved);
    });
    if (outcome != RationalSystem::Outcome::solved) return outcome;
    for (std::size_t i = 0; i < members.size(); ++i) value_[members[i]] = std::move(x[i]);
    return outcome;
  }

  // Step 2: how many states were switched.
  std::uint64_t improve(std::span<const State> members) {
    std::uint64_t switched = 0;
    for (const State s : members) {
      Rational best = value_[s];
      const Action before = out_.policy[s];
      for (std::uint64_t c = mdp_.choice_begin(s); c < mdp_.choice_end(s); ++c) {
        if (c == mdp_.choice_begin(s) + before || !usable(c)) continue;
        Rational q = known_part(c, nullptr);
        if (q.compare(best) <= 0) continue;
        best = std::move(q);
        out_.policy[s] = static_cast<Action>(c - mdp_.choice_begin(s));
      }
      if (out_.policy[s] != before) ++switched;
    }
    return switched;
  }

  Result<void> solve_component(std::span<const State> members) {
    if (members.size() > settings_.most_together) {
      return too_large(grouped(members.size()) + " states that lead to each other",
                       grouped(settings_.most_together));
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      place_[members[i]] = static_cast<std::uint32_t>(i);
      if (out_.policy[members[i]] == no_action) out_.policy[members[i]] = 0;
    }
    auto outcome = evaluate(members);  // step 1
    if (outcome == RationalSystem::Outcome::endless && !ending_.policy.empty()) {
      for (const State s : members) out_.policy[s] = ending_.policy[s];
      outcome = evaluate(members);
    }
    std::uint64_t rounds = 0;
    while (outcome == RationalSystem::Outcome::solved && improve(members) > 0) {  // step 3
      if (mdp_.alternating() && ++rounds > most_replies) return no_agreement(members[0]);
      outcome = evaluate(members);
    }
    for (const State s : members) place_[s] = none;
    if (outcome == RationalSystem::Outcome::solved) return {};
    if (outcome == RationalSystem::Outcome::stopped) return Error{"--exact", 0, 0, "stopped", ""};
    return Error{"--discount", 0, 0,
                 "at discount 1 no cycle may gain reward, but one of the component of state " +
                     mdp_.state_name(members[0]) + " does; a discount below 1 makes values finite",
                 ""};
  }

  Error no_agreement(State s) const {
    return Error{"--exact", 0, 0,
                 "the two players' best replies around state " + mdp_.state_name(s) +
                     " did not come to rest: a smaller --tolerance gives a better first policy",
                 ""};
  }

  Fraction fraction(const Rational& number) const {
    Rational signed_number = number;
    if (!settings_.maximise) signed_number.negate();
    return {signed_number.numerator().text(), signed_number.denominator().text(),
            signed_number.towards_zero() + 0.0};
  }

  Fraction no_fraction(Kind kind) const {
    if (kind == Kind::unknown) return {"", "", std::numeric_limits<double>::quiet_NaN()};
    return {"", "", settings_.maximise ? -infinity : infinity};
  }

  // Fills what is told besides the policy, from value_ and kind_.
  void report() {
    Rational sum;
    Kind worst = Kind::finite;
    for (std::uint64_t i = 0; i < mdp_.start().size(); ++i) {
      const State s = mdp_.start()[i];
      worst = std::max(worst, kind_[s]);
      Rational part = value_[s];
      part *= model_.start_probability(i);
      sum += part;
    }
    out_.start = worst == Kind::finite ? fraction(sum) : no_fraction(worst);
    for (State s = 0; s < mdp_.states(); ++s) {
      if (out_.policy[s] != from_.policy[s]) ++out_.switched;
      if (kind_[s] != Kind::finite) {
        out_.value.push_back(no_fraction(kind_[s]));
        continue;
      }
      out_.value.push_back(fraction(value_[s]));
      Rational signed_value = value_[s];
      if (!settings_.maximise) signed_value.negate();
      const double lower = from_.lower[s], upper = from_.upper[s];
      const bool below = lower > -infinity && signed_value.compare(lower) < 0;
      const bool above = upper < infinity && signed_value.compare(upper) > 0;
      if ((below || above) && !out_.outside && !model_.computed()) out_.outside = s;
    }
  }

  static Error too_large(const std::string& what, const std::string& most) {
    return Error{"--exact", 0, 0, "the model has " + what + ", and fractions serve up to " + most,
                 ""};
  }

  const Mdp& mdp_;
  const Solution& from_;
  const RationalSettings& settings_;
  MeantModel model_;
  RationalSolution out_;
  std::vector<Rational> value_;
  std::vector<Kind> kind_;
  std::vector<std::uint32_t> place_;  // in the component at work
  Ending ending_;
  std::uint64_t done_ = 0;
};

}  // namespace

Result<RationalSolution> solve_in_rationals(const Mdp& mdp, const Solution& from,
                                            const RationalSettings& settings) {
  if (mdp.outcomes() > settings.most_outcomes) {
    return Error{"--exact", 0, 0,
                 "the model has " + grouped(mdp.outcomes()) +
                     " transitions, and fractions serve up to " + grouped(settings.most_outcomes),
                 ""};
  }
  Result<MeantModel> model = MeantModel::read(mdp, from.discount, settings.maximise);
  if (!model) return model.error();
  return RationalIteration(mdp, from, settings, std::move(*model)).run();
}

#endif

}  // namespace quoll
