#pragma once
// The Bellman kernel: the one loop over states, choices and outcomes. What happens with each
// state's best value is the business of a small backend, so that every sweep of every method is
// this loop.
//
// A backend is called as backend(State s, double best, Action first_best) for each state of the
// range that is no end; it may write to the values being read (Gauss-Seidel) or elsewhere (Jacobi).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "quoll/model/mdp.hpp"
#include "quoll/solve/parts.hpp"
#include "quoll/solve/rounding.hpp"

namespace quoll {

/// The arrays of a model as the kernel reads them: one outcome per choice, or probabilities for
/// each.
struct DeterministicRows {
  const double* reward;
  const State* next;

  explicit DeterministicRows(const Mdp& mdp)
      : reward(mdp.arrays().reward.data()), next(mdp.arrays().next.data()) {}

  /// reward + discount * value after a choice.
  double backup(double discount, const double* value, std::uint64_t choice) const {
    return reward[choice] + discount * value[next[choice]];
  }
  /// The value of taking a choice of s until it leads away: (r + g E[V(s'); s' != s]) / (1 - g
  /// P(s)), for discounts below 1.
  double leave(double discount, const double* value, std::uint64_t choice, State s) const {
    if (next[choice] == s) return reward[choice] / (1.0 - discount);
    return backup(discount, value, choice);
  }
};

struct PlainNumbers {
  const double* number;
  explicit PlainNumbers(const Column& column) : number(column.plain()) {}
  double operator[](std::uint64_t i) const { return number[i]; }
};
struct CodedNumbers {
  const std::uint8_t* code;
  const double* table;
  explicit CodedNumbers(const Column& column) : code(column.codes()), table(column.table()) {}
  double operator[](std::uint64_t i) const { return table[code[i]]; }
};

template <class Numbers>
struct StochasticRows {
  const double* reward;
  const State* next;
  Numbers probability;
  const std::uint64_t* begin;  // null = one outcome per choice

  explicit StochasticRows(const Mdp& mdp)
      : reward(mdp.arrays().reward.data()),
        next(mdp.arrays().next.data()),
        probability(mdp.arrays().probability),
        begin(mdp.arrays().outcome_begin.empty() ? nullptr : mdp.arrays().outcome_begin.data()) {}

  /// reward + discount * expected value after a choice, summed in the order of the outcomes.
  double backup(double discount, const double* value, std::uint64_t choice) const {
    const std::uint64_t end = begin ? begin[choice + 1] : choice + 1;
    double mean = 0.0;
    for (std::uint64_t o = begin ? begin[choice] : choice; o < end; ++o) {
      mean += probability[o] * value[next[o]];
    }
    return reward[choice] + discount * mean;
  }
  /// As DeterministicRows::leave.
  double leave(double discount, const double* value, std::uint64_t choice, State s) const {
    const std::uint64_t end = begin ? begin[choice + 1] : choice + 1;
    double mean = 0.0;
    double stay = 0.0;
    for (std::uint64_t o = begin ? begin[choice] : choice; o < end; ++o) {
      const double p = probability[o];
      mean += p * (next[o] == s ? 0.0 : value[next[o]]);
      stay += next[o] == s ? p : 0.0;
    }
    return (reward[choice] + discount * mean) / (1.0 - discount * stay);
  }
};

/// work(rows) with the rows of the model's kind.
template <class Work>
decltype(auto) with_rows(const Mdp& mdp, const Work& work) {
  if (mdp.deterministic()) return work(DeterministicRows(mdp));
  if (mdp.arrays().probability.coded()) return work(StochasticRows<CodedNumbers>(mdp));
  return work(StochasticRows<PlainNumbers>(mdp));
}

/// One backup of any model; for loops outside the kernel.
inline double backup(const Mdp& mdp, double discount, const double* value, std::uint64_t choice) {
  return with_rows(
      mdp, [&](const auto& rows) { return rows.backup(mdp.carry(discount), value, choice); });
}

template <class Rows, class Backend>
void sweep_range(const Mdp& mdp, const Rows& rows, double discount, const double* value,
                 StateRange range, Backend& backend) {
  const State count = range.end - range.begin;
  for (State i = 0; i < count; ++i) {
    const State s = range.backward ? range.end - 1 - i : range.begin + i;
    if (mdp.terminal(s)) continue;
    const std::uint64_t begin = mdp.choice_begin(s);
    const std::uint64_t end = mdp.choice_end(s);
    double best = rows.backup(discount, value, begin);
    std::uint64_t best_choice = begin;
    for (std::uint64_t c = begin + 1; c < end; ++c) {
      const double q = rows.backup(discount, value, c);
      if (q > best) {
        best = q;
        best_choice = c;
      }
    }
    backend(s, best, static_cast<Action>(best_choice - begin));
  }
}

/// One sweep over a range of states.
template <class Backend>
void sweep(const Mdp& mdp, double discount, const double* value, StateRange range,
           Backend& backend) {
  with_rows(mdp,
            [&](const auto& rows) { sweep_range(mdp, rows, discount, value, range, backend); });
}

/// In place; keeps the largest change.
struct InPlace {
  double* value;
  double change = 0.0;

  void operator()(State s, double best, Action) {
    change = std::max(change, std::fabs(best - value[s]));
    value[s] = best;
  }
};

/// Single states in place, each taken until an action leads away from it (leave): the best action
/// becomes the policy, or the policy is evaluated.
template <class Rows>
class InPlacePolicy {
 public:
  InPlacePolicy(const Mdp& mdp, const Rows& rows, double discount, std::vector<double>& value,
                std::vector<Action>& policy)
      : mdp_(mdp), rows_(rows), discount_(discount), value_(value.data()), policy_(policy.data()) {}

  /// Returns the change of the state's value.
  double improve(State s) const {
    const std::uint64_t first = mdp_.choice_begin(s);
    double best = -infinity;
    for (std::uint64_t c = first; c < mdp_.choice_end(s); ++c) {
      const double q = rows_.leave(discount_, value_, c, s);
      if (!(q > best)) continue;
      best = q;
      policy_[s] = static_cast<Action>(c - first);
    }
    const double change = std::fabs(best - value_[s]);
    value_[s] = best;
    return change;
  }
  void evaluate(State s) const {
    value_[s] = rows_.leave(discount_, value_, mdp_.choice_begin(s) + policy_[s], s);
  }

 private:
  const Mdp& mdp_;
  const Rows& rows_;
  double discount_;
  double* value_;
  Action* policy_;
};

/// Into another vector, with the least and greatest difference and the greedy policy.
struct Residual {
  const double* old_value;
  double* new_value;
  Action* policy;
  Differences differences{};

  void operator()(State s, double best, Action action) {
    differences.take(best - old_value[s]);
    new_value[s] = best;
    policy[s] = action;
  }
};

/// A whole Jacobi sweep on several threads, each part with a copy of `backend`, a Residual.
template <class Backend>
Differences sweep_all(const Mdp& mdp, double discount, const Backend& backend, unsigned threads) {
  return over_parts(mdp.states(), threads, [&](StateRange range) {
    Backend part = backend;
    sweep(mdp, discount, backend.old_value, range, part);
    return part.differences;
  });
}

}  // namespace quoll
