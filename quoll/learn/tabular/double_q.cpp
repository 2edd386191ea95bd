// Double Q-learning. van Hasselt 2010 ("Double Q-learning", NIPS 23), algorithm 1.
//
//   for each episode: s <- start()
//     until s is an end or the episode is cut off:
//   1   choose a in A(s) by QA + QB, see r and s'
//   2   toss a coin: (X, Y) <- (QA, QB) or (QB, QA);  N_X(s,a) <- N_X(s,a) + 1
//   3   a* <- argmax_a' X(s',a'), ties at random
//   4   X(s,a) <- X(s,a) + alpha(N_X(s,a)) (r + gamma Y(s',a*) - X(s,a));  s <- s'
//
// QA, QB -> part_[0], part_[1]; N_X -> visits_; alpha -> StepSize; gamma, 0 after the end -> carry.
// One table says which action is best, the other what it is worth, so that luck is not counted
// twice. The table shown, acted on and judged is the mean (QA + QB) / 2. Memory: 16 bytes a pair
// more.

#include <array>
#include <vector>

#include "quoll/learn/tabular/method_engine.hpp"
#include "quoll/learn/tabular/rules.hpp"
#include "quoll/learn/tabular/towards.hpp"

namespace quoll {
namespace {

template <class V>
class DoubleQ {
 public:
  using Value = V;
  static constexpr bool looks_ahead = false;

  DoubleQ(const LearnSetup& setup, const ValueTable<V>& table)
      : step_size_(setup.step_size),
        part_{ValueTable<V>(table.begin(), static_cast<V>(setup.initial_value)),
              ValueTable<V>(table.begin(), static_cast<V>(setup.initial_value))} {}

  Change learn(const Step& step, ValueTable<V>& table, const ChoiceDraws& draws) {
    // 2
    const std::uint32_t own = draws.own();
    ValueTable<V>& x = part_[own & 1];
    const ValueTable<V>& y = part_[1 - (own & 1)];
    // 3, 4
    double after = 0.0;
    if (step.carry != 0.0) {
      const Action best = x.rows().pick(x.values(), step.next, x.row(step.next), own);
      after = double{y[y.pair(step.next, best)]};
    }
    const double target = step.reward + step.carry * after;
    const double alpha = step_size_.at(x.visit(step.pair));
    step_towards(x, step.state, step.pair, target, alpha, step_size_, draws.rounding());
    const double sum = double{x[step.pair]} + double{y[step.pair]};
    table.set(step.state, step.pair, static_cast<V>(0.5 * sum));
    return {after, target, alpha};
  }
  void end_episode(ValueTable<V>&) {}
  void persist(Archive& archive) {
    archive("a", part_[0]);
    archive("b", part_[1]);
  }

 private:
  StepSize step_size_;
  std::array<ValueTable<V>, 2> part_;
};

}  // namespace

const LearnerEntry double_q{
    .method = "double-q",
    .rule = "",
    .summary = "two tables: one says which action is best, the other what it is worth",
    .sound = true,
    .make = method_learner<DoubleQ>,
    .replay = nullptr,
    .formula =
        "QA(s,a) := QA(s,a) + step size * (r + discount * QB(s', the best in QA) - QA(s,a)), "
        "or A and B exchanged, by a coin; shown is the mean"};

}  // namespace quoll
