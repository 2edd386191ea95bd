// Certainty equivalence: count, and plan on the counted model as if it were true. Kearns, Singh
// 1999 ("Finite-sample convergence rates for Q-learning and indirect algorithms"); Azar, Munos,
// Kappen 2013 and Agarwal, Kakade, Yang 2020 for the number of samples, S A / ((1 - gamma)^3
// eps^2).
//
//   1   see (s, a, r, s'); N(s,a) <- N(s,a) + 1; N(s,a,s') <- N(s,a,s') + 1; R(s,a) <- R(s,a) + r
//   2   when there are 1.3 times as many steps as at the last plan: Q <- the optimal values of the
//       model with P(s'|s,a) = N(s,a,s') / N(s,a) and r(s,a) = R(s,a) / N(s,a)
//   3   the answer: step 2 once more
//
// N, R -> CountedModel; step 2 -> plan(). Best under a simulator that can be set (--start
// each-pair): without noise every pair once is exact. Memory: 32 bytes for each (s, a, s') seen.

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/model_learning.hpp"
#include "quoll/learn/tabular/rules.hpp"

namespace quoll {
namespace {

class EmpiricalModel {
 public:
  using Value = double;
  static constexpr bool looks_ahead = false;

  EmpiricalModel(const LearnSetup& setup, const ValueTable<double>& table)
      : planning_(known_pairs_only(setup)),
        model_(table.pairs()),
        states_(table.states()),
        acts_on_values_(setup.exploration.kind != Exploration::Kind::uniform ||
                        setup.stable.watch) {}

  Change learn(const Step& step, ValueTable<double>& table, const ChoiceDraws&) {
    // 1
    count(model_, step);
    // 2
    if (acts_on_values_ && step.number >= next_plan_) {
      next_plan_ = step.number + 1 + step.number * 3 / 10;
      store(plan(model_, table.begin(), planning_), table);
    }
    if (!step.watched) return {};
    // The table stays as it is between plans: what is told is how far off it is.
    const double target =
        model_.backup(step.pair, planning_.discount, [&](State s) { return table.best(s); });
    return {table.best_after(step.carry, step.next), target, 0.0};
  }
  void end_episode(ValueTable<double>&) {}

  // 3
  void estimates(const ValueTable<double>& table, Estimates& out) const {
    tell(plan(model_, table.begin(), planning_), out);
  }

  void persist(Archive& archive) {
    model_.persist(archive, states_);
    archive("next_plan", next_plan_);
  }

 private:
  Planning planning_;
  CountedModel model_;
  std::uint64_t states_, next_plan_ = 1;
  bool acts_on_values_;
};

std::unique_ptr<Learner> make(const LearnSetup& setup) {
  return std::make_unique<MethodLearner<EmpiricalModel>>(setup);
}

}  // namespace

const LearnerEntry empirical_model{
    .method = "empirical-model",
    .rule = "",
    .summary =
        "counts what follows what and plans on the counts: the fewest samples where starts "
        "are chosen",
    .sound = true,
    .make = make,
    .replay = nullptr,
    .traits = {.plans = true, .ignores = "step_size, precision"},
    .formula =
        "Q := the solution of Q(s,a) = sum of N(s,a,s') / N(s,a) * (r + discount * max Q(s',.)), "
        "N = the counts so far"};

}  // namespace quoll
