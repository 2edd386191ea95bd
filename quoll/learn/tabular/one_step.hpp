#pragma once
// An update rule in the loop of methods with memory: for the ways to start that only that loop has.

#include <utility>

#include "quoll/env/table.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/learn/tabular/method.hpp"
#include "quoll/learn/tabular/rule.hpp"

namespace quoll {

template <UpdateRule Rule>
class OneStep {
 public:
  using Value = typename Rule::Value;
  static constexpr bool looks_ahead = false;

  OneStep(const LearnSetup& setup, const ValueTable<Value>& table)
      : rule_(setup, PairLayout{0, table.pairs()}, table.begin()), step_size_(setup.step_size) {}

  Change learn(const Step& step, ValueTable<Value>& table, const ChoiceDraws& draws) {
    const double best_next = table.best_after(step.carry, step.next);
    const Revision<Value> revision =
        revise(rule_, step_size_, step.pair, table[step.pair], step.reward, step.carry, best_next,
               step.n, draws.rounding());
    table.set(step.state, step.pair, revision.value);
    rule_.learned(step.pair, double{revision.value});
    return {best_next, revision.target, revision.step_size};
  }
  void end_episode(ValueTable<Value>&) {}
  void persist(Archive& archive) { rule_.persist(archive); }

 private:
  Rule rule_;
  StepSize step_size_;
};

}  // namespace quoll
