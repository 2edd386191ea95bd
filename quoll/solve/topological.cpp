#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "quoll/solve/components.hpp"
#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"

// Component after component. Topological value iteration: Dai, Mausam, Weld and Goldsmith 2011;
// levelling: aggregation, Bertsekas and Castanon 1989.
//
//   1  the strongly connected components, each after all that can follow it
//   2  each of them once, until no value changes by more than the aim:
//      a  sweep in place, to and fro: V(s) <- max over a of (r + g E[V(s'); s' != s]) / (1 - g
//         P(s)), pi(s) <- that action; a state that returns to no other is done with this
//      b  two sweeps of the same for pi alone
//      c  V(s) <- V(s) + k in the whole component, so that T_pi V - V is 0 on average; a fixed
//         number of times, because that need not converge
//   3  W <- T V with MacQueen's bounds; if they are not narrow enough, a smaller aim and 2 again
//
// V: run.value(), pi: run.policy(), g: discount, P(s): probability to stay, E: live_, all states
// that are no ends. At discount 1 step 2 is that of ending_iteration.cpp.

namespace quoll {

namespace {

template <class Rows>
class ComponentSweeps {
 public:
  ComponentSweeps(Discounted& run, const Rows& rows)
      : run_(run), in_place_(run.mdp(), rows, run.discount(), run.value(), run.policy()) {
    inside_.assign(run.mdp().states(), false);
  }

  // Step 2; false = told to stop.
  bool settle(std::span<const State> part, double aim) {
    constexpr unsigned levellings = 50;
    if (part.size() == 1) {
      in_place_.improve(part.front());
      return count(1, 0.0);
    }
    double change = infinity;
    for (unsigned round = 0; change > aim; ++round) {
      change = 0.0;
      for (auto s = part.rbegin(); s != part.rend(); ++s) {
        change = std::max(change, in_place_.improve(*s));
      }
      for (const State s : part) in_place_.evaluate(s);
      for (auto s = part.rbegin(); s != part.rend(); ++s) in_place_.evaluate(*s);
      if (round < levellings && change > aim) level(part);
      if (!count(3 * part.size(), change)) return false;
    }
    return true;
  }

 private:
  // Step 2c.
  void level(std::span<const State> part) {
    const Mdp& mdp = run_.mdp();
    std::vector<double>& value = run_.value();
    for (const State s : part) inside_[s] = true;
    double difference = 0.0, leaving = 0.0;
    for (const State s : part) {
      const std::uint64_t c = mdp.choice_begin(s) + run_.policy()[s];
      double inside = 0.0, mean = 0.0;
      for (std::uint64_t o = mdp.outcome_begin(c); o < mdp.outcome_end(c); ++o) {
        mean += mdp.probability(o) * value[mdp.next(o)];
        if (inside_[mdp.next(o)]) inside += mdp.probability(o);
      }
      difference += mdp.reward(c) + run_.discount() * mean - value[s];
      leaving += 1.0 - run_.discount() * inside;
    }
    for (const State s : part) {
      inside_[s] = false;
      value[s] += difference / leaving;
    }
  }

  bool count(std::uint64_t updates, double change) {
    updates_ += updates;
    if (updates_ < run_.mdp().states()) return true;
    const bool on = run_.count(updates_, change);
    updates_ = 0;
    return on;
  }

  Discounted& run_;
  InPlacePolicy<Rows> in_place_;
  std::uint64_t updates_ = 0;  // not yet a whole sweep
  std::vector<bool> inside_;
};

class TopologicalSolver : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discount_of_one(mdp, settings);
    if (!discount) return discount.error();
    if (*discount == 1.0)
      return solve_undiscounted(mdp, settings, "topological", TotalMethod::by_components);
    Discounted run(mdp, settings, *discount, "topological");
    topological(run, Components(mdp, live_states(mdp, *discount)));
    return run.finish();
  }
};

}  // namespace

void topological(Discounted& run, const Components& parts) {
  if (run.certify()) return;
  double aim = run.aim();
  do {
    with_rows(run.mdp(), [&](const auto& rows) {
      ComponentSweeps sweeps(run, rows);
      for (const std::span<const State> part : parts) {
        if (!sweeps.settle(part, aim)) break;
      }
    });
    aim *= 0.25;
  } while (!run.certify());
}

std::unique_ptr<Solver> make_topological() {
  return std::make_unique<TopologicalSolver>();
}

}  // namespace quoll
