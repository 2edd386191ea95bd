// Expected SARSA. van Seijen, van Hasselt, Whiteson, Wiering 2009 ("A theoretical and empirical
// analysis of Expected Sarsa"), algorithm 1.
//
//   for each episode: s <- start()
//     until s is an end or the episode is cut off:
//   1   choose a in A(s) by pi, see r and s'; N(s,a) <- N(s,a) + 1
//   2   V <- sum_a' pi(s',a') Q(s',a')
//   3   Q(s,a) <- Q(s,a) + alpha(N(s,a)) (r + gamma V - Q(s,a));  s <- s'
//
// pi -> Exploration::probabilities; alpha -> StepSize; gamma, 0 after the end -> carry. What SARSA
// learns, without the noise of drawing a': in a deterministic world alpha = 1 is right. One sum
// over A(s') a step.

#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

template <class V>
class ExpectedSarsa {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  ExpectedSarsa(const LearnSetup& setup, const ValueTable<V>&)
      : step_size_(setup.step_size), exploration_(setup.exploration) {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 2
    const double after = step.carry == 0.0 ? 0.0 : expectation(step, table);
    // 3
    return learn_from(step, after, table, step_size_, draws);
  }
  void end_episode(ValueTable<V>&) {}
  void persist(Archive&) {}

 private:
  // Counted from the best: exact where pi is greedy.
  double expectation(const Step& step, const ValueTable<V>& table) {
    const RowView<V> row = table.row(step.next);
    share_.resize(table.actions(step.next));
    exploration_.probabilities(table.rows(), table.values(), table.visits(), step.next, row,
                               step.number, share_.data());
    const double best = double{row.best};
    double less = 0.0;
    for (Action a = 0; a < share_.size(); ++a) {
      less += share_[a] * (best - double{table[table.pair(step.next, a)]});
    }
    return best - less;
  }

  StepSize step_size_;
  Exploration exploration_;
  std::vector<double> share_;
};

}  // namespace

const LearnerEntry expected_sarsa{
    .method = "expected-sarsa",
    .rule = "",
    .summary = "SARSA with the mean over the next actions instead of the one that was drawn",
    .sound = true,
    .make = method_learner<ExpectedSarsa>,
    .replay = nullptr,
    .traits = {.off_policy = false},
    .formula =
        "Q(s,a) := Q(s,a) + step size * (r + discount * sum of pi(s',.) Q(s',.) - Q(s,a)), "
        "pi = how it acts"};

}  // namespace quoll
